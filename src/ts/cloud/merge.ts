import { describe, HprError } from "../base/errors.js";
import { requireInstance } from "../instance/instance.js";
import { allocating } from "../base/memory.js";
import { givenOptions } from "../query/options.js";
import { coreOptions } from "./perform.js";
import { MAX_LENGTH, type Positions, positionsGone, readPositions, readViewpoint } from "../query/positions.js";
import { plainView, typedArrayType } from "../base/typed-arrays.js";
import { Kernel, type ResolvedInversion, Rule, type ViewSettings, viewSettings } from "../query/view-options.js";

/** What is visible in one part of a cloud, or any more of that part. */
export interface VisiblePart {
  /** x, y, z of one point after another, in the units of the whole cloud. */
  positions: Positions;
  /** The caller's own number for each point. */
  ids: Uint32Array;
}

/** How all of the parts were seen. */
export interface MergeOptions {
  /**
   * R of the flipping sphere, in the cloud's units: the same for every part, and at
   * least the distance of the farthest point. With an inversion by power its unit S.
   * There is no default; only an exponential inversion has none.
   */
  radius?: number | undefined;
  /** How every part was flipped, with numbers only. Default `"spherical"`. */
  inversion?: ResolvedInversion | undefined;
}

/**
 * Which points of a cloud are visible, from what is visible in its parts.
 *
 * However the cloud was divided: ask each part (a tile, a worker's share, a
 * server's) from one viewpoint with one radius and inversion, and bring only the
 * visible points together here. visible(A ∪ B) = visible(visible(A) ∪ visible(B)), exactly.
 *
 * @param parts their positions and ids. Equal positions share one answer, in
 *   whichever parts they are.
 * @param viewpoint x, y, z that every part was seen from.
 * @returns the ids of the visible points, ascending, each once.
 * @throws HprError `not-initialised`, `option`, `positions-type`,
 *   `positions-length` (also unless there is one id for each point), `non-finite`
 *   (its index counts through all parts), `viewpoint`, `radius`, `too-large`, `internal`.
 */
export function mergeVisible(
  parts: readonly VisiblePart[],
  viewpoint: ArrayLike<number>,
  options: MergeOptions,
): Uint32Array {
  const instance = requireInstance();
  const [x, y, z] = readViewpoint(viewpoint, 3) as [number, number, number];
  const settings = coreOptions(readSettings(options));
  const { positions, ids } = joined(readParts(parts));
  return instance.call((bindings) =>
    positions.BYTES_PER_ELEMENT === 4
      ? bindings.mergeVisibleF32(positions as Float32Array, ids, x, y, z, settings)
      : bindings.mergeVisibleF64(positions as Float64Array, ids, x, y, z, settings),
  );
}

interface Points {
  positions: Float32Array | Float64Array;
  ids: Uint32Array;
}

interface ReadPart extends Points {
  /** How many points it had when it was read. */
  count: number;
}

function readSettings(options: unknown): ViewSettings {
  const given = givenOptions(options, ["radius", "inversion"]);
  const settings = viewSettings(given, 3);
  if (settings.kernel === Kernel.automaticExponential) {
    throw new HprError("option", `inversion exponential must be the number that all parts were seen with, got "auto"`);
  }
  // With a radius, too: the core says that the two exclude each other.
  const needsRadius = settings.kernel !== Kernel.exponential || given["radius"] !== undefined;
  if (needsRadius && settings.rule !== Rule.radius) {
    throw new HprError(
      "option",
      `radius must be the number that all parts were seen with, got ${describe(given["radius"])}`,
    );
  }
  return settings;
}

function readParts(parts: unknown): ReadPart[] {
  if (!Array.isArray(parts)) {
    throw new HprError("option", `parts must be an array of { positions, ids }, got ${describe(parts)}`);
  }
  const read = Array.from(parts, readPart);
  // A getter of one part may have taken away the memory of an earlier part. From here on no getter runs.
  read.forEach(requireMemory);
  return read;
}

function requireMemory({ positions, ids, count }: ReadPart, number: number): void {
  if (positions.length !== 3 * count) {
    throw inPart(number, positionsGone());
  }
  if (ids.length !== count) {
    throw new HprError("option", `parts[${number}].ids has been transferred away or made smaller`);
  }
}

function readPart(part: unknown, number: number): ReadPart {
  if (typeof part !== "object" || part === null) {
    throw new HprError("option", `parts[${number}] must be { positions, ids }, got ${describe(part)}`);
  }
  const { positions, ids } = part as Partial<Record<"positions" | "ids", unknown>>;
  // Before the ids: only positions in an array of their own kind have getters.
  const ownPositions = readPositionsOf(number, positions);
  const ownIds = typedArrayType(ids) === "Uint32Array" ? plainView(ids as Uint32Array, Uint32Array) : undefined;
  if (ownIds === undefined) {
    throw new HprError(
      "option",
      `parts[${number}].ids must be a Uint32Array, not transferred away, got ${describe(ids)}`,
    );
  }
  const count = ownIds.length;
  if (ownPositions.length !== 3 * count) {
    const message = `expected 3 numbers for each of ${count} ids, got ${ownPositions.length}`;
    throw inPart(number, new HprError("positions-length", message));
  }
  return { positions: ownPositions, ids: ownIds, count };
}

function readPositionsOf(number: number, positions: unknown): Float32Array | Float64Array {
  try {
    return readPositions(positions, 3);
  } catch (cause) {
    throw cause instanceof HprError ? inPart(number, cause) : cause;
  }
}

/** Says which part a refusal is about. */
function inPart(number: number, cause: HprError): HprError {
  return new HprError(cause.code, `parts[${number}]: ${cause.message}`, { cause });
}

/** All parts as one, in single precision only where every part is. */
function joined(parts: ReadPart[]): Points {
  const total = parts.reduce((sum, { count }) => sum + count, 0);
  if (3 * total > MAX_LENGTH) {
    throw new HprError("too-large", `${total} points exceed what this memory can address`);
  }
  const single = parts.every(({ positions }) => positions.BYTES_PER_ELEMENT === 4);
  return allocating(`${total} points`, () => {
    const positions = single ? new Float32Array(3 * total) : new Float64Array(3 * total);
    const ids = new Uint32Array(total);
    let start = 0;
    for (const part of parts) {
      positions.set(part.positions, 3 * start);
      ids.set(part.ids, start);
      start += part.count;
    }
    return { positions, ids };
  });
}
