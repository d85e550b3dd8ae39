'use strict';
// Where the genes of the final swarm come from: a tree over time. Genes that one birth created (a
// split creates three) are one node. A node hangs on what came just before it in its genome; the
// lines' width is the share of the final swarm that carries it. Dotted: the genes it builds upon.

const TREE = { left: 12, right: 128, top: 14, bottom: 34, lane: 19, laneLeast: 11, widest: 26 };

function svg(tag, attributes, parent) {
  const element = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  parent?.append(element);
  return element;
}

/** The nodes of a genealogy, each with its genes, carriers, parent, children; and its `tips`: the
 *  robots whose newest gene it is. */
function buildForest(recording) {
  const { genes } = recording;
  const nodes = new Map();
  const nodeOf = new Map();  // by gene
  const rows = [...recording.data.genealogy].sort((a, b) => a.gene - b.gene);
  for (const { gene, carriers } of rows) {
    const key = `${genes.creator[gene]} ${genes.birth[gene]}`;
    if (!nodes.has(key)) {
      nodes.set(key, { genes: [], carriers: 0, created: genes.created[gene], children: [], parent: null, tips: 0 });
    }
    const node = nodes.get(key);
    node.genes.push(gene);
    node.carriers = Math.max(node.carriers, carriers);
    nodeOf.set(gene, node);
  }
  for (const { gene, follows } of rows) {
    const node = nodeOf.get(gene);
    if (follows === null || node.parent) continue;
    node.parent = nodeOf.get(follows);
    node.parent.children.push(node);
  }
  for (const set of recording.finalSets) {
    const newest = recording.newestOf(set);
    if (newest !== null) ++nodeOf.get(newest).tips;
  }
  const all = [...nodes.values()];
  const byCarriers = (a, b) => b.carriers - a.carriers || a.created - b.created;
  for (const node of all) node.children.sort(byCarriers);
  return { nodes: all, roots: all.filter((node) => !node.parent).sort(byCarriers), nodeOf };
}

/** Gives each node its lane: that of its own tip, or the middle of its children's. Returns how many
 *  lanes there are. */
function layOut(roots) {
  let lanes = 0;
  const visit = (node) => {
    if (node.tips > 0) node.tipLane = lanes++;
    node.children.forEach(visit);
    const of = [...(node.tips > 0 ? [node.tipLane] : []), ...node.children.map((child) => child.lane)];
    // An own tip goes straight on; else between the outermost children.
    node.lane = node.tips > 0 ? node.tipLane : of.length ? (of[0] + of.at(-1)) / 2 : lanes++;
  };
  roots.forEach(visit);
  return lanes;
}

class GenealogyView {
  /** `choose` is called with a gene that the reader picks. */
  constructor(element, recording, palette, choose) {
    this.element = element;
    this.recording = recording;
    this.palette = palette;
    this.choose = choose;
    this.gene = null;
    Object.assign(this, buildForest(recording));
    this.lanes = layOut(this.roots);
    this.resize();
  }

  get isEmpty() {
    return this.nodes.length === 0;
  }

  x(cycle) {
    return TREE.left + (this.width - TREE.left - TREE.right) * cycle / this.recording.cycles;
  }

  y(lane) {
    return TREE.top + (lane + 0.5) * this.laneHeight;
  }

  thickness(robots) {
    return Math.max(1.25, TREE.widest * robots / this.recording.robots);
  }

  colourOf(node) {
    let root = node;
    while (root.parent) root = root.parent;
    const place = this.recording.lineages.indexOf(root.genes[0]);  // -1: its founder has died out
    return place >= 0 && place < LINEAGE_COLOURS ? this.palette.lineages[place] : this.palette.other;
  }

  resize() {
    this.element.replaceChildren();
    this.element.toggleAttribute('hidden', this.isEmpty);
    if (this.isEmpty) return;
    this.width = Math.max(this.element.parentElement.clientWidth, 560);
    this.laneHeight = Math.max(TREE.laneLeast, Math.min(TREE.lane, 900 / this.lanes));
    this.height = TREE.top + this.lanes * this.laneHeight + TREE.bottom;
    this.element.setAttribute('viewBox', `0 0 ${this.width} ${this.height}`);
    this.element.setAttribute('width', this.width);
    this.element.setAttribute('height', this.height);
    this.drawAxis();
    const flows = svg('g', { class: 'flows', fill: 'none' }, this.element);
    const bases = svg('g', { class: 'bases', fill: 'none' }, this.element);
    const dots = svg('g', { class: 'dots' }, this.element);
    for (const node of [...this.nodes].sort((a, b) => b.carriers - a.carriers)) {
      this.drawFlow(node, flows);
      this.drawBases(node, bases);
      this.drawNode(node, dots);
    }
    this.highlight();
  }

  drawAxis() {
    const axis = svg('g', { class: 'axis' }, this.element);
    const bottom = this.height - TREE.bottom + 6;
    for (const cycle of roundSteps(0, this.recording.cycles, Math.max(2, this.width / 130))) {
      svg('line', { x1: this.x(cycle), x2: this.x(cycle), y1: TREE.top - 8, y2: bottom }, axis);
      const label = svg('text', { x: this.x(cycle), y: bottom + 15, 'text-anchor': cycle === 0 ? 'start' : 'middle' }, axis);
      label.textContent = cycle === 0 ? 'cycle 0' : grouped(cycle);
    }
    this.now = svg('line', { class: 'now', y1: TREE.top - 8, y2: bottom }, axis);
  }

  /** From the parent's line to the node, on to its last child, and to its tip at the end. */
  drawFlow(node, group) {
    const colour = this.colourOf(node);
    const x = this.x(node.created);
    const y = this.y(node.lane);
    const flow = (path, robots) =>
      svg('path', { d: path, stroke: colour, 'stroke-width': this.thickness(robots) }, group);
    node.paths = [];
    if (node.parent) {
      const from = this.y(node.parent.lane);
      const start = Math.max(this.x(node.parent.created), x - 36);
      const middle = (start + x) / 2;
      node.paths.push(flow(`M${start} ${from}C${middle} ${from} ${middle} ${y} ${x} ${y}`, node.carriers));
    }
    // What goes on thins out where children branch off.
    let left = node.carriers;
    let at = x;
    for (const child of [...node.children].sort((a, b) => a.created - b.created)) {
      const branch = Math.max(x, this.x(child.created) - 36);
      if (branch > at) node.paths.push(flow(`M${at} ${y}H${branch}`, left));
      at = Math.max(at, branch);
      left = Math.max(left - child.carriers, node.tips);
    }
    if (node.tips > 0) node.paths.push(flow(`M${at} ${y}H${this.x(this.recording.cycles)}`, node.tips));
  }

  drawBases(node, group) {
    node.bases = [];
    const upon = new Set();
    for (const gene of node.genes) {
      for (const base of this.recording.genes.upon[gene]) {
        const other = this.nodeOf.get(base);
        if (other && other !== node) upon.add(other);
      }
    }
    node.upon = [...upon];
    const [x, y] = [this.x(node.created), this.y(node.lane)];
    for (const other of upon) {
      const [fromX, fromY] = [this.x(other.created), this.y(other.lane)];
      const bow = Math.min(28, 8 + Math.abs(x - fromX) / 12);
      node.bases.push(svg('path', { d: `M${fromX} ${fromY}Q${(fromX + x) / 2} ${(fromY + y) / 2 - bow} ${x} ${y}` }, group));
    }
  }

  drawNode(node, group) {
    const marks = node.genes.map((gene) => this.recording.mark(gene)).join(' ');
    const [x, y] = [this.x(node.created), this.y(node.lane)];
    const isSplit = node.genes.some((gene) => this.recording.genes.kind[gene] === 0);
    const element = svg('g', {
      class: 'node', tabindex: 0, role: 'button',
      'aria-label': `${marks}, created in cycle ${node.created}, carried by ${node.carriers} robots`,
    }, group);
    svg('circle', { class: 'target', cx: x, cy: y, r: 9 }, element);
    svg('circle', {
      class: isSplit ? 'split' : 'join', cx: x, cy: y, r: isSplit ? 4.5 : 3.5, stroke: this.colourOf(node),
    }, element);
    if (node.tips > 0 && this.laneHeight >= TREE.laneLeast) {
      const label = svg('text', { x: this.x(this.recording.cycles) + 8, y: y + 4, class: 'tip' }, element);
      label.textContent = `${this.recording.mark(node.genes[0])} `;
      svg('tspan', {}, label).textContent = `× ${node.tips}`;
    }
    element.addEventListener('pointerenter', () => this.describe(node));
    element.addEventListener('pointerleave', () => this.describe(this.nodeOf.get(this.gene)));
    element.addEventListener('focus', () => this.describe(node));
    const pick = () => this.choose(node.genes[0]);
    element.addEventListener('click', pick);
    element.addEventListener('keydown', (event) => {
      if (event.key !== 'Enter' && event.key !== ' ') return;
      event.preventDefault();
      event.stopPropagation();
      pick();
    });
    node.element = element;
  }

  /** Says in words what a node is; undefined: what there is to do. */
  describe(node) {
    const caption = document.getElementById('node');
    if (!node) {
      caption.textContent = 'Point at a node to read about its genes; click to follow them through the swarm above. '
        + 'Filled nodes are new neurons, each with its two connections; rings are new connections.';
    } else {
      const { recording } = this;
      caption.textContent = `${node.genes.map((gene) => recording.mark(gene)).join(', ')}: `
        + describeOrigin(recording, node.genes[0])
        + ` ${node.carriers} of ${recording.robots} robots carry ${node.genes.length > 1 ? 'them' : 'it'} in the end.`;
    }
    this.highlight(node);
  }

  /** Shows a node with all before it and after it; undefined: the chosen gene's, or all. */
  highlight(shown = this.nodeOf.get(this.gene)) {
    const kin = new Set();
    const after = (node) => {
      kin.add(node);
      node.children.forEach(after);
    };
    if (shown) {
      after(shown);
      for (let node = shown.parent; node; node = node.parent) kin.add(node);
    }
    for (const node of this.nodes) {
      const isPale = shown && !kin.has(node);
      for (const part of [node.element, ...node.paths]) part.classList.toggle('pale', Boolean(isPale));
      for (const base of node.bases) {
        base.classList.toggle('strong', node === shown);
        base.classList.toggle('pale', Boolean(shown) && node !== shown);
      }
      node.element.classList.toggle('chosen', this.nodeOf.get(this.gene) === node);
    }
  }

  show(gene) {
    this.gene = gene;
    if (!this.isEmpty) this.describe(this.nodeOf.get(gene));
  }

  draw(cycle) {
    if (this.isEmpty) return;
    const x = this.x(cycle).toFixed(1);
    if (this.now.getAttribute('x1') === x) return;
    this.now.setAttribute('x1', x);
    this.now.setAttribute('x2', x);
  }
}

/** A sentence: what a gene is, when it was created, by whom, and upon what. */
function describeOrigin(recording, gene) {
  const { genes } = recording;
  const name = (other) => (other < recording.genesis ? `${recording.mark(other)} of the initial network` : recording.mark(other));
  const upon = genes.upon[gene].map(name);
  const what = genes.kind[gene] === 0
    ? `a neuron${upon.length > 0 ? ` that splits connection ${upon[0]}` : ''}`
    : `a ${recording.kind(gene)} from ${upon[0]} to ${upon[1] === upon[0] ? 'itself' : upon[1]}`;
  const times = genes.marked[gene] > 1 ? ` The same mark was given ${genes.marked[gene]} times.` : '';
  return `${what}; created in cycle ${grouped(genes.created[gene])} by robot ${genes.creator[gene]}.${times}`;
}
