/**
 * The number of buffers to keep. Two are in use by turns if an answer is recycled when the next one is
 * shown.
 */
const USUAL = 2;

/** The memory of answers that nobody reads any more. Later answers use it again. */
export class Spares {
  readonly #buffers: ArrayBuffer[] = [];

  /** Adds a buffer. Only the largest buffers are kept. */
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
 * Memory for `length` indices. The start of `spare` is used if it is large enough. If it is too small,
 * new memory is made with some room to spare, since the next answer may be a little longer.
 */
export function roomIn(spare: ArrayBuffer | undefined, length: number): Uint32Array<ArrayBuffer> {
  if (spare === undefined) {
    return new Uint32Array(length);
  }
  const bytes = length * Uint32Array.BYTES_PER_ELEMENT;
  const buffer = spare.byteLength >= bytes ? spare : new ArrayBuffer(bytes + 4 * Math.floor(length / 8));
  return new Uint32Array(buffer, 0, length);
}
