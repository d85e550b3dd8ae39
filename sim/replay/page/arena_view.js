'use strict';
// The arena seen from above: walls, items, robots, and who has just heard whom.

/** Frames over which the line of a heard message fades. */
const FADING_FRAMES = 4;

class ArenaView {
  constructor(canvas, recording, palette) {
    this.canvas = canvas;
    this.recording = recording;
    this.palette = palette;
    const [width, height] = recording.arena.size_px;
    canvas.style.aspectRatio = `${width} / ${height}`;
    this.places = new Float32Array(2 * recording.robots);
    this.backdrop = document.createElement('canvas');
    this.resize();
  }

  /** To be called when the size or the palette has changed. */
  resize() {
    this.context = fitCanvas(this.canvas);
    this.scale = this.canvas.clientWidth / this.recording.arena.size_px[0];
    this.backdrop.width = this.canvas.width;
    this.backdrop.height = this.canvas.height;
    const context = this.backdrop.getContext('2d');
    const pixels = this.canvas.width / this.recording.arena.size_px[0];
    context.setTransform(pixels, 0, 0, pixels, 0, 0);
    this.drawWalls(context);
  }

  /** What `draw` shows, as an SVG file. */
  svg(scene, title) {
    const context = new SvgContext(this.canvas.clientWidth, this.canvas.clientHeight);
    context.scaled(this.scale, () => this.drawWalls(context));
    this.drawThings(context, scene);
    return context.text(title);
  }

  drawWalls(context) {
    const { size_px: [width, height], frame_px: frame, walls_px: walls } = this.recording.arena;
    context.fillStyle = this.palette.wall;
    context.fillRect(0, 0, width, height);
    context.fillStyle = this.palette.floor;
    context.fillRect(frame.left, frame.top, width - frame.left - frame.right,
      height - frame.top - frame.bottom);
    context.strokeStyle = this.palette.wall;
    for (const [x1, y1, x2, y2, thickness] of walls) {
      context.lineWidth = thickness;
      context.beginPath();
      context.moveTo(x1, y1);
      context.lineTo(x2, y2);
      context.stroke();
    }
  }

  /** Where the robots are between two frames, in CSS pixels. */
  placeRobots(position) {
    const { frames, robots } = this.recording;
    const frame = Math.min(Math.floor(position), frames.count - 1);
    const next = Math.min(frame + 1, frames.count - 1);
    const part = position - frame;
    const scale = frames.placePx * this.scale;
    for (let robot = 0; robot < robots; ++robot) {
      const before = frame * robots + robot;
      const after = next * robots + robot;
      this.places[2 * robot] = scale * (frames.x[before] + part * (frames.x[after] - frames.x[before]));
      this.places[2 * robot + 1] = scale * (frames.y[before] + part * (frames.y[after] - frames.y[before]));
    }
  }

  /** `colours`: one for each robot. `hollow`: null, or whether each is drawn in outline. `lit`: null,
   *  or whether each carries the chosen gene. */
  draw(scene) {
    const context = this.context;
    context.save();
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.drawImage(this.backdrop, 0, 0);
    context.restore();
    this.drawThings(context, scene);
  }

  drawThings(context, { position, colours, hollow, lit, messages, marked }) {
    this.placeRobots(position);
    const frame = Math.floor(position);
    this.drawItems(context, frame);
    if (messages) this.drawMessages(context, position, lit);
    for (const wanted of lit ? [false, true] : [null]) {
      for (let robot = 0; robot < this.recording.robots; ++robot) {
        if (lit && lit[robot] !== wanted) continue;
        this.drawRobot(context, robot, frame, colours[robot], Boolean(lit) && wanted, Boolean(hollow) && hollow[robot]);
      }
    }
    for (const { robot, isKept } of marked) this.drawMarker(context, robot, isKept);
  }

  drawItems(context, frame) {
    const { frames, items } = this.recording;
    const scale = frames.placePx * this.scale;
    const radius = this.recording.data.item_radius_px * this.scale;
    context.fillStyle = this.palette.item;
    for (let i = frame * items; i < (frame + 1) * items; ++i) {
      if (frames.itemX[i] < 0) continue;
      context.beginPath();
      context.arc(scale * frames.itemX[i], scale * frames.itemY[i], radius, 0, 2 * Math.PI);
      context.fill();
    }
  }

  drawMessages(context, position, lit) {
    const { frames, robots } = this.recording;
    const frame = Math.floor(position);
    context.lineWidth = 1;
    for (let heard = Math.max(0, frame - FADING_FRAMES + 1); heard <= frame; ++heard) {
      const freshness = 1 - (position - heard) / FADING_FRAMES;
      for (let i = frames.heardBegin[heard]; i < frames.heardBegin[heard + 1]; ++i) {
        const sender = Math.floor(frames.heardPairs[i] / robots);
        const receiver = frames.heardPairs[i] % robots;
        const tellsChosen = lit && lit[sender];
        context.globalAlpha = freshness * (tellsChosen ? 0.95 : lit ? 0.3 : 0.6);
        context.strokeStyle = tellsChosen ? this.palette.chosen : this.palette.muted;
        context.beginPath();
        context.moveTo(this.places[2 * sender], this.places[2 * sender + 1]);
        context.lineTo(this.places[2 * receiver], this.places[2 * receiver + 1]);
        context.stroke();
      }
    }
    context.globalAlpha = 1;
  }

  /** A diamond, as the simulated body is, with a nose towards its heading. */
  drawRobot(context, robot, frame, colour, isLit, isHollow) {
    const { frames, robots } = this.recording;
    const x = this.places[2 * robot];
    const y = this.places[2 * robot + 1];
    const radius = Math.max(this.recording.data.robot_radius_px * this.scale, 4.2) * (isLit ? 1.2 : 1);
    const turn = 2 * Math.PI * frames.heading[frame * robots + robot] / frames.headings;
    if (isLit) {
      context.fillStyle = colour;
      context.globalAlpha = 0.22;
      context.beginPath();
      context.arc(x, y, 2.6 * radius, 0, 2 * Math.PI);
      context.fill();
      context.globalAlpha = 1;
    }
    context.strokeStyle = context.fillStyle = colour;
    context.lineWidth = 1.2;
    context.beginPath();
    context.moveTo(x, y);
    context.lineTo(x + 1.9 * radius * Math.cos(turn), y + 1.9 * radius * Math.sin(turn));
    context.stroke();
    if (isHollow) context.fillStyle = this.palette.floor;
    context.beginPath();
    context.moveTo(x - radius, y);
    context.lineTo(x, y - radius);
    context.lineTo(x + radius, y);
    context.lineTo(x, y + radius);
    context.closePath();
    context.fill();
    if (isHollow) context.stroke();
  }

  drawMarker(context, robot, isKept) {
    const x = this.places[2 * robot];
    const y = this.places[2 * robot + 1];
    context.strokeStyle = this.palette.ink;
    context.lineWidth = isKept ? 2 : 1.2;
    context.beginPath();
    context.arc(x, y, 11, 0, 2 * Math.PI);
    context.stroke();
    context.font = `600 12px ${this.palette.sans}`;
    context.textBaseline = 'middle';
    const isLeft = x > this.canvas.clientWidth - 50;
    context.textAlign = isLeft ? 'right' : 'left';
    const text = String(robot + 1);
    context.lineWidth = 3;
    context.strokeStyle = this.palette.floor;
    context.strokeText(text, x + (isLeft ? -16 : 16), y);
    context.fillStyle = this.palette.ink;
    context.fillText(text, x + (isLeft ? -16 : 16), y);
  }

  /** The robot at a place on the canvas, or null. */
  robotAt(x, y, reach) {
    let nearest = null;
    let least = reach * reach;
    for (let robot = 0; robot < this.recording.robots; ++robot) {
      const dx = this.places[2 * robot] - x;
      const dy = this.places[2 * robot + 1] - y;
      if (dx * dx + dy * dy > least) continue;
      least = dx * dx + dy * dy;
      nearest = robot;
    }
    return nearest;
  }
}
