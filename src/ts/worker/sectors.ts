import { allocating } from "../base/memory.js";
import { roomIn } from "../cloud/spares.js";
import type { Replies } from "./protocol.js";

type Answer = Replies["visibleFrom"];

/**
 * One answer from those for all sectors of a view. Nobody else sees the parts, so their
 * memory goes back to the members for the next view.
 */
export class Sectors {
  /** By sector. */
  #spares: (ArrayBuffer | undefined)[] = [];
  /** One for each index, all 0 between views. */
  #bits = new Int32Array(0);

  /** Memory for a part, given away. */
  spareFor(sector: number): ArrayBuffer | undefined {
    const spare = this.#spares[sector];
    this.#spares[sector] = undefined;
    return spare;
  }

  /** Of all parts, in the order of their sectors; in `spare` memory where that is enough. */
  joined(parts: Answer[], spare: ArrayBuffer | undefined): Answer {
    const [first] = parts as [Answer];
    const count = parts.reduce((sum, { indices }) => sum + indices.length, 0);
    const indices = allocating(`${count} indices`, () => {
      const words = Math.ceil(first.length / 32);
      if (this.#bits.length < words) {
        this.#bits = new Int32Array(words);
      }
      return roomIn(spare, count);
    });
    for (const part of parts) {
      mark(this.#bits, part.indices);
    }
    takeMarked(this.#bits, indices);
    this.#spares = parts.map((part) => part.indices.buffer);
    return { ...first, indices };
  }
}

/** In the page's own thread, for the first view too: a loop that needs no warming up. */
function mark(bits: Int32Array, indices: Uint32Array): void {
  for (let i = 0; i < indices.length; i++) {
    const index = indices[i]!;
    bits[index >>> 5]! |= 1 << (index & 31);
  }
}

/** All that are marked, ascending, no longer marked then. */
function takeMarked(bits: Int32Array, indices: Uint32Array): void {
  let next = 0;
  for (let word = 0; word < bits.length; word++) {
    let rest = bits[word]!;
    bits[word] = 0;
    while (rest !== 0) {
      indices[next++] = (word << 5) + 31 - Math.clz32(rest & -rest);
      rest &= rest - 1;
    }
  }
}
