import { type BufferGeometry, Matrix4, type Object3D, type Points } from "three";

import { HprError } from "../errors.js";
import type { MergeOptions, VisiblePart } from "../merge.js";
import { versionOf } from "../three/attribute.js";
import { type Cloud, prepareCloud } from "../three/cloud.js";
import { DimmedPoints } from "../three/dimmed.js";
import { DrawnPoints, requireUnfiltered } from "../three/drawn-points.js";
import type { Visibility } from "../visibility.js";
import { type Measure, measure } from "./measure.js";
import type { NodesSettings } from "./options.js";

type State = "new" | "building" | "ready" | "refused";

interface Answer {
  viewpoint: readonly number[];
  how: string;
  visibility: Visibility;
}

const IDENTITY = new Matrix4();
/** For what is computed every frame. */
const scratch = new Matrix4();

/** One node: its points in the root's space, as a cloud of their own, and what of them is visible. */
export class CloudNode {
  readonly points: Points;
  readonly drawn: DrawnPoints;
  readonly dimmed: DimmedPoints | undefined;
  readonly #root: Object3D;
  readonly #settings: NodesSettings;
  readonly #geometry: BufferGeometry;
  readonly #onGone: () => void;
  state: State = "new";
  /** When it was last told to be there, in frames. */
  seen = -1;
  measure: Measure | undefined;
  #place = new Matrix4();
  /** Counts the clouds that were begun: only what becomes of the last one counts. */
  #builds = 0;
  #cloud: Cloud | undefined;
  #answer: Answer | undefined;
  #refused: { geometry: BufferGeometry; position: unknown; version: number } | undefined;

  /**
   * @param onGone called when its geometry is disposed of.
   * @throws HprError `option` if its geometry has a filter already, or its material cannot be dimmed.
   */
  constructor(points: Points, root: Object3D, settings: NodesSettings, onGone: (node: CloudNode) => void) {
    requireUnfiltered(points.geometry);
    this.points = points;
    this.#root = root;
    this.#geometry = points.geometry;
    this.#onGone = () => {
      onGone(this);
    };
    this.#geometry.addEventListener("dispose", this.#onGone);
    this.#settings = settings;
    this.drawn = new DrawnPoints(points, settings.dim);
    this.dimmed = settings.dim ? new DimmedPoints(points, settings.dimMaterial) : undefined;
  }

  /** Whether it is still what its cloud was made of, or what was refused. */
  get isUnchanged(): boolean {
    if (this.#refused !== undefined) {
      const { geometry, position, version } = this.#positions();
      return geometry === this.#refused.geometry && position === this.#refused.position && version === this.#refused.version;
    }
    return this.drawn.isUnchanged && placeIn(this.#root, this.points, scratch).equals(this.#place);
  }

  /** Makes a cloud of the points as they are now. */
  async build(): Promise<void> {
    const build = ++this.#builds;
    const isCurrent = () => build === this.#builds && this.#isBuilding();
    this.state = "building";
    this.dropCloud();
    this.#refused = undefined;
    try {
      placeIn(this.#root, this.points, this.#place);
      const read = this.drawn.take(this.#matrix);
      this.measure = measure(read.numbers);
      const cloud = await prepareCloud(read, this.#settings);
      // It may have been left, or be building anew, in the meantime.
      if (isCurrent()) {
        this.#cloud = cloud;
        this.state = "ready";
      } else {
        void cloud.dispose();
      }
    } catch (error) {
      if (isCurrent()) {
        this.state = "refused";
        this.#refused = this.#positions();
      }
      throw error;
    }
  }

  /** What of this node alone is visible: asked once for each view, and there until the next is asked. */
  async visibleFrom(viewpoint: readonly number[], options: MergeOptions): Promise<Uint32Array> {
    const how = JSON.stringify(options);
    const known = this.#answer;
    if (known?.how === how && known.viewpoint.every((x, axis) => x === viewpoint[axis])) {
      return known.visibility.indices;
    }
    if (this.#cloud === undefined) {
      throw new HprError("disposed", "this node is being prepared anew");
    }
    if (known !== undefined) {
      this.#answer = undefined;
      this.#cloud.recycle(known.visibility);
    }
    const visibility = await this.#cloud.visibleFrom(viewpoint, options);
    this.#answer = { viewpoint, how, visibility };
    return visibility.indices;
  }

  /** Some points with numbers of their own, for a merge. */
  part(indices: Uint32Array, first: number): VisiblePart {
    return { positions: this.positionsOf(indices), ids: indices.map((index) => first + index) };
  }

  positionsOf(indices: Uint32Array): Float32Array | Float64Array {
    return this.drawn.positionsOf(indices, this.#matrix);
  }

  show(): void {
    this.drawn.show();
    this.dimmed?.show(this.drawn);
  }

  showAll(): void {
    this.drawn.showAll();
    this.dimmed?.hide();
  }

  dropCloud(): void {
    void this.#cloud?.dispose();
    this.#cloud = this.#answer = undefined;
  }

  dispose(): void {
    this.state = "new";
    this.#geometry.removeEventListener("dispose", this.#onGone);
    this.dimmed?.dispose();
    this.drawn.release();
    this.dropCloud();
  }

  get #matrix(): readonly number[] | undefined {
    return this.#place.equals(IDENTITY) ? undefined : this.#place.elements;
  }

  #positions() {
    const { geometry } = this.points;
    const position = geometry.attributes["position"];
    return { geometry, position, version: position === undefined ? 0 : versionOf(position) };
  }

  #isBuilding(): boolean {
    return this.state === "building";
  }
}

/**
 * Where an object is in the space of another one above it. Not by way of the world, whose
 * rounding would move points apart that are equal in two nodes.
 */
function placeIn(root: Object3D, object: Object3D, target: Matrix4): Matrix4 {
  target.identity();
  for (let at: Object3D | null = object; at !== null && at !== root; at = at.parent) {
    if (at.matrixAutoUpdate) {
      at.updateMatrix();
    }
    target.premultiply(at.matrix);
  }
  return target;
}
