import type { Cloud, LoadedCloud, PreparedCloud, Values } from "./cloud.ts";
import { spacingOf, spreadOf } from "./spacing.ts";

/** Makes a cloud ready to draw. It is slow for many points, so call it in a worker, not in the page's thread. */
export function prepareCloud({
  positions,
  colors,
  attributes = [],
  fields = attributes,
  facts = {},
  origin,
  ...said
}: LoadedCloud): PreparedCloud {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < positions.length; i += 3) {
    for (let axis = 0; axis < 3; axis++) {
      const value = positions[i + axis]!;
      if (value < low[axis]!) low[axis] = value;
      if (value > high[axis]!) high[axis] = value;
    }
  }
  const center = low.map((value, axis) => value / 2 + high[axis]! / 2) as [number, number, number];

  // The subtraction happens in f64: a georeferenced cloud keeps its millimeters on the graphics card.
  const local = new Float32Array(positions.length);
  for (let i = 0; i < positions.length; i++) local[i] = positions[i]! - center[i % 3]!;

  const size = high.map((value, axis) => value - low[axis]!) as [number, number, number];
  const radius = Math.hypot(...size) / 2;
  const body = bodyOf(local, size);
  const [x, y, z] = body?.size ?? size;
  // The view needs a size, even if there is only one point, or all points are equal.
  const cloud = {
    colors,
    attributes,
    fields,
    facts,
    origin: origin ?? null,
    count: positions.length / 3,
    center,
    local,
    size,
    radius: radius > 0 ? radius : 1,
    body,
    spacing: spacingOf(local, Math.sqrt((2 * (x * y + y * z + z * x)) / (local.length / 3))),
  };
  return { cloud, positions, copy: positions.slice(), ...said };
}

/** The share of points at either end of an axis that may be strays, and how much larger the whole box is with them. */
const STRAYS = 0.005;
const LARGER = 4;

function bodyOf(local: Float32Array, whole: Cloud["size"]): Cloud["body"] {
  const ends = [0, 1, 2].map((axis) => spreadOf(local.length / 3, (i) => local[3 * i + axis]!, STRAYS));
  const size = ends.map(([low, high]) => high - low) as Cloud["size"];
  const middle = ends.map(([low, high]) => low / 2 + high / 2) as Cloud["center"];
  const length = Math.hypot(...size);
  return length > 0 && Math.hypot(...whole) > LARGER * length ? { middle, size } : null;
}

/** Some points of a cloud, with all that is known about them. `kept`: their indices. */
export function partOf(cloud: LoadedCloud, kept: Uint32Array): LoadedCloud {
  const { positions, colors, attributes = [], fields = attributes } = cloud;
  // Most fields are attributes, too. Then both have the same numbers afterwards, too.
  const done = new Map<Values, Values>();
  const ofKept = <T extends { values: Values }>(column: T): T => {
    const values =
      done.get(column.values) ?? (column.values.length === 1 ? column.values : picked(column.values, kept, 1));
    done.set(column.values, values);
    return { ...column, values };
  };
  return {
    ...cloud,
    origin: cloud.origin ? picked(cloud.origin, kept, 1) : kept,
    positions: picked(positions, kept, 3),
    colors: colors && picked(colors, kept, 3),
    attributes: attributes.map(ofKept),
    fields: fields.map(ofKept),
  };
}

function picked<T extends Values>(values: T, kept: Uint32Array, width: number): T {
  const result = new (values.constructor as new (length: number) => T)(width * kept.length);
  for (let i = 0; i < kept.length; i++) {
    for (let k = 0; k < width; k++) result[width * i + k] = values[width * kept[i]! + k]!;
  }
  return result;
}
