import type { Points } from "three";

import { allocating, asError, concatenated, HprError } from "../base/errors.js";
import type { Visibility } from "../cloud/visibility.js";
import type { Round } from "../follow/follower.js";
import { CameraFilter, type Drawing, type FilterChange } from "../three/camera-filter.js";
import type { FollowedCamera, Space } from "../three/cameras.js";
import type { FilterSettings } from "../three/options.js";
import type { Cloud } from "../worker/followed-cloud.js";
import { prepareCloud } from "../three/cloud.js";

/** One part of the cloud, as the viewer has it. */
export interface GatheredNode {
  /** The object that the viewer draws. */
  readonly points: Points;
  /** Grows with every change of the points. */
  readonly revision: number;
  /** Reads the positions in the cloud's space. */
  read(): Float32Array | Float64Array;
}

/** Is called with points that cannot be a node. */
export type Refused = (error: Error, points: Points) => void;

/** The indices of a node's points in the cloud, and the revision of the node that they belong to. */
interface Span {
  first: number;
  count: number;
  revision: number;
}

/** The part of an answer that belongs to one node. */
interface NodeAnswer<Node> {
  node: Node;
  /** The ascending indices of its visible points. */
  own: Uint32Array;
}

/**
 * The cloud keeps removed points in memory. It is made again when the removed points are more than
 * half of all its points, plus this number.
 */
const FEW = 10_000;

/**
 * The points of all nodes, in the root's space, as one cloud. Nodes are appended to it and removed
 * from it. Its answers are the same, to the bit, as the answers of a cloud that was never split.
 *
 *      indices   [ node 3 …… | removed …… | node 1 …… | node 7 …… ]
 */
class Gathered<Node extends GatheredNode> {
  readonly #settings: FilterSettings;
  #cloud: Cloud | undefined;
  /** In the order of their indices. */
  readonly #spans = new Map<Node, Span>();
  #length = 0;
  #removed = 0;
  #isClosed = false;

  constructor(settings: FilterSettings) {
    this.#settings = settings;
  }

  get nodes(): number {
    return this.#spans.size;
  }

  /** Whether no node has a point. */
  get isEmpty(): boolean {
    return this.#length === this.#removed;
  }

  /**
   * Changes the cloud, so that it has the points of exactly these nodes. Refused nodes are left out.
   *
   * @throws HprError (as a rejection) the errors of the clouds. Then this cloud is dropped.
   */
  async follow(nodes: readonly Node[], refused: Refused): Promise<void> {
    const gone = this.#leave(nodes);
    if (this.#removed > FEW + this.#length / 2) this.drop();
    try {
      const positions = this.#read(nodes, refused);
      if (this.#cloud === undefined) {
        await this.#create(positions);
        return;
      }
      if (gone.length > 0) await this.#cloud.remove(gone);
      if (positions.length > 0) await this.#cloud.append(positions);
    } catch (error) {
      this.drop();
      throw error;
    }
  }

  /** The number of present points. */
  get points(): number {
    return this.#length - this.#removed;
  }

  get spacing(): number {
    return this.#cloud?.spacing ?? 0;
  }

  /** Undefined while there are no points. */
  get cloud(): Cloud | undefined {
    return this.#cloud;
  }

  /** Splits an answer by node. The result has the indices of each node's own points. */
  *split({ indices }: Visibility): Generator<NodeAnswer<Node>> {
    let from = 0;
    for (const [node, { first, count, revision }] of this.#spans) {
      while (from < indices.length && indices[from]! < first) from++;
      let to = from;
      while (to < indices.length && indices[to]! < first + count) to++;
      if (node.revision === revision) {
        const own = indices.subarray(from, to).map((index) => index - first);
        yield { node, own };
      }
      from = to;
    }
  }

  /** Disposes of the cloud. The next one begins empty. */
  drop(): void {
    void this.#cloud?.dispose();
    this.#cloud = undefined;
    this.#spans.clear();
    this.#length = this.#removed = 0;
  }

  close(): void {
    this.#isClosed = true;
    this.drop();
  }

  async #create(positions: Float64Array): Promise<void> {
    if (positions.length === 0) return;
    const cloud = await prepareCloud(positions, true, this.#settings);
    if (this.#isClosed) {
      void cloud.dispose();
      throw new HprError("disposed", "this filter has been disposed of");
    }
    this.#cloud = cloud;
  }

  /** Forgets nodes that are gone or have changed, and returns the indices of their points. */
  #leave(nodes: readonly Node[]): Uint32Array {
    const present = new Set(nodes);
    const left = [...this.#spans].filter(([node, { revision }]) => !present.has(node) || node.revision !== revision);
    const count = left.reduce((sum, [, span]) => sum + span.count, 0);
    const indices = allocating(`${count} indices`, () => new Uint32Array(count));
    let at = 0;
    for (const [node, span] of left) {
      for (let i = 0; i < span.count; i++) indices[at++] = span.first + i;
      this.#spans.delete(node);
    }
    this.#removed += count;
    return indices;
  }

  /** Reads the points of new nodes. They get the next indices. */
  #read(nodes: readonly Node[], refused: Refused): Float64Array {
    const parts: (Float32Array | Float64Array)[] = [];
    for (const node of nodes) {
      if (this.#spans.has(node)) continue;
      try {
        const numbers = node.read();
        const count = numbers.length / 3;
        this.#spans.set(node, { first: this.#length, count, revision: node.revision });
        this.#length += count;
        parts.push(numbers);
      } catch (error) {
        refused(asError(error), node.points);
      }
    }
    return concatenated(parts);
  }
}

/** For how many milliseconds new nodes wait at most while a camera moves. */
const LONGEST = 2000;

/** The events of a filter of nodes. */
export interface HiddenPointNodesFilterEvents {
  /** A new answer is drawn. `nodes` is the number of nodes in the cloud. Places are in the root's space. */
  change: FilterChange & { nodes: number };
  /**
   * A node (`points`) or a view (`points` is null) is refused. For a node, this comes only once
   * until the node changes. For views, it comes only once until there is an answer again. Without a
   * listener, the error is an unhandled rejection.
   */
  error: { error: Error; points: Points | null };
}

/** Draws the nodes of a viewer. */
export interface NodesDrawing<Node> extends Drawing {
  /** Grows with every change of the nodes. */
  readonly version: number;
  /** Notes which nodes are present now, and how they have changed. */
  takeUp(): void;
  /** The nodes that are not refused. */
  present(): Node[];
  /** The next answers of this camera's nodes are about this number of points. */
  begin?(camera: unknown, points: number): void;
  /** Draws a node's answer. Returns how many of its points are visible. Undefined if the node is gone or has changed. */
  answer(camera: unknown, node: Node, own: Uint32Array): number | undefined;
}

/** Takes the nodes of a viewer as one cloud. New nodes are appended to it, and nodes that are gone are removed. */
export abstract class GatheredFilter<Node extends GatheredNode> extends CameraFilter<HiddenPointNodesFilterEvents> {
  /** @internal */
  protected abstract override readonly drawing: NodesDrawing<Node>;
  readonly #gathered: Gathered<Node>;
  /**
   * The version of the set of nodes that the last question was about. Undefined if the question
   * must be asked again.
   */
  #askedVersion: number | undefined;
  /** Whether the cloud was lost or dropped and must be made again. */
  #isDropped = false;
  /** Whether the cloud could not be made. It is made again when a camera moves or the nodes change. */
  #isFailed = false;
  /** When the nodes were gathered last, and whether nothing was asked since. */
  #gatheredAt = -Infinity;
  #isUnasked = false;
  #visible = 0;
  /** @internal */
  protected readonly refuseNode: Refused = (error, points) => this.report({ error, points }, false);

  /** @internal */
  protected constructor(root: Space, options: unknown, names: readonly string[] = []) {
    super(root, options, names);
    this.#gathered = new Gathered(this.settings);
  }

  /** The number of visible points of all nodes, in the last answer. */
  get visibleCount(): number {
    return this.#visible;
  }

  override dispose(): void {
    super.dispose();
    this.#gathered.close();
  }

  /** Whether the nodes are not those of the last question. @internal */
  protected override get isStale(): boolean {
    return this.#isChanged && !this.frozen;
  }

  /** @internal */
  protected override get cloud(): Cloud | undefined {
    return this.#gathered.cloud;
  }

  /** @internal */
  protected override get isEmpty(): boolean {
    return this.#gathered.isEmpty;
  }

  /** @internal */
  protected override next(): Round | undefined {
    if (this.#isDropped) {
      this.#isDropped = false;
      this.#askedVersion = undefined;
    }
    if (!this.wantsAnswer) return undefined;
    const camera = this.isEmpty ? undefined : this.cameras.due(this.frozen);
    return this.isStale && !this.#isPostponed(camera) ? this.#gathering() : camera && this.#viewing(camera);
  }

  /** @internal */
  protected override noticeChanges(): boolean {
    this.drawing.takeUp();
    return this.#isChanged;
  }

  /** @internal */
  protected override leave(): void {
    if (this.#isFailed) {
      this.#isFailed = false;
      this.#askedVersion = undefined;
    }
  }

  /** @internal */
  protected override dropCloud(): void {
    this.#gathered.drop();
    this.#isDropped = true;
  }

  get #isChanged(): boolean {
    return this.#askedVersion !== this.drawing.version;
  }

  /**
   * Whether the nodes are gathered later, because the picture of this camera comes first. While it is drawn by maps, these
   * leave out hidden points of new nodes, too.
   */
  #isPostponed(camera: FollowedCamera | undefined): boolean {
    const last = this.cameras.last;
    const isMapped = last?.answer === "map" && last.isMoving && performance.now() - this.#gatheredAt < LONGEST;
    const isTurn = this.#isUnasked && camera !== undefined && camera.due!.kind === "map";
    return !this.isEmpty && (isMapped || isTurn);
  }

  /** Updates the cloud. After that, all cameras ask again. */
  #gathering(): Round<void> {
    const gathered = this.#gathered;
    return {
      ask: () => {
        this.#askedVersion = this.drawing.version;
        return gathered.follow(this.drawing.present(), this.refuseNode);
      },
      use: () => {
        this.#gatheredAt = performance.now();
        this.#isUnasked = true;
        this.cameras.again(gathered.points, gathered.spacing);
        if (gathered.isEmpty) this.#visible = 0;
        return () => this.tell();
      },
      isGivenUp: () => {
        this.#isFailed = true;
        return false;
      },
    };
  }

  /** Asks the cloud about a camera's view, and draws the answer. */
  #viewing(camera: FollowedCamera): Round {
    const gathered = this.#gathered;
    this.#isUnasked = false;
    return this.view(
      gathered.cloud!,
      camera,
      (answer) => {
        let count = 0;
        this.drawing.begin?.(camera, gathered.points);
        for (const { node, own } of gathered.split(answer)) count += this.drawing.answer(camera, node, own) ?? 0;
        this.#visible = count;
        return { count, nodes: gathered.nodes };
      },
      (map) => {
        this.drawing.map(camera, map);
        return { count: this.#visible, nodes: gathered.nodes };
      },
    );
  }
}
