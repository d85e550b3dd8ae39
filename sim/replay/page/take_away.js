'use strict';
// What the reader can take away: the picture as SVG or PNG, a film.

const FILM_TYPE = 'video/webm';
const FILM_PICTURES_PER_SECOND = 30;

/** Hands a file to the reader's browser, to keep. */
function download(blob, name) {
  const address = URL.createObjectURL(blob);
  const link = make('a', { href: address, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  // The browser reads the file after this function has returned.
  setTimeout(() => URL.revokeObjectURL(address), 60000);
}

class TakeAway {
  constructor(player) {
    this.player = player;
    this.recorder = null;
    byId('save-svg').addEventListener('click', () => this.saveSvg());
    byId('save-png').addEventListener('click', () => this.savePng());
    byId('film').addEventListener('click', () => (this.recorder ? this.player.play(false) : this.film()));
    if (typeof MediaRecorder === 'undefined' || !MediaRecorder.isTypeSupported(FILM_TYPE)) {
      byId('film').disabled = true;
      byId('film').title = 'This browser cannot record films';
    }
  }

  name(extension) {
    const { data } = this.player.recording;
    return `${data.task}-${data.source}-cycle-${Math.round(this.player.cycle)}.${extension}`;
  }

  saveSvg() {
    const text = this.player.arena.svg(this.player.scene(), `${byId('title').textContent}, cycle ${Math.round(this.player.cycle)}`);
    download(new Blob([text], { type: 'image/svg+xml' }), this.name('svg'));
  }

  savePng() {
    const name = this.name('png');
    byId('arena').toBlob((blob) => download(blob, name), 'image/png');
  }

  /** Plays from here to the end, or until the reader stops it, and keeps what the arena shows. */
  film() {
    const parts = [];
    const name = this.name('webm');
    const recorder = new MediaRecorder(byId('arena').captureStream(FILM_PICTURES_PER_SECOND), { mimeType: FILM_TYPE });
    recorder.addEventListener('dataavailable', ({ data }) => parts.push(data));
    recorder.addEventListener('stop', () => {
      this.recorder = null;
      byId('film').textContent = 'Film';
      download(new Blob(parts, { type: FILM_TYPE }), name);
    });
    this.recorder = recorder;
    byId('film').textContent = 'End film';
    recorder.start(1000);
    this.player.play(true);
  }

  /** To be called when playing has ended. */
  playingEnded() {
    if (this.recorder && this.recorder.state !== 'inactive') this.recorder.stop();
  }
}
