import { allocating, describe, HprError } from "../base/errors.js";
import { plainView, typedArrayType } from "../base/typed-arrays.js";
import { ownOf } from "./options.js";
import type { SeenBy } from "./surveys.js";

type Normals = Float32Array<ArrayBuffer> | Float64Array<ArrayBuffer>;

/**
 * Turns normals towards the cameras that see their points: the side that most of them look at. In a tie, the sum of
 * the cosines decides. What no camera sees stays as it is, and so does a normal of zeros.
 *
 * @param normals three numbers for each index of the cloud
 * @param seenBy what `seenBy` of the cloud answers
 * @returns new normals of the same type
 * @throws HprError `option` for normals that are of another type or another number, or rows that are none
 */
export function orientNormals<T extends Float32Array | Float64Array>(
  normals: T,
  seenBy: Pick<SeenBy, "offsets" | "towards">,
): T extends Float32Array ? Float32Array<ArrayBuffer> : Float64Array<ArrayBuffer>;
export function orientNormals(
  normals: Float32Array | Float64Array,
  seenBy: Pick<SeenBy, "offsets" | "towards">,
): Normals {
  const own = copied(normals);
  const { offsets, values: towards } = rowsOf(seenBy, "towards", 3, Float32Array);
  if (own.length !== 3 * (offsets.length - 1)) {
    throw new HprError(
      "option",
      `normals must be three numbers for each of ${offsets.length - 1} indices, got ${own.length}`,
    );
  }
  for (let index = 0; index < offsets.length - 1; index++) {
    const [x, y, z] = own.subarray(3 * index, 3 * index + 3) as unknown as [number, number, number];
    let [votes, sum] = [0, 0];
    for (let k = 3 * offsets[index]!; k < 3 * offsets[index + 1]!; k += 3) {
      const cosine = x * towards[k]! + y * towards[k + 1]! + z * towards[k + 2]!;
      votes += Math.sign(cosine);
      sum += cosine;
    }
    if (votes < 0 || (votes === 0 && sum < 0)) own.set([-x, -y, -z], 3 * index);
  }
  return own;
}

function copied(normals: unknown): Normals {
  const type = typedArrayType(normals);
  const plain =
    type === "Float32Array"
      ? plainView(normals as Float32Array, Float32Array)
      : type === "Float64Array"
        ? plainView(normals as Float64Array, Float64Array)
        : undefined;
  if (plain === undefined) {
    throw new HprError(
      "option",
      `normals must be a Float32Array or a Float64Array, not transferred away, got ${describe(normals)}`,
    );
  }
  return allocating(`${plain.length} numbers`, () => plain.slice());
}

/** The rows of `seenBy`, whose offsets rise from 0 to the number of entries, and `width` numbers for each entry. */
export function rowsOf<T extends Float32Array | Uint32Array>(
  given: unknown,
  name: "towards" | "cameras",
  width: number,
  Type: new (buffer: ArrayBufferLike, byteOffset: number, length: number) => T,
): { offsets: Uint32Array; values: T } {
  const isObject = typeof given === "object" && given !== null;
  const [offsets, values] = [isObject && ownOf(given, "offsets"), isObject && ownOf(given, name)];
  const rows = typedArrayType(offsets) === "Uint32Array" ? plainView(offsets as Uint32Array, Uint32Array) : undefined;
  const own = typedArrayType(values) === Type.name ? plainView(values as T, Type) : undefined;
  const isWhole =
    rows?.[0] === 0 &&
    width * rows.at(-1)! === own?.length &&
    rows.every((offset, i, all) => i === 0 || offset >= all[i - 1]!);
  if (!isWhole) throw new HprError("option", `seenBy must be what seenBy of a cloud answers, got ${describe(given)}`);
  return { offsets: rows, values: own };
}
