import { allocating } from "../base/memory.js";

/**
 * Completes `order` to a list of all indices below its length. Its first `visible` numbers are given
 * in ascending order. The others are written after them, also in ascending order.
 */
export function listHidden(order: Uint32Array, visible: number): void {
  const total = order.length;
  let at = visible;
  let next = 0;
  for (let i = 0; i <= visible; i++) {
    const end = i < visible ? order[i]! : total;
    while (next < end) order[at++] = next++;
    next++;
  }
}

/**
 * The indices of visible points, in memory where the indices of all other points follow. This is the
 * same memory as before if it has room.
 */
export function withHidden(indices: Uint32Array<ArrayBuffer>, length: number): Uint32Array<ArrayBuffer> {
  const order = fits(indices, length)
    ? orderIn(indices, length)
    : allocating(`${length} indices`, () => new Uint32Array(length));
  if (order.buffer !== indices.buffer) {
    order.set(indices);
  }
  listHidden(order, indices.length);
  return order.subarray(0, indices.length);
}

/** All indices that `withHidden` has listed. The indices of visible points come first. */
export function orderIn(indices: Uint32Array<ArrayBuffer>, length: number): Uint32Array<ArrayBuffer> {
  return new Uint32Array(indices.buffer, indices.byteOffset, length);
}

function fits({ buffer, byteOffset }: Uint32Array<ArrayBuffer>, length: number): boolean {
  return buffer.byteLength >= byteOffset + length * Uint32Array.BYTES_PER_ELEMENT;
}
