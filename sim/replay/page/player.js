'use strict';
// What the reader sees and does: time, colours, genes, robots.

const SPEEDS = [10, 25, 50, 100, 250, 500, 1000, 2500, 5000];  // cycles per second
const LOST_GENES = 100;
const FLUENT_PICTURES_PER_SECOND = 24;
const byId = (id) => document.getElementById(id);

/** A new element with children or text. */
function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...children);
  return element;
}

/** Says how many pictures a second the reader sees, where they are fewer than an eye takes for movement. */
class PictureRate {
  constructor(place) {
    this.place = place;
    this.since = null;
  }

  count(now) {
    if (this.since === null) [this.since, this.pictures] = [now, 0];
    ++this.pictures;
    if (now - this.since < 1000) return;
    this.show(1000 * this.pictures / (now - this.since));
    this.since = null;
  }

  show(rate) {
    if (rate === null) this.since = null;
    this.place.textContent = rate === null || rate >= FLUENT_PICTURES_PER_SECOND ? '' : `${Math.round(rate)} pictures a second: skips frames`;
  }
}

class Player {
  constructor(recording) {
    this.recording = recording;
    this.palette = new Palette();
    this.position = 0;
    this.isPlaying = false;
    this.speed = 100;
    this.gene = null;
    this.pointedAt = null;
    this.kept = null;
    this.colour = 'lineage';
    this.rate = new PictureRate(byId('rate'));
    this.arena = new ArenaView(byId('arena'), recording, this.palette);
    this.timeline = new TimelineView(byId('timeline'), recording, this.palette);
    this.genealogy = new GenealogyView(byId('tree'), recording, this.palette, (gene) => this.choose(gene));
    this.describeRun();
    this.listGenes();
    this.fillTable();
    this.listenToTime();
    this.listenToView();
    this.listenToArena();
    this.takeAway = new TakeAway(this);
    this.listenToKeys();
    const address = location.hash;
    // A link says all that it shows.
    if (address.length > 1) this.choose(null);
    else this.openOnSomething();
    this.readAddress(address);
    this.draw();
  }

  get cycle() {
    return this.recording.frames.cycleAt(this.position);
  }

  /** The end of the run, with the gene lit that most robots carry; of several, the newest. */
  openOnSomething() {
    const most = this.recording.data.genealogy.reduce(
      (best, row) => (best === null || row.carriers >= best.carriers ? row : best), null);
    this.position = this.recording.frames.count - 1;
    this.choose(most === null ? null : most.gene);
  }

  // Words

  describeRun() {
    const { data, robots, cycles } = this.recording;
    const task = data.task[0].toUpperCase() + data.task.slice(1);
    byId('title').textContent = `${task} with ${data.source_title.toLowerCase()}`;
    document.title = `${byId('title').textContent}: a run to watch – Gene Clocks`;
    const genes = data.genealogy.length;
    byId('lead').textContent = `${robots} robots over ${grouped(cycles)} cycles. Every gene bears a mark ⟨counter, robot⟩; `
      + `of ${grouped(this.recording.genesUntil(Infinity))} that were created, ${genes} are in the final swarm.`;
    byId('genealogy-text').textContent = genes === 0
      ? 'No robot of the final swarm carries any gene beyond the initial ones.'
      : 'Every node is a birth that added genes; time goes from left to right. A thick line leads on from what came just '
        + 'before in the same genome, and is as wide as the share of the final swarm that carries the genes. Dotted lines '
        + 'come from the genes that the new ones build upon. At the right end: the newest gene of each genome, and how many robots have it.';
    for (const [name, value] of data.facts) {
      byId('facts').append(make('div', {}, make('dt', {}, name), make('dd', {}, value)));
    }
  }

  fillTable() {
    const { recording } = this;
    for (const { gene, carriers, follows } of recording.data.genealogy) {
      const { created, creator, upon } = recording.genes;
      const cells = [recording.kind(gene), grouped(created[gene]), String(creator[gene]),
        upon[gene].map((base) => recording.mark(base)).join(' '), follows === null ? '' : recording.mark(follows), String(carriers)];
      const numbers = [1, 2, 5];
      byId('table').append(make('tr', {}, make('th', { scope: 'row' }, recording.mark(gene)),
        ...cells.map((text, i) => make('td', numbers.includes(i) ? { class: 'n' } : {}, text))));
    }
  }

  // Genes

  listGenes() {
    const { recording } = this;
    this.final = recording.data.genealogy.map(({ gene }) => gene);
    this.lost = [];
    for (let gene = recording.genesis; gene < recording.peak.length; ++gene) {
      if (recording.finalCarriers[gene] === 0 && recording.peak[gene] > 1) this.lost.push(gene);
    }
    this.lost.sort((a, b) => recording.peak[b] - recording.peak[a] || a - b).splice(LOST_GENES);
    byId('which').append(make('option', { value: 'final' }, `In the final swarm (${this.final.length})`),
      make('option', { value: 'lost' }, `Lost on the way (${this.lost.length} most common)`));
    byId('which').addEventListener('change', () => this.fillList());
    byId('find').addEventListener('input', () => this.fillList());
    this.fillList();
  }

  fillList() {
    const { recording } = this;
    const isFinal = byId('which').value === 'final';
    const wanted = byId('find').value.match(/\d+/g) ?? [];
    const counts = isFinal ? recording.finalCarriers : recording.peak;
    this.listed = (isFinal ? this.final : this.lost).filter((gene) =>
      recording.genes.counter[gene].startsWith(wanted[0] ?? '') &&
      String(recording.genes.robot[gene] ?? '').startsWith(wanted[1] ?? ''));
    byId('genes').replaceChildren(...this.listed.map((gene) => {
      const share = 100 * counts[gene] / recording.robots;
      const bar = make('span', { class: 'bar', 'aria-hidden': 'true' });
      bar.style.setProperty('--share', `${share}%`);
      const button = make('button', { type: 'button', 'data-gene': gene, 'aria-pressed': gene === this.gene },
        make('span', { class: 'mark' }, recording.mark(gene)),
        make('span', { class: 'kind' }, recording.kind(gene)), bar,
        make('span', { class: 'count' }, String(counts[gene])),
        make('span', { class: 'hidden' }, isFinal ? ' robots in the end' : ' robots at most'));
      button.addEventListener('click', () => this.choose(gene === this.gene ? null : gene));
      return make('li', {}, button);
    }));
    if (this.listed.length === 0) byId('genes').append(make('li', { class: 'nothing' }, 'No such gene here.'));
  }

  choose(gene) {
    const { recording } = this;
    this.gene = gene;
    this.hasChosen = gene === null ? null : recording.geneSets.map((set) => set.includes(gene));
    for (const button of byId('genes').querySelectorAll('button')) {
      button.setAttribute('aria-pressed', Number(button.dataset.gene) === gene);
    }
    this.describeChosen();
    this.timeline.show(gene);
    this.genealogy.show(gene);
    this.shownRobot = null;
    this.draw();
    this.writeAddress();
  }

  describeChosen() {
    const { recording, gene } = this;
    if (gene === null) {
      byId('chosen').replaceChildren(make('p', {}, 'Choose a gene: the robots that carry it light up, messages that tell of it too, and the chart below shows how it spreads.'));
      return;
    }
    const watch = make('button', { type: 'button', id: 'origin' }, 'Go to its creation');
    watch.addEventListener('click', () => this.goToCycle(recording.genes.created[gene] + 1));
    const clear = make('button', { type: 'button', id: 'clear' }, 'Clear');
    clear.addEventListener('click', () => this.choose(null));
    this.carrierCount = make('b');
    byId('chosen').replaceChildren(
      make('p', {}, make('b', { class: 'mark' }, recording.mark(gene)), ': ', describeOrigin(recording, gene)),
      make('p', { class: 'buttons' }, make('span', {}, 'Now in ', this.carrierCount), watch, clear));
  }

  /** The next gene of the list, or the previous one. */
  chooseNext(step) {
    if (this.listed.length === 0) return;
    const at = this.listed.indexOf(this.gene);
    const next = at < 0 ? (step > 0 ? 0 : this.listed.length - 1) : (at + step + this.listed.length) % this.listed.length;
    this.choose(this.listed[next]);
    byId('genes').children[next].scrollIntoView({ block: 'nearest' });
  }

  // Time

  listenToTime() {
    const slider = byId('slider');
    slider.max = this.recording.frames.count - 1;
    slider.addEventListener('input', () => this.goTo(Number(slider.value)));
    slider.addEventListener('change', () => this.writeAddress());
    byId('play').addEventListener('click', () => this.play(!this.isPlaying));
    byId('back').addEventListener('click', () => this.step(-1));
    byId('forth').addEventListener('click', () => this.step(1));
    for (const speed of SPEEDS) {
      byId('speed').append(make('option', { value: speed }, `${grouped(speed)} cycles/s`));
    }
    byId('speed').value = this.speed;
    byId('speed').addEventListener('change', () => { this.speed = Number(byId('speed').value); });
    const timeline = byId('timeline');
    const drag = (event) => this.goToCycle(this.timeline.cycleAt(event.offsetX));
    timeline.addEventListener('pointerdown', (event) => {
      timeline.setPointerCapture(event.pointerId);
      drag(event);
    });
    timeline.addEventListener('pointermove', (event) => {
      if (timeline.hasPointerCapture(event.pointerId)) drag(event);
    });
    timeline.addEventListener('pointerup', () => this.writeAddress());
  }

  goTo(position) {
    this.position = Math.min(Math.max(position, 0), this.recording.frames.count - 1);
    this.draw();
  }

  goToCycle(cycle) {
    this.goTo(this.recording.frames.positionOf(cycle));
  }

  step(frames) {
    this.play(false);
    this.goTo(Math.round(this.position) + frames);
    this.writeAddress();
  }

  play(wanted) {
    if (wanted === this.isPlaying) return;
    this.isPlaying = wanted;
    byId('play').setAttribute('aria-label', wanted ? 'Pause' : 'Play');
    byId('play').classList.toggle('playing', wanted);
    if (!wanted) {
      this.takeAway.playingEnded();
      this.rate.show(null);
      this.writeAddress();
      return;
    }
    if (this.position >= this.recording.frames.count - 1) this.position = 0;
    let before = null;
    const tick = (now) => {
      if (!this.isPlaying) return;
      // A page in the background is not shown; time does not jump when it comes back.
      const seconds = before === null ? 0 : Math.min((now - before) / 1000, 0.1);
      before = now;
      this.rate.count(now);
      this.goToCycle(this.cycle + seconds * this.speed);
      if (this.position >= this.recording.frames.count - 1) this.play(false);
      else requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }

  changeSpeed(step) {
    const at = Math.min(Math.max(SPEEDS.indexOf(this.speed) + step, 0), SPEEDS.length - 1);
    this.speed = SPEEDS[at];
    byId('speed').value = this.speed;
  }

  // View

  listenToView() {
    byId('view').addEventListener('submit', (event) => event.preventDefault());
    byId('colour').addEventListener('change', () => {
      this.colour = byId('colour').value;
      this.draw();
      this.writeAddress();
    });
    byId('messages').addEventListener('change', () => this.draw());
    const resize = () => {
      for (const view of [this.arena, this.timeline, this.genealogy]) view.resize();
      this.genealogy.show(this.gene);
      this.draw();
    };
    window.addEventListener('resize', resize);
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
      this.palette.refresh();
      resize();
    });
    window.addEventListener('hashchange', () => this.readAddress(location.hash));
  }

  listenToArena() {
    const canvas = byId('arena');
    const at = (event) => this.arena.robotAt(event.offsetX, event.offsetY, event.pointerType === 'touch' ? 24 : 14);
    canvas.addEventListener('pointermove', (event) => {
      const robot = at(event);
      if (robot === this.pointedAt) return;
      this.pointedAt = robot;
      this.draw();
    });
    canvas.addEventListener('pointerleave', () => {
      this.pointedAt = null;
      this.draw();
    });
    canvas.addEventListener('click', (event) => this.keep(at(event)));
    const number = byId('robot-number');
    number.max = this.recording.robots;
    number.addEventListener('input', () => {
      const robot = Number(number.value);
      if (number.value === '') this.keep(null);
      else if (number.validity.valid && robot - 1 !== this.kept) this.keep(robot - 1);
    });
  }

  keep(robot) {
    this.kept = robot === this.kept ? null : robot;
    byId('robot-number').value = this.kept === null ? '' : this.kept + 1;
    this.draw();
    this.writeAddress();
  }

  keepNext(step) {
    const { robots } = this.recording;
    this.keep(this.kept === null ? (step > 0 ? 0 : robots - 1) : (this.kept + step + robots) % robots);
  }

  listenToKeys() {
    const actions = {
      ' ': () => this.play(!this.isPlaying),
      ArrowLeft: (event) => this.step(event.shiftKey ? -10 : -1),
      ArrowRight: (event) => this.step(event.shiftKey ? 10 : 1),
      Home: () => this.step(-Infinity),
      End: () => this.step(Infinity),
      '-': () => this.changeSpeed(-1),
      '+': () => this.changeSpeed(1),
      n: () => this.chooseNext(1),
      p: () => this.chooseNext(-1),
      r: (event) => this.keepNext(event.shiftKey ? -1 : 1),
      m: () => byId('messages').click(),
      s: () => this.takeAway.saveSvg(),
      Escape: () => {
        this.keep(null);
        this.choose(null);
      },
    };
    document.addEventListener('keydown', (event) => {
      if (event.ctrlKey || event.altKey || event.metaKey) return;
      // Elements that have their own use for a key keep it.
      const on = event.target;
      if (on.matches('input[type=search], input[type=number], select')) return;
      if (event.key === ' ' && on.matches('button, input, summary, a')) return;
      const action = actions[event.key] ?? actions[event.key.toLowerCase()];
      if (!action) return;
      event.preventDefault();
      action(event);
    });
  }

  // The address says what is shown, so that a link leads to it: #cycle=16101&gene=388@61&robot=61

  readAddress(address) {
    const wanted = new URLSearchParams(address.slice(1));
    const colour = wanted.get('colour');
    if ([...byId('colour').options].some(({ value }) => value === colour)) {
      this.colour = byId('colour').value = colour;
    }
    const robot = Number(wanted.get('robot'));
    if (Number.isInteger(robot) && robot >= 1 && robot <= this.recording.robots && robot - 1 !== this.kept) this.keep(robot - 1);
    if (wanted.has('gene')) this.choose(this.recording.find(wanted.get('gene')));
    const cycle = Number(wanted.get('cycle') ?? NaN);
    if (Number.isFinite(cycle)) this.goToCycle(cycle);
  }

  writeAddress() {
    if (this.isPlaying) return;
    const parts = [`cycle=${Math.round(this.cycle)}`];
    if (this.gene !== null) parts.push(`gene=${this.recording.key(this.gene)}`);
    if (this.kept !== null) parts.push(`robot=${this.kept + 1}`);
    if (this.colour !== 'lineage') parts.push(`colour=${this.colour}`);
    try {
      history.replaceState(null, '', `#${parts.join('&')}`);
    } catch {
      // Some browsers allow it only so often; the next one will do.
    }
  }

  // Drawing

  draw() {
    const cycle = this.cycle;
    const scene = this.scene();
    this.arena.draw(scene);
    this.timeline.draw(cycle);
    this.genealogy.draw(cycle);
    this.showTime(cycle, scene.sets);
    this.showLegend(scene.sets, scene.lit);
    this.showRobot(scene.sets);
  }

  /** What the arena shows now; `sets`: the gene set of each robot. */
  scene() {
    const { recording, palette } = this;
    const cycle = this.cycle;
    const sets = Array.from({ length: recording.robots }, (_, robot) => recording.setOf(robot, cycle));
    const lit = this.hasChosen && sets.map((set) => this.hasChosen[set]);
    const marked = [];
    if (this.kept !== null) marked.push({ robot: this.kept, isKept: true });
    if (this.pointedAt !== null && this.pointedAt !== this.kept) marked.push({ robot: this.pointedAt, isKept: false });
    const hollow = this.colour === 'energy' || lit ? null : sets.map((set) => recording.newestOf(set) === null);
    const colours = lit ? lit.map((is) => (is ? palette.chosen : palette.none))
      : sets.map((set, robot) => this.colourOfRobot(robot, set, cycle));
    return { position: this.position, sets, colours, hollow, lit, marked, messages: byId('messages').checked };
  }

  colourOfRobot(robot, set, cycle) {
    const { recording, palette } = this;
    if (this.colour === 'energy') {
      const { frames } = recording;
      const energy = frames.energy[Math.floor(this.position) * recording.robots + robot] * frames.energyStep;
      return palette.onRamp(energy / recording.data.energy_maximum);
    }
    const newest = recording.newestOf(set);
    if (newest === null) return palette.none;
    if (this.colour === 'newest') {
      return palette.onRamp(1 - (cycle - recording.genes.created[newest]) / this.oldestAge);
    }
    const lineage = recording.lineageOf[set];
    return lineage < LINEAGE_COLOURS ? palette.lineages[lineage] : palette.other;
  }

  /** Cycles after which a gene has the colour of old ones. */
  get oldestAge() {
    return this.recording.cycles / 4;
  }

  showTime(cycle, sets) {
    const { recording } = this;
    byId('slider').value = Math.round(this.position);
    byId('slider').setAttribute('aria-valuetext', `cycle ${Math.round(cycle)}`);
    byId('now').textContent = `Cycle ${grouped(cycle)}`;
    const frame = Math.floor(this.position);
    const [sent, received] = recording.frames.messages.subarray(2 * frame, 2 * frame + 2);
    const alive = new Set(sets.flatMap((set) => recording.geneSets[set]));
    const counters = [['Swarm fitness', recording.fitnessAt(cycle).toFixed(1)], ['Messages sent', grouped(sent)],
      ['heard', grouped(received)], ['Births', grouped(recording.birthsUntil(cycle))],
      ['Genes created', grouped(recording.genesUntil(cycle))], ['carried now', grouped(alive.size)]];
    if (byId('counters').children.length === 0) {
      byId('counters').append(...counters.map(([name]) => make('div', {}, make('dt', {}, name), make('dd'))));
    }
    counters.forEach(([, value], i) => { byId('counters').children[i].lastChild.textContent = value; });
  }

  showLegend(sets, lit) {
    const { recording, palette } = this;
    const entries = [];  // colour, text, gene to choose
    if (lit) {
      const carriers = lit.filter(Boolean).length;
      this.carrierCount.textContent = `${carriers} of ${recording.robots} robots`;
      entries.push([palette.chosen, `carries ${recording.mark(this.gene)}: ${carriers}`], [palette.none, `does not: ${recording.robots - carriers}`]);
    } else if (this.colour === 'lineage') {
      const robots = (isOne) => sets.filter((set) => isOne(recording.lineageOf[set])).length;
      recording.lineages.slice(0, LINEAGE_COLOURS).forEach((gene, i) => {
        entries.push([palette.lineages[i], `${recording.mark(gene)}: ${robots((lineage) => lineage === i)}`, gene]);
      });
      entries.push([palette.other, `other lineages: ${robots((lineage) => lineage >= LINEAGE_COLOURS)}`],
        ['hollow', `no new gene: ${robots((lineage) => lineage < 0)}`]);
    } else if (this.colour === 'newest') {
      entries.push([palette.onRamp(1), 'newest gene just created'],
        [palette.onRamp(0), `${grouped(this.oldestAge)} cycles ago or more`], ['hollow', 'no new gene']);
    } else {
      entries.push([palette.onRamp(1), `energy ${recording.data.energy_maximum}`], [palette.onRamp(0.5), String(recording.data.energy_maximum / 2)], [palette.onRamp(0), '0']);
    }
    const text = JSON.stringify(entries);
    if (text === this.legendText) return;
    this.legendText = text;
    byId('legend').replaceChildren(...entries.map(([colour, words, gene]) => {
      const swatch = make('i', { 'aria-hidden': 'true', class: colour === 'hollow' ? colour : '' });
      swatch.style.background = colour;
      if (gene === undefined) return make('li', {}, swatch, words);
      const button = make('button', { type: 'button' }, swatch, words);
      button.addEventListener('click', () => this.choose(gene));
      return make('li', {}, button);
    }));
  }

  showRobot(sets) {
    const { recording } = this;
    const robot = this.pointedAt ?? this.kept;
    const frame = Math.floor(this.position);
    const text = JSON.stringify([robot, frame, sets[robot], this.kept, this.gene]);
    if (text === this.shownRobot) return;
    this.shownRobot = text;
    if (robot === null) {
      byId('robot').replaceChildren(make('p', {}, 'Point at a robot to see its genome; click to keep it.'));
      return;
    }
    const { frames } = recording;
    const at = frame * recording.robots + robot;
    const energy = frames.energy[at] * frames.energyStep;
    const clock = frames.clock[at];
    const bar = make('span', { class: 'bar', 'aria-hidden': 'true' });
    bar.style.setProperty('--share', `${100 * energy / recording.data.energy_maximum}%`);
    const genes = recording.geneSets[sets[robot]];
    const chips = genes.map((gene) => {
      const chip = make('button', { type: 'button', 'aria-pressed': gene === this.gene }, recording.mark(gene));
      chip.addEventListener('click', () => this.choose(gene));
      return make('li', {}, chip);
    });
    byId('robot').replaceChildren(
      make('dl', { class: 'state' },
        make('div', {}, make('dt', {}, 'Number'), make('dd', {}, String(robot + 1) + (robot === this.kept ? ', kept' : ''))),
        make('div', {}, make('dt', {}, 'Energy'), make('dd', {}, bar, `${Math.round(energy)}`)),
        make('div', {}, make('dt', {}, 'Clock'), make('dd', {}, clock > 0 ? grouped(clock) : 'none'))),
      make('p', {}, `Its genome has the ${recording.genesis} initial genes and `
        + `${genes.length === 0 ? 'no other.' : `${genes.length} more:`}`),
      make('ul', { class: 'chips' }, ...chips));
  }
}

const player = new Player(new Recording(JSON.parse(byId('recording').textContent)));
