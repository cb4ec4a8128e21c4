import type { Object3D, Points } from "three";

import { isDimmed } from "../three/dimmed.js";
import type { VisibilityMap } from "../cloud/visibility-map.js";
import { MapTextures } from "../three/mapped-points.js";
import { requirePoints } from "../three/options.js";
import type { FilterSettings } from "../three/options.js";
import type { NodesDrawing } from "./gathered-filter.js";
import type { Refused } from "./gathered.js";
import { CloudNode } from "./node.js";

/** The settings of a filter, which may change, and how nodes are chosen and drawn. */
export interface NodesSettings extends FilterSettings {
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
function listed(nodes: Iterable<Points>): Set<Points> {
  const points = new Set(nodes);
  for (const one of points) requirePoints(one);
  return points;
}
