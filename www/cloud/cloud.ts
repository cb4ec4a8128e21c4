/** Numbers of one kind, as many bytes wide as the file has them. */
export type Values =
  Int8Array | Uint8Array | Int16Array | Uint16Array | Int32Array | Uint32Array | Float32Array | Float64Array;

/** Which way is up in a file's coordinates. */
export type Up = "y" | "z" | "-y";

/** A number for each point: how strongly it sent the light back, what it is part of, when it was seen. */
export interface Attribute {
  name: string;
  /** Categories are whole numbers, few of them, whose order means nothing. */
  kind: "scalar" | "category";
  values: Values;
  /** What a category's numbers stand for, where that is known. */
  labels?: Readonly<Record<number, string>>;
}

/** What a loader hands over: the file's own coordinates, and colors as the file shows them (sRGB bytes), or none. */
export interface LoadedCloud {
  positions: Float32Array | Float64Array;
  colors: Uint8Array | null;
  attributes?: Attribute[];
  /** The file has faces, and all of their corners are among the positions, in its own order. */
  isMesh?: boolean;
  /** What the user has to know about it, in plain sentences. */
  notes?: string[];
  /** What the file says of how it was taken: which way was up, and from where where it knows. */
  taken?: { up: Up; from?: [number, number, number] };
}

/** A cloud ready to draw: recentered in f32 for the graphics card. The file's own coordinates go to the hull's worker. */
export interface Cloud {
  count: number;
  colors: Uint8Array | null;
  attributes: readonly Attribute[];
  /** Center of the bounding box in the file's coordinates; local = file − center. */
  center: [number, number, number];
  local: Float32Array;
  /** Width, height and depth of the bounding box, and half its diagonal. */
  size: [number, number, number];
  radius: number;
}

/** What the page takes over from a loader: a cloud ready to draw, with the file's own coordinates and what it says. */
export interface PreparedCloud extends Pick<LoadedCloud, "positions" | "isMesh" | "notes" | "taken"> {
  cloud: Cloud;
  /** The positions once more, to be given away to the hull's worker: that takes what it gets. */
  copy: Float32Array | Float64Array;
}

/** Goes over all coordinates a few times: for a worker, not for the page's thread. */
export function prepareCloud({ positions, colors, attributes = [], ...said }: LoadedCloud): PreparedCloud {
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
  // A single point, or many equal ones, still need a distance to be looked at from.
  const cloud = {
    colors,
    attributes,
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
