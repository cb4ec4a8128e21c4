import { WorkerPointCloud } from "hidden-point-removal/worker";
import type { Cloud } from "../cloud/cloud.ts";
import type { Viewpoint } from "../settings/settings.ts";

/** So many points can be told apart in a small picture. */
const MOST = 4000;

/** What the hull says about the thinned cloud for one radius. */
export interface Flipped {
  /** The radius R of the sphere, in units of the cloud. */
  radius: number;
  /** 1 for each visible point. */
  visible: Uint8Array;
  /** The faces of the hull between visible points: three points each. */
  faces: Uint32Array;
}

/** An even share of a cloud, in a worker of its own, as one viewpoint sees it. */
export class Thinned {
  /** Coordinates measured from the viewpoint. */
  readonly positions: Float32Array;
  readonly distances: Float32Array;
  readonly count: number;
  readonly farthest: number;
  /** The exponent of the automatic radius. */
  readonly automatic: number;
  readonly #points: WorkerPointCloud;

  private constructor(points: WorkerPointCloud, positions: Float32Array, automatic: number) {
    this.#points = points;
    this.positions = positions;
    this.count = positions.length / 3;
    this.automatic = automatic;
    this.distances = new Float32Array(this.count);
    for (let i = 0; i < this.count; i++) {
      this.distances[i] = Math.hypot(positions[3 * i]!, positions[3 * i + 1]!, positions[3 * i + 2]!);
    }
    this.farthest = this.distances.reduce((a, b) => Math.max(a, b), 0);
  }

  static async of({ local, count, center }: Cloud, viewpoint: Viewpoint): Promise<Thinned> {
    const step = Math.ceil(count / MOST);
    const eye = viewpoint.map((value, axis) => value - center[axis]!);
    const positions = new Float32Array(3 * Math.ceil(count / step));
    for (let i = 0; i < positions.length / 3; i++) {
      for (let axis = 0; axis < 3; axis++) positions[3 * i + axis] = local[3 * i * step + axis]! - eye[axis]!;
    }
    const points = await WorkerPointCloud.create(positions, { workers: 1 });
    const { exponent } = await points.autoRadius([0, 0, 0]);
    return new Thinned(points, positions, exponent);
  }

  /** Rejects with an AbortError if a newer radius is asked for. */
  async flip(exponent: number): Promise<Flipped> {
    const answer = await this.#points.reconstruct([0, 0, 0], { exponent, maxEdge: Infinity, latest: true });
    return { radius: answer.radius, visible: answer.mask(), faces: answer.triangles };
  }

  dispose(): void {
    void this.#points.dispose();
  }
}

/** The kinds of points. A wrong one counts as visible although it is hidden; a missed one is the opposite. */
export const [HIDDEN, VISIBLE, WRONG, MISSED] = [0, 1, 2, 3] as const;

/** The direction of the second camera: unit vectors to its right, up, and out of the picture. */
export interface Turn {
  right: number[];
  up: number[];
  out: number[];
}

export interface Drawn {
  thinned: Thinned;
  flipped: Flipped;
  kinds: Uint8Array;
  turn: Turn;
  /** From 0 (every point in its place) to 1 (every point flipped). */
  progress: number;
  colors: Record<"hidden" | "visible" | "wrong" | "missed" | "accent" | "soft" | "face", string>;
}

/** The number of faces that a ray of sight is drawn to. */
const RAYS = 36;

/** The cloud in its place, and the eye in front of it. */
export function drawCloud(canvas: HTMLCanvasElement, drawn: Drawn): void {
  const { thinned } = drawn;
  const pen = clean(canvas);
  const place = framed(canvas, drawn, (i) => thinned.positions.subarray(3 * i, 3 * i + 3));
  drawPoints(pen, drawn, place, 1);
  drawEye(pen, place.eye, drawn.colors.accent);
}

/** The flipped points, their hull and the sphere. */
export function drawFlipped(canvas: HTMLCanvasElement, drawn: Drawn): void {
  const { thinned, flipped, progress, colors } = drawn;
  const pen = clean(canvas);
  const at = new Float32Array(3 * thinned.count);
  for (let i = 0; i < thinned.count; i++) {
    const distance = thinned.distances[i]!;
    // ‖p‖ becomes 2R − ‖p‖: the sphere's inside is turned out.
    const scale = distance > 0 ? 1 + (progress * 2 * (flipped.radius - distance)) / distance : 1;
    for (let axis = 0; axis < 3; axis++) at[3 * i + axis] = scale * thinned.positions[3 * i + axis]!;
  }
  const place = framed(canvas, drawn, (i) => at.subarray(3 * i, 3 * i + 3));

  const { eye, unit } = place;
  pen.strokeStyle = colors.soft;
  pen.setLineDash([4, 5]);
  pen.globalAlpha = 0.7 * progress;
  pen.beginPath();
  pen.arc(eye[0], eye[1], flipped.radius * unit, 0, 2 * Math.PI);
  pen.stroke();
  pen.setLineDash([]);

  drawFaces(pen, drawn, place);
  drawRays(pen, drawn, place);
  // The cloud stays where it was, small if the sphere is large.
  pen.fillStyle = colors.soft;
  pen.globalAlpha = 0.5 * progress;
  for (let i = 0; i < thinned.count; i += 3) {
    const [x, y] = place.of(thinned.positions.subarray(3 * i, 3 * i + 3));
    pen.fillRect(x, y, 1, 1);
  }
  drawPoints(pen, drawn, place, 1.15);
  drawEye(pen, eye, colors.accent);
}

interface Place {
  /** Pixels of each point, and how near it is to the second camera. */
  x: Float32Array;
  y: Float32Array;
  near: Float32Array;
  eye: [number, number];
  /** The pixels of one unit. */
  unit: number;
  of: (point: ArrayLike<number>) => [number, number, number];
}

/** Puts the points and the eye into the picture. */
function framed(canvas: HTMLCanvasElement, { thinned, turn }: Drawn, at: (i: number) => ArrayLike<number>): Place {
  const { count } = thinned;
  const [x, y, near] = [new Float32Array(count), new Float32Array(count), new Float32Array(count)];
  const low = [0, 0];
  const high = [0, 0];
  for (let i = 0; i < count; i++) {
    const point = at(i);
    x[i] = dot(turn.right, point);
    y[i] = -dot(turn.up, point);
    near[i] = dot(turn.out, point);
    low[0] = Math.min(low[0]!, x[i]!);
    high[0] = Math.max(high[0]!, x[i]!);
    low[1] = Math.min(low[1]!, y[i]!);
    high[1] = Math.max(high[1]!, y[i]!);
  }
  const { width, height } = canvas;
  const unit = 0.88 * Math.min(width / (high[0]! - low[0]! || 1), height / (high[1]! - low[1]! || 1));
  const [left, top] = [width / 2 - (unit * (low[0]! + high[0]!)) / 2, height / 2 - (unit * (low[1]! + high[1]!)) / 2];
  for (let i = 0; i < count; i++) {
    x[i] = left + unit * x[i]!;
    y[i] = top + unit * y[i]!;
  }
  const of = (point: ArrayLike<number>): [number, number, number] => [
    left + unit * dot(turn.right, point),
    top - unit * dot(turn.up, point),
    dot(turn.out, point),
  ];
  return { x, y, near, eye: [left, top], unit, of };
}

/** From far to near, so that nearer points cover farther ones. Errors are larger, and hidden points smaller. */
function drawPoints(
  pen: CanvasRenderingContext2D,
  { kinds, colors }: Drawn,
  { x, y, near }: Place,
  width: number,
): void {
  const order = Uint32Array.from(kinds.keys()).sort((a, b) => near[a]! - near[b]!);
  const scale = pen.canvas.width / pen.canvas.clientWidth;
  const looks: [color: string, alpha: number, size: number][] = [
    [colors.hidden, 0.75, 1.6],
    [colors.visible, 1, 2.3],
    [colors.wrong, 1, 3.6],
    [colors.missed, 1, 3.6],
  ];
  for (const i of order) {
    const [color, alpha, size] = looks[kinds[i]!]!;
    pen.fillStyle = color;
    pen.globalAlpha = alpha;
    const side = width * scale * size;
    pen.fillRect(x[i]! - side / 2, y[i]! - side / 2, side, side);
  }
  pen.globalAlpha = 1;
}

/** The hull's faces, from far to near, brighter where they face the second camera. */
function drawFaces(pen: CanvasRenderingContext2D, { flipped, progress, colors }: Drawn, { x, y, near }: Place): void {
  const { faces } = flipped;
  const depth = (face: number) => near[faces[face]!]! + near[faces[face + 1]!]! + near[faces[face + 2]!]!;
  const order = Array.from({ length: faces.length / 3 }, (_, i) => 3 * i).sort((a, b) => depth(a) - depth(b));
  pen.lineWidth = pen.canvas.width / pen.canvas.clientWidth / 2;
  for (const face of order) {
    const [a, b, c] = [faces[face]!, faces[face + 1]!, faces[face + 2]!];
    pen.beginPath();
    pen.moveTo(x[a]!, y[a]!);
    pen.lineTo(x[b]!, y[b]!);
    pen.lineTo(x[c]!, y[c]!);
    pen.closePath();
    pen.fillStyle = pen.strokeStyle = colors.face;
    pen.globalAlpha = 0.1 * progress;
    pen.fill();
    pen.globalAlpha = 0.4 * progress;
    pen.stroke();
  }
  pen.globalAlpha = 1;
}

/** Rays of sight from the eye to some points of the hull. */
function drawRays(pen: CanvasRenderingContext2D, { kinds, progress, colors }: Drawn, { x, y, eye }: Place): void {
  const shown = Array.from(kinds.keys()).filter((i) => kinds[i] === VISIBLE);
  pen.strokeStyle = colors.accent;
  pen.globalAlpha = 0.35 * progress;
  pen.beginPath();
  for (let n = 0; n < shown.length; n += Math.ceil(shown.length / RAYS)) {
    pen.moveTo(...eye);
    pen.lineTo(x[shown[n]!]!, y[shown[n]!]!);
  }
  pen.stroke();
  pen.globalAlpha = 1;
}

function drawEye(pen: CanvasRenderingContext2D, [x, y]: [number, number], color: string): void {
  const scale = pen.canvas.width / pen.canvas.clientWidth;
  pen.strokeStyle = pen.fillStyle = color;
  pen.lineWidth = 2 * scale;
  pen.beginPath();
  pen.ellipse(x, y, 10 * scale, 6 * scale, 0, 0, 2 * Math.PI);
  pen.stroke();
  pen.beginPath();
  pen.arc(x, y, 3 * scale, 0, 2 * Math.PI);
  pen.fill();
}

/** An empty canvas with as many pixels as the screen shows. */
function clean(canvas: HTMLCanvasElement): CanvasRenderingContext2D {
  const scale = Math.min(devicePixelRatio, 2);
  canvas.width = Math.round(canvas.clientWidth * scale);
  canvas.height = Math.round(canvas.clientHeight * scale);
  const pen = canvas.getContext("2d")!;
  pen.lineWidth = scale;
  return pen;
}

function dot(a: readonly number[], b: ArrayLike<number>): number {
  return a[0]! * b[0]! + a[1]! * b[1]! + a[2]! * b[2]!;
}
