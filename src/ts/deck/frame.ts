import { createIterable, type Viewport } from "@deck.gl/core";

import { allocating, HprError } from "../base/errors.js";
import { coneOf, isFloatArray, type Place } from "../query/positions.js";

/** 16 numbers by columns, as deck.gl's `modelMatrix`. */
export type Matrix = ArrayLike<number>;

/** How far the axes may be from the same length and from right angles. */
const TOLERANCE = 1e-5;

function applied(m: Matrix, [x = 0, y = 0, z = 0]: ArrayLike<number> & Iterable<number>): number[] {
  return [0, 1, 2].map((row) => m[row]! * x + m[4 + row]! * y + m[8 + row]! * z + m[12 + row]!);
}

/**
 * The inverse of {@link applied} for a point, or for a direction, which does not heed the translation.
 *
 * @throws HprError `option` if the matrix changes shapes: then no viewpoint in the data sees what is drawn.
 */
function unapplied(m: Matrix, to: readonly number[], isDirection: boolean): number[] {
  const axes = [0, 4, 8].map((at) => [m[at]!, m[at + 1]!, m[at + 2]!]);
  const dot = (a: readonly number[], b: readonly number[]) => a[0]! * b[0]! + a[1]! * b[1]! + a[2]! * b[2]!;
  const square = dot(axes[0]!, axes[0]!);
  const isSimilar = axes.every((a, i) =>
    axes.every((b, j) => Math.abs(dot(a, b) - (i === j ? square : 0)) <= TOLERANCE * square),
  );
  const isAffine = m[3] === 0 && m[7] === 0 && m[11] === 0 && m[15] === 1;
  if (!(square > 0 && Number.isFinite(square) && isSimilar && isAffine)) {
    throw new HprError(
      "option",
      "modelMatrix scales the axes differently or is no affine matrix: what the camera sees cannot be computed in the " +
        "data's coordinates. Scale all axes alike, apply the matrix to the positions, or give viewpoint",
    );
  }
  const rest = isDirection ? to : to.map((x, axis) => x - m[12 + axis]!);
  return axes.map((axis) => dot(axis, rest) / square);
}

/** The radius of deck.gl's Earth, in meters. */
const RADIUS = 40.03e6 / (2 * Math.PI);
const RADIANS = Math.PI / 180;
/** deck.gl draws nothing nearer to the poles. */
const HIGHEST = 89.9;

/**
 * Meters to the east, to the north and upwards of an origin, from longitude, latitude and height. East and north
 * lie on the Web Mercator map, enlarged so that a meter is a meter at the origin. So shapes are those that deck.gl
 * draws. The farther from the origin's latitude, the more they differ from the ground's: by 0.3 % at 20 km, 45° north.
 */
class LocalMeters {
  readonly #longitude: number;
  readonly #height: number;
  readonly #northing: number;
  readonly #scale: number;

  constructor([longitude = 0, latitude = 0, height = 0]: readonly number[]) {
    this.#longitude = longitude;
    this.#height = height;
    this.#northing = northing(latitude);
    this.#scale = RADIUS * Math.cos(RADIANS * clamped(latitude));
  }

  /** Meters around the middle of these points. */
  static amid(points: Float64Array): LocalMeters {
    const [least, most] = [
      [Infinity, Infinity],
      [-Infinity, -Infinity],
    ];
    for (let i = 0; i < points.length; i++) {
      const axis = i % 3;
      if (axis < 2 && Number.isFinite(points[i])) {
        least[axis] = Math.min(least[axis]!, points[i]!);
        most[axis] = Math.max(most[axis]!, points[i]!);
      }
    }
    const middle = least.map((x, axis) => (x + most[axis]!) / 2);
    return new LocalMeters(middle.every(Number.isFinite) ? middle : []);
  }

  of([longitude = NaN, latitude = NaN, height = 0]: Iterable<number>): [number, number, number] {
    const turn = longitude - this.#longitude;
    // A map repeats around the world.
    const nearest = Math.abs(turn) > 180 ? turn - 360 * Math.round(turn / 360) : turn;
    return [
      this.#scale * RADIANS * nearest,
      this.#scale * (northing(latitude) - this.#northing),
      height - this.#height,
    ];
  }
}

function northing(latitude: number): number {
  return Math.asinh(Math.tan(RADIANS * clamped(latitude)));
}

function clamped(latitude: number): number {
  return Math.min(Math.max(latitude, -HIGHEST), HIGHEST);
}

/** Data that deck.gl calls binary: attributes instead of objects. */
interface BinaryData {
  length: number;
  attributes: Record<string, unknown>;
}

interface BinaryAttribute {
  value: ArrayLike<number>;
  size?: number;
  /** The distance from one point to the next, in bytes. */
  stride?: number;
  offset?: number;
}

type GetPosition = (object: unknown, info: { index: number; data: unknown; target: number[] }) => ArrayLike<number>;

export function isBinary(data: unknown): data is BinaryData {
  return typeof data === "object" && data !== null && "attributes" in data && "length" in data;
}

/** The positions of a layer's data: x, y, z of one point after another. The data may be binary or objects. */
export function positionsOf(data: unknown, getPosition: unknown): Float32Array | Float64Array {
  if (isBinary(data) && "getPosition" in data.attributes) {
    return fromAttribute(data.attributes["getPosition"] as BinaryAttribute | ArrayLike<number>, data.length);
  }
  if (typeof getPosition !== "function") {
    throw new HprError(
      "positions-type",
      "the layer's data has no positions: neither getPosition nor an attribute of that name",
    );
  }
  const { iterable, objectInfo } = createIterable(data);
  const numbers: number[] = [];
  for (const object of iterable) {
    objectInfo.index += 1;
    const [x = 0, y = 0, z = 0] = Array.from((getPosition as GetPosition)(object, objectInfo));
    numbers.push(x, y, z);
  }
  return Float64Array.from(numbers);
}

function fromAttribute(attribute: BinaryAttribute | ArrayLike<number>, length: number): Float32Array | Float64Array {
  const { value, size = 3, stride, offset = 0 } = "value" in attribute ? attribute : { value: attribute };
  if (!isFloatArray(value)) {
    throw new HprError(
      "positions-type",
      "the attribute getPosition must have a Float32Array or Float64Array as its value",
    );
  }
  const [step, start] = [
    (stride ?? size * value.BYTES_PER_ELEMENT) / value.BYTES_PER_ELEMENT,
    offset / value.BYTES_PER_ELEMENT,
  ];
  if (step === 3 && size === 3) return value.subarray(start, start + 3 * length);
  const numbers = allocating(
    `${length} points`,
    () => new (value.BYTES_PER_ELEMENT === 4 ? Float32Array : Float64Array)(3 * length),
  );
  for (let i = 0; i < length; i++) {
    for (let axis = 0; axis < Math.min(size, 3); axis++) numbers[3 * i + axis] = value[start + i * step + axis]!;
  }
  return numbers;
}

interface Drawn {
  coordinateSystem?: string;
  coordinateOrigin?: readonly number[];
  modelMatrix?: Matrix | null;
}

type Positions = Float32Array | Float64Array;

/** deck.gl's number for a globe. */
const GLOBE = 2;

/**
 * The coordinates in which a layer's cloud is kept: the data's own, or meters if the data has degrees.
 * A frame takes the camera into them.
 */
export class Frame {
  /** Two frames with the same key keep the same positions. */
  readonly key: string;
  readonly #system: string;
  readonly #origin: readonly number[];
  readonly #matrix: Matrix | undefined;
  #meters: LocalMeters;

  constructor(viewport: Viewport, props: object) {
    const { coordinateSystem = "default", coordinateOrigin = [], modelMatrix } = props as Drawn;
    const usual = viewport.isGeospatial ? "lnglat" : "cartesian";
    this.#system = coordinateSystem === "default" ? usual : coordinateSystem;
    this.#origin = coordinateOrigin;
    this.#matrix = modelMatrix ?? undefined;
    this.#meters = new LocalMeters(coordinateOrigin);
    // Where the data keeps its own coordinates, a matrix that changes moves the viewpoint only.
    const content = this.#isInDegrees ? [this.#origin, Array.from(this.#matrix ?? [])] : [];
    this.key = JSON.stringify([this.#isInDegrees, content]);
  }

  /** Whether the cloud has the data's own coordinates, which a shader knows. */
  get isOwn(): boolean {
    return !this.#isInDegrees;
  }

  get #isInDegrees(): boolean {
    return this.#system.startsWith("lnglat");
  }

  /** The cloud's positions for the data's. */
  take(positions: Positions): Positions {
    if (!this.#isInDegrees) return positions;
    const degrees = Float64Array.from(positions);
    for (let i = 0; i < degrees.length; i += 3) degrees.set(this.#placed(degrees.subarray(i, i + 3)), i);
    this.#meters = LocalMeters.amid(degrees);
    for (let i = 0; i < degrees.length; i += 3) degrees.set(this.#meters.of(degrees.subarray(i, i + 3)), i);
    return degrees;
  }

  /** Goes on with the positions that a frame with the same key has taken. */
  goOn(earlier: Frame): void {
    if (this.#isInDegrees) this.#meters = earlier.#meters;
  }

  /** The place of a viewpoint that is given in the data's coordinates. */
  given(viewpoint: readonly number[]): Place {
    const isReadable = this.#isInDegrees && viewpoint.length === 3;
    return { from: isReadable ? this.#meters.of(this.#placed(viewpoint)) : viewpoint, isDirection: false };
  }

  /**
   * The camera's place, or its direction if it is orthographic.
   *
   * @throws HprError `option` if it has none in the cloud's coordinates.
   */
  seen(viewport: Viewport): Place {
    this.#requireConvertible(viewport);
    const [m, projection] = [viewport.viewMatrixInverse, viewport.projectionMatrix];
    const isDirection = projection[15] !== 0;
    const matrix = this.#isInDegrees ? undefined : this.#matrix;
    const inData = (to: number[], isTurned: boolean) => (matrix === undefined ? to : unapplied(matrix, to, isTurned));
    // The third axis of a camera points backwards.
    const along = inData([-m[8]!, -m[9]!, -m[10]!], true);
    if (isDirection) return { from: along, isDirection };
    return { from: inData(this.#eye(viewport), false), isDirection, cone: coneOf(projection, along) };
  }

  #eye(viewport: Viewport): number[] {
    const eye = viewport.cameraPosition;
    return this.#system === "cartesian" ? [...eye] : this.#meters.of(viewport.unprojectPosition(eye));
  }

  /** Longitude, latitude and height of a point of data in degrees. */
  #placed(point: ArrayLike<number> & Iterable<number>): number[] {
    const moved = this.#matrix === undefined ? [...point] : applied(this.#matrix, point);
    const isOffset = this.#system === "lnglat-offsets";
    return isOffset ? moved.map((x, axis) => x + (this.#origin[axis] ?? 0)) : moved;
  }

  #requireConvertible({ isGeospatial, projectionMode }: Viewport): void {
    if (projectionMode === GLOBE) throw refused("a globe");
    if (isGeospatial === (this.#system === "cartesian")) {
      throw refused(isGeospatial ? "a geospatial view" : "a view that is not geospatial");
    }
  }
}

function refused(view: string): HprError {
  return new HprError(
    "option",
    `the viewpoint cannot be computed for this coordinateSystem in ${view}: give viewpoint, in the data's coordinates`,
  );
}
