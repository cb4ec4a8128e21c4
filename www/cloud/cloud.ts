import type { Field, FileFacts } from "./facts.ts";

/** Numbers of one type. They have as many bytes as in the file. */
export type Values =
  Int8Array | Uint8Array | Int16Array | Uint16Array | Int32Array | Uint32Array | Float32Array | Float64Array;

/** The direction that is up in a file's coordinates. */
export type Up = "y" | "z" | "-y";

/** A number for each point, for example its intensity, its class or its time. */
export interface Attribute {
  name: string;
  /** Categories are a few whole numbers whose order means nothing. */
  kind: "scalar" | "category";
  values: Values;
  /** The meaning of a category's numbers, if it is known. */
  labels?: Readonly<Record<number, string>>;
}

/** The result of a loader: the file's own coordinates, and its colors (sRGB bytes), if it has any. */
export interface LoadedCloud {
  positions: Float32Array | Float64Array;
  colors: Uint8Array | null;
  attributes?: Attribute[];
  /** All columns besides positions and colors in bytes. If this is missing, they are the attributes. */
  fields?: Field[];
  facts?: FileFacts;
  /** Whether the points are the rows and columns of a picture. Then points without a position are usual. */
  isGrid?: boolean;
  /** Whether the file has faces, and the positions are all of its vertices in the order of the file. */
  isMesh?: boolean;
  /** Sentences about the cloud that the user has to read. */
  notes?: string[];
  /** How the cloud was measured, if the file says so: the direction that was up, and the place of the scanner. */
  taken?: { up: Up; from?: [number, number, number] };
}

/** A cloud ready to draw: recentered in f32 for the graphics card. The file's own coordinates go to the hull's worker. */
export interface Cloud {
  count: number;
  colors: Uint8Array | null;
  attributes: readonly Attribute[];
  /** All columns of the file besides positions and colors in bytes. */
  fields: readonly Field[];
  facts: FileFacts;
  /** Center of the bounding box in the file's coordinates; local = file − center. */
  center: [number, number, number];
  local: Float32Array;
  /** Width, height and depth of the bounding box, and half its diagonal. */
  size: [number, number, number];
  radius: number;
}

/** A cloud ready to draw, with the file's own coordinates and the loader's words about it. */
export interface PreparedCloud extends Pick<LoadedCloud, "positions" | "isMesh" | "notes" | "taken"> {
  cloud: Cloud;
  /** A copy of the positions for the hull's worker, which keeps what it gets. */
  copy: Float32Array | Float64Array;
}

/** Makes a cloud ready to draw. It is slow for many points, so call it in a worker, not in the page's thread. */
export function prepareCloud({
  positions,
  colors,
  attributes = [],
  fields = attributes,
  facts = {},
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
  // The view needs a size, even if there is only one point, or all points are equal.
  const cloud = {
    colors,
    attributes,
    fields,
    facts,
    count: positions.length / 3,
    center,
    local,
    size,
    radius: radius > 0 ? radius : 1,
  };
  return { cloud, positions, copy: positions.slice(), ...said };
}

export function upVector(up: Up): [number, number, number] {
  return up === "z" ? [0, 0, 1] : [0, up === "y" ? 1 : -1, 0];
}
