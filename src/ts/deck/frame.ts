import type { Viewport } from "@deck.gl/core";

import { HprError } from "../base/errors.js";
import type { Place } from "../query/place.js";
import { applied, type Matrix, unapplied } from "./matrix.js";
import { LocalMeters } from "./meters.js";

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
    // The third axis of a camera points backwards.
    const from = isDirection ? [-m[8]!, -m[9]!, -m[10]!] : this.#eye(viewport);
    const isMoved = this.#matrix !== undefined && !this.#isInDegrees;
    return { from: isMoved ? unapplied(this.#matrix, from, isDirection) : from, isDirection };
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
