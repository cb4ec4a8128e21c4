import type { Object3D, Points } from "three";

import { isDimmed } from "../three/dimmed.js";
import { requirePoints } from "../three/options.js";
import { CloudNode } from "./node.js";
import type { NodesSettings } from "./options.js";

/** What a set of nodes tells whom it belongs to. */
export interface NodeSetEvents {
  /** A node is ready to be asked. */
  ready(): void;
  refused(error: Error, points: Points): void;
}

/** The nodes that are there, and some that were: which they are, and their clouds. */
export class NodeSet {
  readonly #root: Object3D;
  readonly #settings: NodesSettings;
  readonly #events: NodeSetEvents;
  readonly #nodes = new Map<Points, CloudNode>();
  /** What had a filter already or could not be dimmed: the geometry and the material that it had. */
  readonly #refusedPoints = new WeakMap<Points, Pick<Points, "geometry" | "material">>();
  #frame = 0;
  #version = 0;
  #building = 0;
  /** Counts the workers that were lost: what they still say is of no interest. */
  #epoch = 0;

  constructor(root: Object3D, settings: NodesSettings, events: NodeSetEvents) {
    this.#root = root;
    this.#settings = settings;
    this.#events = events;
  }

  /** Grows with every change of the nodes that can be asked. */
  get version(): number {
    return this.#version;
  }

  /** Whether there are clouds that are not ready yet. */
  get isBuilding(): boolean {
    return this.#building > 0;
  }

  get epoch(): number {
    return this.#epoch;
  }

  /** Whether it was ever told which nodes there are. */
  get isKnown(): boolean {
    return this.#frame > 0;
  }

  /** All that are kept: their drawing is the filter's. */
  all(): Iterable<CloudNode> {
    return this.#nodes.values();
  }

  isPresent(node: CloudNode): boolean {
    return node.seen === this.#frame;
  }

  /** Those that are there and can be asked. */
  ready(): CloudNode[] {
    return this.#present().filter(({ state }) => state === "ready");
  }

  /** Notes which nodes are there now. */
  takeUp(): void {
    const { nodes } = this.#settings;
    // What it throws changes nothing.
    const given = nodes === undefined ? undefined : listed(nodes());
    this.#frame += 1;
    if (given === undefined) {
      this.#takeUpBelow(this.#root);
    } else {
      for (const points of given) this.#takeUpOne(points);
    }
    let isLeft = false;
    for (const node of this.#nodes.values()) {
      if (node.seen === this.#frame - 1) {
        node.showAll();
        isLeft = true;
      }
    }
    if (isLeft) {
      this.#version += 1;
      this.#forgetOld();
    }
  }

  /** Makes all clouds anew: their worker was lost. */
  rebuild(): void {
    this.#epoch += 1;
    for (const node of this.#nodes.values()) {
      if (this.isPresent(node)) {
        this.#build(node);
      } else {
        node.state = "new";
      }
    }
  }

  dispose(): void {
    for (const node of [...this.#nodes.values()]) {
      this.#forget(node);
    }
  }

  #present(): CloudNode[] {
    return [...this.#nodes.values()].filter((node) => this.isPresent(node));
  }

  #takeUpBelow(object: Object3D): void {
    if (!object.visible) {
      return;
    }
    if ("isPoints" in object && !isDimmed(object as Points)) {
      this.#takeUpOne(object as Points);
    }
    for (const child of object.children) {
      this.#takeUpBelow(child);
    }
  }

  #takeUpOne(points: Points): void {
    const node = this.#nodes.get(points) ?? this.#added(points);
    if (node === undefined) {
      return;
    }
    const isBack = node.seen !== this.#frame - 1;
    node.seen = this.#frame;
    if (node.state === "building") {
      return;
    }
    if (node.state === "new" || !node.isUnchanged) {
      this.#build(node);
    } else if (isBack && node.state === "ready") {
      this.#version += 1;
    }
  }

  #added(points: Points): CloudNode | undefined {
    const { geometry, material } = points;
    const refused = this.#refusedPoints.get(points);
    if (refused?.geometry === geometry && refused.material === material) {
      return undefined;
    }
    try {
      const node = new CloudNode(points, this.#root, this.#settings, (gone) => {
        if (!this.isPresent(gone)) this.#forget(gone);
      });
      this.#nodes.set(points, node);
      return node;
    } catch (error) {
      this.#refusedPoints.set(points, { geometry, material });
      this.#events.refused(error as Error, points);
      return undefined;
    }
  }

  #build(node: CloudNode): void {
    const epoch = this.#epoch;
    if (!node.drawn.isSame) {
      node.showAll();
    }
    const isOver = () => {
      this.#building -= 1;
      this.#version += 1;
    };
    this.#building += 1;
    this.#version += 1;
    node.build().then(
      () => {
        isOver();
        this.#events.ready();
      },
      (error: unknown) => {
        isOver();
        if (epoch === this.#epoch) {
          this.#events.refused(error as Error, node.points);
        }
      },
    );
  }

  /** Those that have been gone for longest, beyond as many points as are there. */
  #forgetOld(): void {
    const gone = [...this.#nodes.values()].filter((node) => !this.isPresent(node));
    let room = this.#present().reduce((sum, { drawn }) => sum + drawn.total, 0);
    for (const node of gone.sort((a, b) => b.seen - a.seen)) {
      room -= node.drawn.total;
      if (room < 0) {
        this.#forget(node);
      }
    }
  }

  #forget(node: CloudNode): void {
    this.#nodes.delete(node.points);
    node.dispose();
  }
}

/** Each once, however often it is listed. */
function listed(nodes: Iterable<Points>): Set<Points> {
  const points = new Set(nodes);
  for (const one of points) requirePoints(one);
  return points;
}
