'use strict';
// Swarm fitness over time; below it, who the swarm is made of: lineages, or carriers of a gene.

const TIMELINE = { left: 34, right: 8, top: 16, fitness: 92, gap: 30, strip: 46, bottom: 20 };

class TimelineView {
  constructor(canvas, recording, palette) {
    this.canvas = canvas;
    this.recording = recording;
    this.palette = palette;
    this.gene = null;
    const { top, fitness, gap, strip, bottom } = TIMELINE;
    canvas.style.height = `${top + fitness + gap + strip + bottom}px`;
    this.backdrop = document.createElement('canvas');
    this.resize();
  }

  get plotWidth() {
    return this.canvas.clientWidth - TIMELINE.left - TIMELINE.right;
  }

  xOf(cycle) {
    const { from, to } = this.recording.frames;
    return TIMELINE.left + this.plotWidth * (cycle - from) / (to - from);
  }

  cycleAt(x) {
    const { from, to } = this.recording.frames;
    return from + (to - from) * Math.min(Math.max((x - TIMELINE.left) / this.plotWidth, 0), 1);
  }

  /** The gene whose carriers the strip shows; null for lineages. */
  show(gene) {
    this.gene = gene;
    this.resize();
  }

  resize() {
    this.context = fitCanvas(this.canvas);
    this.backdrop.width = this.canvas.width;
    this.backdrop.height = this.canvas.height;
    const context = this.backdrop.getContext('2d');
    const ratio = window.devicePixelRatio || 1;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.drawAxes(context);
    this.drawFitness(context);
    this.drawStrip(context);
  }

  drawAxes(context) {
    const { top, fitness, gap, strip, left, right } = TIMELINE;
    const { from, to } = this.recording.frames;
    const end = this.canvas.clientWidth - right;
    context.font = `11px ${this.palette.sans}`;
    context.lineWidth = 1;
    context.textBaseline = 'middle';
    context.textAlign = 'right';
    for (const energy of roundSteps(0, this.recording.data.energy_maximum, 4)) {
      const y = Math.round(this.yOfFitness(energy)) + 0.5;
      this.line(context, this.palette.grid, left, y, end, y);
      context.fillStyle = this.palette.muted;
      context.fillText(grouped(energy), left - 6, y);
    }
    const base = top + fitness + gap + strip;
    context.textBaseline = 'top';
    for (const cycle of roundSteps(from, to, Math.max(2, this.plotWidth / 90))) {
      const x = this.xOf(cycle);
      context.textAlign = x > end - 24 ? 'right' : 'center';
      this.line(context, this.palette.grid, x, top, x, top + fitness);
      context.fillText(grouped(cycle), Math.min(x, end), base + 6);
    }
    context.font = `600 11px ${this.palette.sans}`;
    context.fillStyle = this.palette.ink;
    context.textAlign = 'left';
    context.textBaseline = 'bottom';
    context.fillText('Swarm fitness', left, top - 3);
    context.fillText(this.gene === null ? 'Robots by lineage'
      : `Robots that carry ${this.recording.mark(this.gene)}`, left, top + fitness + gap - 4);
  }

  line(context, colour, x1, y1, x2, y2) {
    context.strokeStyle = colour;
    context.beginPath();
    context.moveTo(x1, y1);
    context.lineTo(x2, y2);
    context.stroke();
  }

  yOfFitness(energy) {
    return TIMELINE.top + TIMELINE.fitness * (1 - energy / this.recording.data.energy_maximum);
  }

  drawFitness(context) {
    const { cycle, swarm_fitness: fitness } = this.recording.data.samples;
    context.save();
    context.beginPath();
    context.rect(TIMELINE.left, 0, this.plotWidth, TIMELINE.top + TIMELINE.fitness + 1);
    context.clip();
    context.strokeStyle = this.palette.ink;
    context.lineWidth = 1.5;
    context.lineJoin = 'round';
    context.beginPath();
    cycle.forEach((at, i) => context.lineTo(this.xOf(at), this.yOfFitness(fitness[i])));
    context.stroke();
    context.restore();
  }

  /** Areas, one above the other. */
  drawStrip(context) {
    const { recording, palette } = this;
    const steps = Math.max(1, Math.round(this.plotWidth / 2));
    const shown = recording.lineages.slice(0, LINEAGE_COLOURS);
    const areas = this.gene === null
      ? recording.robotsOverTime((set) => Math.min(recording.lineageOf[set], shown.length), shown.length + 1, steps)
      : recording.robotsOverTime((set) => (recording.geneSets[set].includes(this.gene) ? 0 : -1), 1, steps);
    const colours = this.gene === null ? [...palette.lineages.slice(0, shown.length), palette.other] : [palette.chosen];
    const base = TIMELINE.top + TIMELINE.fitness + TIMELINE.gap + TIMELINE.strip;
    const x = (step) => TIMELINE.left + this.plotWidth * step / steps;
    const height = (robots) => TIMELINE.strip * robots / recording.robots;
    context.fillStyle = palette.panel;
    context.fillRect(TIMELINE.left, base - TIMELINE.strip, this.plotWidth, TIMELINE.strip);
    const below = new Float32Array(steps + 1);
    areas.forEach((robots, i) => {
      context.fillStyle = colours[i];
      context.beginPath();
      for (let step = 0; step <= steps; ++step) context.lineTo(x(step), base - height(below[step]));
      for (let step = steps; step >= 0; --step) {
        below[step] += robots[step];
        context.lineTo(x(step), base - height(below[step]));
      }
      context.fill();
    });
    context.fillStyle = palette.muted;
    context.font = `11px ${palette.sans}`;
    context.textAlign = 'right';
    context.textBaseline = 'middle';
    context.fillText(grouped(recording.robots), TIMELINE.left - 6, base - TIMELINE.strip + 5);
    context.fillText('0', TIMELINE.left - 6, base - 4);
  }

  draw(cycle) {
    const context = this.context;
    context.clearRect(0, 0, this.canvas.clientWidth, this.canvas.clientHeight);
    context.save();
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.drawImage(this.backdrop, 0, 0);
    context.restore();
    const x = this.xOf(cycle);
    const base = TIMELINE.top + TIMELINE.fitness + TIMELINE.gap + TIMELINE.strip;
    context.lineWidth = 1.5;
    this.line(context, this.palette.chosen, x, TIMELINE.top - 4, x, base);
    const y = this.yOfFitness(this.recording.fitnessAt(cycle));
    context.fillStyle = this.palette.chosen;
    context.strokeStyle = this.palette.paper;
    context.beginPath();
    context.arc(x, y, 4.5, 0, 2 * Math.PI);
    context.fill();
    context.stroke();
  }
}

/** Round numbers from one to another, about as many as wanted. */
function roundSteps(from, to, wanted) {
  const rough = (to - from) / wanted;
  const scale = 10 ** Math.floor(Math.log10(rough));
  const step = scale * [1, 2, 5, 10].find((leading) => leading * scale >= rough);
  const steps = [];
  for (let i = Math.ceil(from / step); i * step <= to; ++i) steps.push(i * step);
  return steps;
}
