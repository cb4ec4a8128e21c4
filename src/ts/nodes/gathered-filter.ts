import type { Points } from "three";

import type { Round } from "../follow/follower.js";
import { CameraFilter, type Drawing, type FilterChange } from "../three/camera-filter.js";
import type { FollowedCamera, Space } from "../three/cameras.js";
import type { Cloud } from "../worker/followed-cloud.js";
import { Gathered, type GatheredNode, type Refused } from "./gathered.js";

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
