import { allocating } from "../memory.js";

/** A growing list of numbers. A plain array ends the process at some 110 million numbers. */
export class Numbers {
  #room = new Float64Array(1024);
  #length = 0;

  get length(): number {
    return this.#length;
  }

  at(index: number): number {
    return this.#room[index]!;
  }

  push(value: number): void {
    if (this.#length === this.#room.length) this.#grow();
    this.#room[this.#length++] = value;
  }

  /** All numbers, without a copy. */
  all(): Float64Array<ArrayBuffer> {
    return this.#room.subarray(0, this.#length);
  }

  #grow(): void {
    const room = allocating(`more than ${this.#length} numbers`, () => new Float64Array(2 * this.#length));
    room.set(this.#room);
    this.#room = room;
  }
}
