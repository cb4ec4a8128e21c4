/** Two are in flight where the answer that is shown is given back for the next but one. */
const USUAL = 2;

/** Memory of answers that nobody reads any more, for answers to come. */
export class Spares {
  readonly #buffers: ArrayBuffer[] = [];

  /** Keeps the largest ones. */
  keep(buffer: ArrayBuffer | undefined): void {
    if (buffer !== undefined && buffer.byteLength > 0) {
      this.#buffers.push(buffer);
      this.#buffers.sort((a, b) => b.byteLength - a.byteLength);
      this.#buffers.splice(USUAL);
    }
  }

  take(): ArrayBuffer | undefined {
    return this.#buffers.shift();
  }

  clear(): void {
    this.#buffers.splice(0);
  }
}

/**
 * Room for so many indices: at the start of spare memory, where there is enough of it.
 * Where there was too little, the next answer may be a little longer still.
 */
export function roomIn(spare: ArrayBuffer | undefined, length: number): Uint32Array<ArrayBuffer> {
  if (spare === undefined) {
    return new Uint32Array(length);
  }
  const bytes = length * Uint32Array.BYTES_PER_ELEMENT;
  const buffer = spare.byteLength >= bytes ? spare : new ArrayBuffer(bytes + 4 * Math.floor(length / 8));
  return new Uint32Array(buffer, 0, length);
}
