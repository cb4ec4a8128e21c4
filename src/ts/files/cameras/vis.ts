import { HprError } from "../../base/errors.js";
import { allocating } from "../../base/memory.js";
import type { SeenBy } from "../../query/seen-by.js";

/**
 * Which cameras see each point, as COLMAP's `fused.ply.vis` says it: little-endian, the number of points in 64 bits, then
 * for each point how many images see it, and their numbers from 0, in 32 bits each.
 *
 * @throws HprError `option` for an argument that is no answer of `seenBy`, `too-large`.
 */
export function colmapVis({ offsets, cameras }: Pick<SeenBy, "offsets" | "cameras">): Uint8Array<ArrayBuffer> {
  if (offsets.length === 0 || offsets.at(-1) !== cameras.length) {
    throw new HprError("option", "colmapVis needs what seenBy of a cloud answers");
  }
  const count = offsets.length - 1;
  const file = allocating(`${count} rows`, () => new DataView(new ArrayBuffer(8 + 4 * (count + cameras.length))));
  file.setBigUint64(0, BigInt(count), true);
  let at = 8;
  const put = (number: number) => {
    file.setUint32(at, number, true);
    at += 4;
  };
  for (let i = 0; i < count; i++) {
    const row = cameras.subarray(offsets[i], offsets[i + 1]);
    put(row.length);
    row.forEach(put);
  }
  return new Uint8Array(file.buffer);
}
