import { Matrix4, type Object3D, type Points } from "three";

import { describe, HprError } from "../base/errors.js";
import type { VisibilityMap } from "../cloud/visibility-map.js";
import { versionOf } from "../three/attribute.js";
import { isDimmed } from "../three/dimmed.js";
import { Display } from "../three/display.js";
import { isFiltered, requireUnfiltered } from "../three/drawn-points.js";
import { MapTextures } from "../three/mapped-points.js";
import { type FilterSettings, requirePoints } from "../three/options.js";
import type { GatheredNode, NodesDrawing, Refused } from "./gathered.js";

/**
 * Writes the matrix from an object's space to that of an object above it. It is not computed through world
 * coordinates: their rounding would separate points that are equal in two nodes.
 */
export function placeIn(root: Object3D, object: Object3D, place: Matrix4): Matrix4 {
  if (object === root) return place.identity();
  const holder = holderOf(root, object);
  if (object.matrixAutoUpdate) object.updateMatrix();
  return holder === null ? place.copy(object.matrix) : placeIn(root, holder, place).multiply(object.matrix);
}

/**
 * The object that the matrix of `object` is relative to. In the octrees of potree-core, nodes are children of nodes, but each
 * node is drawn relative to the octree.
 */
function holderOf(root: Object3D, object: Object3D): Object3D | null {
  for (let at = object.parent; at !== null && at !== root; at = at.parent) {
    if ("pcoGeometry" in at) return at;
  }
  return object.parent === null || "pcoGeometry" in root ? null : object.parent;
}

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

/** The settings of a filter, which may change, and how nodes are chosen and drawn. */
interface NodesSettings extends FilterSettings {
  hidesPending: boolean;
  nodes: (() => Iterable<Points>) | undefined;
}

/** The present nodes. The set is checked in every frame. If there is no change, nothing is allocated. */
export class NodeSet implements NodesDrawing<CloudNode> {
  readonly #root: Object3D;
  readonly #settings: NodesSettings;
  readonly #refused: Refused;
  readonly #nodes = new Map<Points, CloudNode>();
  readonly #textures = new MapTextures();
  /** The last map for each camera. New nodes are drawn by it. */
  readonly #maps = new Map<unknown, VisibilityMap>();
  /**
   * Points that were refused because they had a filter already or could not be dimmed. The geometry
   * and the material that they had then are kept with them.
   */
  readonly #refusedPoints = new WeakMap<Points, { geometry: unknown; material: unknown }>();
  #enabled = true;
  #camera: unknown;
  #frame = 0;
  #seen = 0;
  #version = 0;

  /** @param refused is called with points that cannot be a node, or whose material can no longer be dimmed. */
  constructor(root: Object3D, settings: NodesSettings, refused: Refused) {
    this.#root = root;
    this.#settings = settings;
    this.#refused = refused;
  }

  /** Grows with every change of the nodes. */
  get version(): number {
    return this.#version;
  }

  /** Whether only the visible points of the nodes are drawn. */
  get enabled(): boolean {
    return this.#enabled;
  }

  set enabled(enabled: boolean) {
    this.#enabled = enabled;
    for (const { display } of this.#nodes.values()) display.enabled = enabled;
  }

  /** Whether hidden points are drawn, but dimmed. A node that cannot be dimmed is refused, and hides them. */
  get dim(): boolean {
    return this.#settings.dim;
  }

  set dim(dim: boolean) {
    for (const { display, points } of this.#nodes.values()) {
      try {
        display.dim = dim;
      } catch (error) {
        this.#refused(error as Error, points);
      }
    }
  }

  /** Draws what this camera sees. */
  select(camera: unknown): void {
    this.#camera = camera;
    for (const { display } of this.#nodes.values()) display.select(camera);
  }

  /** Draws all points for this camera until its next answer. */
  setStale(camera: unknown): void {
    this.#maps.delete(camera);
    for (const { display } of this.#nodes.values()) display.setStale(camera);
  }

  /** Whether maps can be drawn: undefined until a node was drawn. A node without them draws all of its points. */
  get isAble(): boolean | undefined {
    for (const { display } of this.#nodes.values()) {
      if (display.isAble !== undefined) return display.isAble;
    }
    return undefined;
  }

  /** Draws all nodes by one map until the camera's next answer. */
  map(camera: unknown, map: VisibilityMap): void {
    this.#maps.set(camera, map);
    for (const node of this.#nodes.values()) node.map(camera, map);
  }

  answer(camera: unknown, node: CloudNode, own: Uint32Array): number | undefined {
    const isSame = this.#nodes.get(node.points) === node && node.display.drawn.isSame;
    return isSame ? node.display.answer(camera, own) : undefined;
  }

  /** Forgets the answers for this camera. */
  drop(camera: unknown): void {
    for (const { display } of this.#nodes.values()) display.drop(camera);
    this.#textures.drop(camera);
    this.#maps.delete(camera);
  }

  /** The indices of the points that are drawn, by node. */
  get drawn(): Map<Points, Uint32Array> {
    return new Map([...this.#nodes.values()].map(({ points, display }) => [points, display.drawnIndices]));
  }

  /** The nodes that are not refused. Some of them may not have been read yet. */
  present(): CloudNode[] {
    return [...this.#nodes.values()].filter(({ isRefused }) => !isRefused);
  }

  /** Follows the changes of the points since the last frame. */
  follow(): void {
    if (!this.#settings.dim && this.#settings.mapped === undefined) return;
    for (const { points, display } of this.#nodes.values()) {
      try {
        display.follow();
      } catch (error) {
        this.#refused(error as Error, points);
      }
    }
  }

  /** Notes which nodes are present now, and how they have changed. */
  takeUp(): void {
    const { nodes } = this.#settings;
    // This comes first: if it throws, nothing has changed yet.
    const given = nodes === undefined ? undefined : listed(nodes());
    this.#frame += 1;
    this.#seen = 0;
    if (given === undefined) {
      this.#takeUpBelow(this.#root);
    } else {
      for (const points of given) this.#takeUpOne(points);
    }
    if (this.#seen < this.#nodes.size) this.#forgetAbsent();
  }

  dispose(): void {
    for (const { display } of this.#nodes.values()) display.dispose();
    this.#nodes.clear();
    this.#textures.dispose();
  }

  #takeUpBelow(object: Object3D): void {
    if (!object.visible) return;
    if (isPoints(object)) this.#takeUpOne(object);
    const { children } = object;
    for (let i = 0; i < children.length; i++) this.#takeUpBelow(children[i]!);
  }

  #takeUpOne(points: Points): void {
    const node = this.#nodes.get(points) ?? this.#added(points);
    if (node !== undefined) {
      node.seen = this.#frame;
      this.#seen += 1;
      if (node.noticeChange()) this.#version += 1;
    }
  }

  #added(points: Points): CloudNode | undefined {
    const { geometry, material } = points;
    const refused = this.#refusedPoints.get(points);
    if (isDimmed(points) || (refused?.geometry === geometry && refused.material === material)) return undefined;
    try {
      const node = new CloudNode(points, this.#root, this.#settings, this.#textures);
      node.display.enabled = this.#enabled;
      node.display.select(this.#camera);
      for (const [camera, map] of this.#maps) node.map(camera, map);
      this.#nodes.set(points, node);
      this.#version += 1;
      return node;
    } catch (error) {
      this.#refusedPoints.set(points, { geometry, material });
      this.#refused(error as Error, points);
      return undefined;
    }
  }

  #forgetAbsent(): void {
    this.#version += 1;
    for (const [points, node] of this.#nodes) {
      if (node.seen !== this.#frame) {
        this.#nodes.delete(points);
        node.display.dispose();
      }
    }
  }
}

/**
 * Whether an object is a `Points`. This is called for every object in every frame, so it does not
 * use `in`, which would search the prototypes.
 */
function isPoints(object: Object3D): object is Points {
  return (object as Partial<Points>).isPoints === true;
}

/** Returns each node once, even if it is listed several times. */
function listed(nodes: Iterable<Points> | undefined): Set<Points> {
  if (typeof nodes?.[Symbol.iterator] !== "function") {
    throw new HprError("option", `nodes must return a list, got ${describe(nodes)}`);
  }
  const points = new Set(nodes);
  for (const one of points) requirePoints(one);
  return points;
}
