'use strict';
// A recorded run, and questions about it. Robots count from 0 here, and from 1 on the page.

/** Robots, messages and items at the chosen cycles. Places in pixels. */
class Frames {
  constructor(data, robots, items) {
    const frames = data.frames;
    this.from = frames.from;
    this.to = frames.to;
    this.every = frames.every;
    this.count = frames.count;
    this.placePx = frames.place_px;
    this.energyStep = frames.energy;
    this.headings = frames.headings;
    this.x = readRows(frames.x, this.count, robots, Int32Array);
    this.y = readRows(frames.y, this.count, robots, Int32Array);
    this.heading = readRows(frames.heading, this.count, robots, Uint8Array);
    this.energy = readRows(frames.energies, this.count, robots, Uint16Array);
    this.clock = readRows(frames.clocks, this.count, robots, Float64Array);
    this.messages = readRows(frames.messages, this.count, 2, Float64Array);
    this.readHeard(frames.heard);
    this.readItems(frames.item_changes, items);
  }

  readHeard(text) {
    const reader = new NumberReader(text);
    const pairs = [];
    this.heardBegin = new Uint32Array(this.count + 1);
    for (let frame = 0; frame < this.count; ++frame) {
      let pair = 0;
      for (let left = reader.next(); left > 0; --left) pairs.push((pair += reader.next()));
      this.heardBegin[frame + 1] = pairs.length;
    }
    reader.end();
    this.heardPairs = Float64Array.from(pairs);
  }

  /** Where each item is in each frame; -1 where it is absent. */
  readItems(text, items) {
    const reader = new NumberReader(text);
    this.itemX = new Int32Array(this.count * items).fill(-1);
    this.itemY = new Int32Array(this.count * items).fill(-1);
    for (let frame = 0; frame < this.count; ++frame) {
      const begin = frame * items;
      if (frame > 0) {
        this.itemX.copyWithin(begin, begin - items, begin);
        this.itemY.copyWithin(begin, begin - items, begin);
      }
      for (let left = reader.next(); left > 0; --left) {
        const item = begin + reader.next();
        const isPresent = reader.next() === 1;
        this.itemX[item] = isPresent ? reader.next() : -1;
        this.itemY[item] = isPresent ? reader.next() : -1;
      }
    }
    reader.end();
  }

  /** The cycle at a position between frames: position 2.5 is halfway from frame 2 to frame 3. */
  cycleAt(position) {
    const before = Math.floor(position);
    const cycle = (frame) => Math.min(this.from + frame * this.every, this.to);
    return cycle(before) + (position - before) * (cycle(before + 1) - cycle(before));
  }

  positionOf(cycle) {
    const last = this.count - 1;
    if (cycle >= this.to) return last;
    if (cycle <= this.from) return 0;
    const before = Math.min(Math.floor((cycle - this.from) / this.every), last - 1);
    const begin = this.from + before * this.every;
    const end = Math.min(begin + this.every, this.to);
    return before + (cycle - begin) / (end - begin);
  }
}

class Recording {
  constructor(data) {
    if (data.format !== 1) throw new Error('a recording of format 1 is needed');
    this.data = data;
    this.robots = data.robots;
    this.items = data.items;
    this.cycles = data.cycles;
    this.arena = data.arena;
    this.frames = new Frames(data, data.robots, data.items);
    this.genes = data.genes;
    this.genesis = data.genes.genesis;
    this.readGeneSets();
    this.readActivations();
    this.countCarriers();
    this.findLineages();
  }

  readGeneSets() {
    const reader = new NumberReader(this.data.gene_sets.data);
    this.geneSets = [];
    for (let i = 0; i < this.data.gene_sets.count; ++i) {
      const set = [];
      let gene = 0;
      for (let left = reader.next(); left > 0; --left) set.push((gene += reader.next()));
      this.geneSets.push(set);
    }
    reader.end();
  }

  /** Rows of cycle, robot and gene set; the same for each robot, apart. */
  readActivations() {
    const { count, data } = this.data.activations;
    this.activations = readRows(data, count, 3, Float64Array);
    this.activationCount = count;
    this.activeSince = Array.from({ length: this.robots }, () => []);
    this.activeSet = Array.from({ length: this.robots }, () => []);
    for (let i = 0; i < count; ++i) {
      const [cycle, robot, set] = this.activations.subarray(3 * i, 3 * i + 3);
      this.activeSince[robot].push(cycle);
      this.activeSet[robot].push(set);
    }
  }

  /** For each gene, how many robots carry it in the end, and at most. */
  countCarriers() {
    const now = new Uint32Array(this.genes.counter.length);
    this.peak = new Uint32Array(now.length);
    const sets = new Int32Array(this.robots).fill(0);
    for (let i = 0; i < this.activationCount; ++i) {
      const [, robot, set] = this.activations.subarray(3 * i, 3 * i + 3);
      for (const gene of this.geneSets[sets[robot]]) --now[gene];
      sets[robot] = set;
      for (const gene of this.geneSets[set]) {
        if (++now[gene] > this.peak[gene]) this.peak[gene] = now[gene];
      }
    }
    this.finalCarriers = now;
    this.finalSets = sets;
  }

  /** A genome's lineage is its oldest gene beyond the genesis ones. The first of `lineages` have the
   *  most robots in the end, and then over time; `lineageOf` is the place there by gene set, or -1. */
  findLineages() {
    const cycles = new Map();
    for (let robot = 0; robot < this.robots; ++robot) {
      const since = this.activeSince[robot];
      for (let i = 0; i < since.length; ++i) {
        const founder = this.founderOf(this.activeSet[robot][i]);
        const until = i + 1 < since.length ? since[i + 1] : this.cycles;
        cycles.set(founder, (cycles.get(founder) ?? 0) + until - since[i]);
      }
    }
    cycles.delete(null);
    const inTheEnd = (gene) => {
      let robots = 0;
      for (const set of this.finalSets) if (this.founderOf(set) === gene) ++robots;
      return robots;
    };
    this.lineages = [...cycles.keys()]
      .map((gene) => ({ gene, robots: inTheEnd(gene), cycles: cycles.get(gene) }))
      .sort((a, b) => b.robots - a.robots || b.cycles - a.cycles || a.gene - b.gene)
      .map(({ gene }) => gene);
    const places = new Map(this.lineages.map((gene, i) => [gene, i]));
    this.lineageOf = this.geneSets.map((set) => places.get(set[0]) ?? -1);
  }

  /** Genes are numbered in the order of their creation. */
  founderOf(set) {
    return this.geneSets[set][0] ?? null;
  }

  newestOf(set) {
    return this.geneSets[set].at(-1) ?? null;
  }

  /** The gene set of a robot's active genome. */
  setOf(robot, cycle) {
    const since = this.activeSince[robot];
    return this.activeSet[robot][firstIndex(since.length, (i) => since[i] > cycle) - 1];
  }

  birthsUntil(cycle) {
    return firstIndex(this.activationCount, (i) => this.activations[3 * i] > cycle) - this.robots;
  }

  genesUntil(cycle) {
    const created = this.genes.created;
    return firstIndex(created.length - this.genesis,
      (i) => created[this.genesis + i] >= cycle);
  }

  fitnessAt(cycle) {
    const samples = this.data.samples;
    const next = firstIndex(samples.cycle.length, (i) => samples.cycle[i] > cycle);
    return samples.swarm_fitness[Math.max(0, next - 1)];
  }

  /** For each of so many kinds of gene sets how many robots have one of it, at `steps` + 1 times, evenly
   *  from the first frame to the last. `kindOfSet` gives -1 for sets that are of none. */
  robotsOverTime(kindOfSet, kinds, steps) {
    const { from, to } = this.frames;
    const series = Array.from({ length: kinds }, () => new Float32Array(steps + 1));
    const now = new Float32Array(kinds);
    const kind = new Int32Array(this.robots).fill(-1);
    let next = 0;
    for (let step = 0; step <= steps; ++step) {
      const cycle = from + (to - from) * step / steps;
      for (; next < this.activationCount && this.activations[3 * next] <= cycle; ++next) {
        const robot = this.activations[3 * next + 1];
        if (kind[robot] >= 0) --now[kind[robot]];
        kind[robot] = kindOfSet(this.activations[3 * next + 2]);
        if (kind[robot] >= 0) ++now[kind[robot]];
      }
      for (let i = 0; i < kinds; ++i) series[i][step] = now[i];
    }
    return series;
  }

  mark(gene) {
    const robot = this.genes.robot[gene];
    const counter = this.genes.counter[gene];
    return robot === null ? `⟨${counter}⟩` : `⟨${counter}, ${robot}⟩`;
  }

  /** The mark as the table of `gene-clocks replay --genealogy` and this page's address write it. */
  key(gene) {
    return `${this.genes.counter[gene]}@${this.genes.robot[gene] ?? ''}`;
  }

  find(key) {
    const [counter, robot = ''] = key.split('@');
    const gene = this.genes.counter.findIndex((other, i) => i >= this.genesis && other === counter &&
      String(this.genes.robot[i] ?? '') === robot);
    return gene < 0 ? null : gene;
  }

  kind(gene) {
    return ['neuron', 'connection', 'recurrent connection'][this.genes.kind[gene]];
  }
}

/** 12345 as 12 345, which is not torn apart. */
function grouped(number) {
  return String(Math.round(number)).replace(/\B(?=(\d{3})+$)/g, '\u202f');
}
