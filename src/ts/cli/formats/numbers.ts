import { FormatProblem } from "../../formats/problem.js";

/** Numbers one after another, as many as memory holds: an array ends the process at some 110 million. */
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

  /** All of them, in the memory that `push` writes to. */
  all(): Float64Array<ArrayBuffer> {
    return this.#room.subarray(0, this.#length);
  }

  #grow(): void {
    try {
      const room = new Float64Array(2 * this.#length);
      room.set(this.#room);
      this.#room = room;
    } catch (cause) {
      throw new FormatProblem(`no memory for more than ${this.#length} numbers`, { cause });
    }
  }
}
