import { Matrix4, type Object3D, type Points } from "three";

import { HprError } from "../base/errors.js";
import { versionOf } from "../three/attribute.js";
import { Display } from "../three/display.js";
import { isFiltered, requireUnfiltered } from "../three/drawn-points.js";
import type { VisibilityMap } from "../cloud/visibility-map.js";
import type { MapTextures } from "../three/mapped-points.js";
import type { GatheredNode } from "./gathered.js";
import type { NodesSettings } from "./node-set.js";
import { placeIn } from "./place.js";

const IDENTITY = new Matrix4();

/** One node: its points, their place in the root's space, and the part of them that is drawn. */
export class CloudNode implements GatheredNode {
  readonly points: Points;
  readonly display: Display;
  /** The last frame in which the node was present. */
  seen = -1;
  /** Grows with every change of the node's points. */
  revision = 1;
  readonly #settings: NodesSettings;
  readonly #root: Object3D;
  /** The way to the root's space, now and when the points were read. */
  readonly #place = new Matrix4();
  readonly #read = new Matrix4();
  /** The state in which the node was refused. The node is not read again until its state changes. */
  #refused: readonly unknown[] | undefined;
  /** Whether its points were read in its present revision. */
  #isRead = false;

  /** @throws HprError `option` if its geometry has a filter already, or if its material cannot be dimmed. */
  constructor(points: Points, root: Object3D, settings: NodesSettings, textures: MapTextures) {
    requireUnfiltered(points.geometry);
    this.points = points;
    this.display = new Display(points, settings, textures);
    this.#settings = settings;
    this.#root = root;
    this.display.isPending = settings.hidesPending;
  }

  get isRefused(): boolean {
    return this.#refused !== undefined;
  }

  /** Whether the node has changed since it was read or refused. Returns true only once for each change. */
  noticeChange(): boolean {
    if (!this.#isRead || this.#isUnchanged()) return false;
    this.revision += 1;
    this.#isRead = false;
    this.#refused = undefined;
    this.display.leaveOthers();
    if (!this.display.isAnswered) this.display.isPending = this.#settings.hidesPending;
    return true;
  }

  /**
   * Reads the positions of the node's points in the root's space.
   *
   * @throws HprError the errors of `DrawnPoints.take`, and `non-finite`. Then the node is refused.
   */
  read(): Float32Array | Float64Array {
    this.#isRead = true;
    try {
      const { numbers } = this.display.drawn.take(this.#matrix());
      this.#read.copy(this.#place);
      if (this.#settings.nonFinite === "error") requireFinite(numbers);
      return numbers;
    } catch (error) {
      this.display.leave();
      this.#refused = this.#state();
      throw error;
    }
  }

  /** Draws the node by a map of the whole cloud. */
  map(camera: unknown, map: VisibilityMap): void {
    this.display.map(camera, map, this.#matrix());
  }

  #isUnchanged(): boolean {
    const refused = this.#refused;
    if (refused !== undefined) return this.#state().every((value, i) => Object.is(value, refused[i]));
    return this.display.drawn.isUnchanged && placeIn(this.#root, this.points, this.#place).equals(this.#read);
  }

  #matrix(): readonly number[] | undefined {
    const place = placeIn(this.#root, this.points, this.#place);
    return place.equals(IDENTITY) ? undefined : place.elements;
  }

  /** The state that a refusal can depend on. */
  #state(): unknown[] {
    const geometry = this.points.geometry as Partial<Points["geometry"]> | undefined;
    const position = geometry?.attributes?.["position"];
    const version = typeof position === "object" && (position as unknown) !== null ? versionOf(position) : 0;
    // If the geometry has another filter, its index and draw range do not matter here.
    const isFree = !isFiltered(geometry);
    const { index, drawRange } = (isFree ? geometry : undefined) ?? {};
    return [geometry, position, version, isFree, index, index?.version, drawRange?.start, drawRange?.count];
  }
}

function requireFinite(numbers: Float32Array | Float64Array): void {
  const strays = new Set<number>();
  numbers.forEach((x, i) => Number.isFinite(x) || strays.add(Math.floor(i / 3)));
  const [first] = strays;
  if (first !== undefined) {
    const message = `${strays.size} point(s) have a coordinate that is NaN or infinite, the first at index ${first}`;
    throw new HprError("non-finite", message);
  }
}
