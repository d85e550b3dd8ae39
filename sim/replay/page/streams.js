'use strict';
// The bytes of a recording; sim/replay/number_stream.hpp writes them.

/** Reads numbers from bytes in base64. */
class NumberReader {
  constructor(text) {
    const characters = atob(text);
    this.bytes = Uint8Array.from(characters, (character) => character.charCodeAt(0));
    this.at = 0;
  }

  /** A whole number from 0 on. */
  next() {
    let value = 0;
    let scale = 1;
    for (;;) {
      if (this.at >= this.bytes.length) throw new Error('the recording is cut short');
      const byte = this.bytes[this.at++];
      value += (byte & 0x7f) * scale;
      if (byte < 0x80) return value;
      scale *= 0x80;
    }
  }

  /** A whole number, of which even ones on the wire are positive. */
  nextSigned() {
    const folded = this.next();
    return folded % 2 === 0 ? folded / 2 : -(folded + 1) / 2;
  }

  end() {
    if (this.at !== this.bytes.length) throw new Error('the recording has too many bytes');
  }
}

/** Rows that are stored as differences from the one above, into an array of that type. */
function readRows(text, rows, columns, ArrayType) {
  const reader = new NumberReader(text);
  const values = new ArrayType(rows * columns);
  const above = new Float64Array(columns);
  for (let i = 0; i < values.length; ++i) {
    values[i] = above[i % columns] += reader.nextSigned();
  }
  reader.end();
  return values;
}

/** The first index from which `isBeyond` holds, where it holds from some index to the end. */
function firstIndex(length, isBeyond) {
  let low = 0;
  let high = length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (isBeyond(middle)) high = middle;
    else low = middle + 1;
  }
  return low;
}
