import { allocating } from "../base/memory.js";
import { roomIn } from "../cloud/spares.js";
import type { Replies } from "./protocol.js";

/** The answer for one sector of a view. */
export type Part = Replies["visibleFrom"] | Replies["visibleFromCamera"];

/**
 * Joins the answers for all sectors of a view into one. Nobody else sees the parts, so the members
 * reuse their memory for the next view.
 */
export class Sectors {
  /** The parts by sector. */
  #spares: (ArrayBuffer | undefined)[] = [];
  /** One mark for each index. All marks are 0 between views. */
  #bits = new Int32Array(0);

  /** Memory for a part. It is given away. */
  spareFor(sector: number): ArrayBuffer | undefined {
    const spare = this.#spares[sector];
    this.#spares[sector] = undefined;
    return spare;
  }

  /**
   * The indices of all parts, in the order of their sectors. They are written into `spare` if that
   * is large enough.
   */
  joined(parts: Part[], spare: ArrayBuffer | undefined): Part {
    const [first] = parts as [Part];
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
    const joined = { ...first, indices, ...joinedPixels(parts, indices) };
    this.#spares = parts.map((part) => part.indices.buffer);
    return joined;
  }
}

/** The pixels and depths of all parts, in the order of the joined indices. */
function joinedPixels(parts: Part[], indices: Uint32Array): object {
  const photographs = parts.filter((part) => "pixels" in part);
  if (photographs.length === 0) {
    return {};
  }
  const { length } = indices;
  const [pixels, depths] = allocating(`${3 * length} numbers`, () => [
    new Float32Array(2 * length),
    new Float32Array(length),
  ]);
  // Every index is the next one of exactly one part.
  const next = photographs.map(() => 0);
  for (let at = 0; at < length; at++) {
    const number = photographs.findIndex((part, number) => part.indices[next[number]!] === indices[at]);
    const { pixels: from, depths: deep } = photographs[number]!;
    const own = next[number]!++;
    pixels.set(from.subarray(2 * own, 2 * own + 2), 2 * at);
    depths[at] = deep[own]!;
  }
  return { pixels, depths };
}

/**
 * This loop runs in the page's own thread, also for the first view, so it must be fast without
 * warming up.
 */
function mark(bits: Int32Array, indices: Uint32Array): void {
  for (let i = 0; i < indices.length; i++) {
    const index = indices[i]!;
    bits[index >>> 5]! |= 1 << (index & 31);
  }
}

/** All marked indices, ascending. Their marks are cleared. */
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
