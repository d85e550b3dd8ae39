'use strict';
// Colours, from the style sheet, so that they follow the reader's light or dark mode.

/** As many lineages as get a colour of their own; further ones share one. */
const LINEAGE_COLOURS = 6;

class Palette {
  constructor() {
    this.refresh();
  }

  refresh() {
    const style = getComputedStyle(document.documentElement);
    const colour = (name) => style.getPropertyValue(`--${name}`).trim();
    for (const name of ['paper', 'ink', 'muted', 'grid', 'panel', 'floor', 'wall', 'item', 'chosen', 'none', 'other']) {
      this[name] = colour(name);
    }
    this.lineages = Array.from({ length: LINEAGE_COLOURS }, (_, i) => colour(`lineage-${i + 1}`));
    this.ramp = ['low', 'middle', 'high'].map((name) => rgb(colour(`ramp-${name}`)));
    this.sans = colour('sans');
  }

  /** From low (0) to high (1), through the middle. */
  onRamp(share) {
    const place = Math.min(Math.max(share, 0), 1) * 2;
    const from = this.ramp[place < 1 ? 0 : 1];
    const to = this.ramp[place < 1 ? 1 : 2];
    const part = place < 1 ? place : place - 1;
    return `rgb(${from.map((value, i) => Math.round(value + (to[i] - value) * part)).join(' ')})`;
  }
}

/** #rrggbb as three numbers. */
function rgb(colour) {
  return [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16));
}

/** Fits a canvas' pixels to its size on the screen; returns its context, scaled to CSS pixels. */
function fitCanvas(canvas) {
  const ratio = window.devicePixelRatio || 1;
  // At least one: a canvas of none cannot be drawn from, and windows can be that narrow for a while.
  const width = Math.max(1, Math.round(canvas.clientWidth * ratio));
  const height = Math.max(1, Math.round(canvas.clientHeight * ratio));
  if (canvas.width !== width) canvas.width = width;
  if (canvas.height !== height) canvas.height = height;
  const context = canvas.getContext('2d');
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  return context;
}
