import { allocating } from "../base/memory.js";

/** Lists, after the first numbers of `order`, which ascend, all others below its length, ascending too. */
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
 * The indices of visible points, in memory where those of all others follow: in their own
 * where there is room.
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

/** What `withHidden` has listed: all indices, those of visible points first. */
export function orderIn(indices: Uint32Array<ArrayBuffer>, length: number): Uint32Array<ArrayBuffer> {
  return new Uint32Array(indices.buffer, indices.byteOffset, length);
}

function fits({ buffer, byteOffset }: Uint32Array<ArrayBuffer>, length: number): boolean {
  return buffer.byteLength >= byteOffset + length * Uint32Array.BYTES_PER_ELEMENT;
}
