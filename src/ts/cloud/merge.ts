import { allocating, describe, HprError, naming } from "../base/errors.js";
import { requireInstance } from "../instance/instance.js";
import { givenOptions } from "../query/options.js";
import {
  MAX_LENGTH,
  type Positions,
  positionsGone,
  readPositions,
  readViewpoint,
  type Viewpoint,
} from "../query/positions.js";
import { plainView, typedArrayType } from "../base/typed-arrays.js";
import { Kernel, type ResolvedInversion, Rule, type ViewSettings, viewSettings } from "../query/view-options.js";

/** The visible points of one part of a cloud. It may also contain hidden points of that part. */
export interface VisiblePart {
  /** x, y, z of one point after another, in the units of the whole cloud. */
  positions: Positions;
  /** The caller's own number for each point. */
  ids: Uint32Array;
}

/** How the views of all parts were computed. */
export interface MergeOptions {
  /**
   * R of the flipping sphere, in the cloud's units. It is the same for every part, and at least the
   * distance of the farthest point. With an inversion by power, this is its unit S. It must be
   * given, except with an exponential inversion: there it must be left out.
   */
  radius?: number | undefined;
  /** How every part was flipped, with numbers only. Default `"spherical"`. */
  inversion?: ResolvedInversion | undefined;
}

/**
 * Finds the visible points of a cloud from the visible points of its parts.
 *
 * The cloud may be divided in any way, for instance into tiles or among workers or servers. Ask each
 * part from the same viewpoint with the same radius and inversion. Then pass only the visible points
 * to this function. The answer is exact: visible(A ∪ B) = visible(visible(A) ∪ visible(B)).
 *
 * @param parts their positions and ids. Points at equal positions are all visible or all hidden, also
 *   if they are in different parts.
 * @param viewpoint x, y, z of the viewpoint of every part.
 * @returns the ids of the visible points, ascending, each once.
 * @throws HprError `not-initialised`, `option`, `positions-type`,
 *   `positions-length` (also if the numbers of ids and points differ), `non-finite` (its index
 *   counts through all parts), `viewpoint`, `radius`, `too-large`, `internal`.
 */
export function mergeVisible(parts: readonly VisiblePart[], viewpoint: Viewpoint, options: MergeOptions): Uint32Array {
  const instance = requireInstance();
  const [x, y, z] = readViewpoint(viewpoint, 3) as [number, number, number];
  const settings = mergeSettings(options, "all parts were seen with");
  const { positions, ids } = joined(readParts(parts));
  return instance.call((bindings) => bindings.mergeVisible(positions, ids, x, y, z, settings));
}

interface Points {
  positions: Float32Array | Float64Array;
  ids: Uint32Array;
}

interface ReadPart extends Points {
  /** The number of points when the part was read. */
  count: number;
}

/**
 * The settings of a view whose radius or inversion is a number.
 * @param purpose ends the message "the number that …".
 */
export function mergeSettings(options: unknown, purpose: string): ViewSettings {
  const given = givenOptions(options, ["radius", "inversion"]);
  const settings = viewSettings(given, 3);
  if (settings.kernel === Kernel.automaticExponential) {
    throw new HprError("option", `inversion exponential must be the number that ${purpose}, got "auto"`);
  }
  // A radius is also read with an exponential inversion: the core then refuses the two together.
  const needsRadius = settings.kernel !== Kernel.exponential || given["radius"] !== undefined;
  if (needsRadius && settings.rule !== Rule.radius) {
    throw new HprError("option", `radius must be the number that ${purpose}, got ${describe(given["radius"])}`);
  }
  return settings;
}

function readParts(parts: unknown): ReadPart[] {
  if (!Array.isArray(parts)) {
    throw new HprError("option", `parts must be an array of { positions, ids }, got ${describe(parts)}`);
  }
  const inPart = <T>(number: number, read: () => T) => naming(`parts[${number}]`, read);
  const read = Array.from(parts, (part: unknown, number) => inPart(number, () => readPart(part)));
  // A getter of one part may have taken away the memory of an earlier part. From here on no getter runs.
  for (const [number, part] of read.entries()) inPart(number, () => requireMemory(part));
  return read;
}

function requireMemory({ positions, ids, count }: ReadPart): void {
  if (positions.length !== 3 * count) {
    throw positionsGone();
  }
  if (ids.length !== count) {
    throw new HprError("option", "ids has been transferred away or made smaller");
  }
}

function readPart(part: unknown): ReadPart {
  if (typeof part !== "object" || part === null) {
    throw new HprError("option", `a part must be { positions, ids }, got ${describe(part)}`);
  }
  const { positions, ids } = part as Partial<Record<"positions" | "ids", unknown>>;
  // Positions are read before the ids: only they can be an array-like object with getters.
  const ownPositions = readPositions(positions, 3);
  const ownIds = typedArrayType(ids) === "Uint32Array" ? plainView(ids as Uint32Array, Uint32Array) : undefined;
  if (ownIds === undefined) {
    throw new HprError("option", `ids must be a Uint32Array, not transferred away, got ${describe(ids)}`);
  }
  const count = ownIds.length;
  if (ownPositions.length !== 3 * count) {
    throw new HprError("positions-length", `expected 3 numbers for each of ${count} ids, got ${ownPositions.length}`);
  }
  return { positions: ownPositions, ids: ownIds, count };
}

/** All parts as one. It has single precision only if every part has. */
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
