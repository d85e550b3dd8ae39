'use strict';
// Draws as a canvas does, but writes SVG: so that a picture can be printed at any size. It knows what
// the arena's view uses, and no more.

class SvgContext {
  constructor(width, height) {
    this.width = width;
    this.height = height;
    this.parts = [];
    this.path = '';
    Object.assign(this, { fillStyle: '#000', strokeStyle: '#000', lineWidth: 1, globalAlpha: 1,
      font: '12px sans-serif', textAlign: 'left', textBaseline: 'alphabetic' });
  }

  beginPath() { this.path = ''; }
  moveTo(x, y) { this.path += `M${short(x)} ${short(y)}`; }
  lineTo(x, y) { this.path += `${this.path ? 'L' : 'M'}${short(x)} ${short(y)}`; }
  closePath() { this.path += 'Z'; }

  /** Whole circles only. */
  arc(x, y, radius) {
    const [r, left, right] = [short(radius), short(x - radius), short(x + radius)];
    this.path += `M${right} ${short(y)}A${r} ${r} 0 1 1 ${left} ${short(y)}A${r} ${r} 0 1 1 ${right} ${short(y)}Z`;
  }

  fill() { this.add('path', { d: this.path, fill: this.fillStyle }); }
  stroke() { this.add('path', { d: this.path, ...this.outline() }); }
  fillRect(x, y, width, height) { this.add('rect', { x, y, width, height, fill: this.fillStyle }); }
  fillText(text, x, y) { this.addText(text, x, y, { fill: this.fillStyle }); }
  strokeText(text, x, y) { this.addText(text, x, y, this.outline()); }

  outline() {
    return { fill: 'none', stroke: this.strokeStyle, 'stroke-width': short(this.lineWidth) };
  }

  addText(text, x, y, look) {
    const anchor = { left: 'start', center: 'middle', right: 'end' }[this.textAlign];
    const baseline = { middle: 'central', top: 'hanging' }[this.textBaseline] ?? 'auto';
    this.add('text', { x: short(x), y: short(y), style: `font: ${this.font}`, 'text-anchor': anchor,
      'dominant-baseline': baseline, ...look }, text);
  }

  add(tag, attributes, text = '') {
    const look = this.globalAlpha < 1 ? { ...attributes, opacity: short(this.globalAlpha) } : attributes;
    const written = Object.entries(look).map(([name, value]) => ` ${name}="${escaped(String(value))}"`).join('');
    this.parts.push(text ? `<${tag}${written}>${escaped(text)}</${tag}>` : `<${tag}${written}/>`);
  }

  /** All that `draw` adds, as many times as large. */
  scaled(factor, draw) {
    this.parts.push(`<g transform="scale(${factor})">`);
    draw();
    this.parts.push('</g>');
  }

  /** The finished file. */
  text(title) {
    const size = `width="${short(this.width)}" height="${short(this.height)}" viewBox="0 0 ${short(this.width)} ${short(this.height)}"`;
    return `<svg xmlns="http://www.w3.org/2000/svg" ${size}>\n<title>${escaped(title)}</title>\n${this.parts.join('\n')}\n</svg>\n`;
  }
}

/** A number with two decimals at most. */
function short(number) {
  return Math.round(100 * number) / 100;
}

function escaped(text) {
  return text.replace(/[&<>"]/g, (sign) => `&#${sign.charCodeAt(0)};`);
}
