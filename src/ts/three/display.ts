import type { Material, Points } from "three";

import { DimmedPoints } from "./dimmed.js";
import { DrawnPoints } from "./drawn-points.js";

/** What of some points is drawn: all of them, or what is visible, and maybe the hidden ones dimmed. */
export class Display {
  readonly drawn: DrawnPoints;
  readonly #dimmed: DimmedPoints | undefined;
  #isAnswered = false;
  #enabled = true;

  /** @throws HprError `option` for a material that cannot be dimmed. */
  constructor(points: Points, { dim, dimMaterial }: { dim: boolean; dimMaterial: Material | undefined }) {
    this.#dimmed = dim ? new DimmedPoints(points, dimMaterial) : undefined;
    this.drawn = new DrawnPoints(points, dim);
  }

  /** While false, everything is drawn. */
  get enabled(): boolean {
    return this.#enabled;
  }

  set enabled(enabled: boolean) {
    this.#enabled = enabled;
    if (enabled) {
      this.#show();
    } else {
      this.showAll();
    }
  }

  /** How many points are drawn, dimmed ones not counted. */
  get count(): number {
    return this.#isAnswered && this.#enabled ? this.drawn.visible : this.drawn.total;
  }

  /**
   * Draws what is visible: indices into what `drawn` took up, ascending. `isListed`: where
   * hidden points are dimmed, their indices follow in memory already.
   *
   * @throws HprError `too-large`, `option`.
   */
  answer(indices: Uint32Array, isListed = false): void {
    this.drawn.setVisible(indices, isListed);
    this.#isAnswered = true;
    this.#show();
  }

  /** Does after the points what was done to them since the last frame, every frame. */
  follow(): void {
    this.#dimmed?.follow();
  }

  /** Draws everything, until there is an answer or it is enabled again. */
  showAll(): void {
    this.drawn.showAll();
    this.#dimmed?.hide();
  }

  /** Leaves points that are no longer the ones that were taken up. */
  leaveOthers(): void {
    if (!this.drawn.isSame) {
      this.leave();
    }
  }

  /** Leaves the points that were taken up. */
  leave(): void {
    this.showAll();
    this.drawn.release();
    this.#isAnswered = false;
  }

  dispose(): void {
    this.leave();
    this.#dimmed?.dispose();
  }

  #show(): void {
    if (this.#isAnswered && this.#enabled) {
      this.drawn.show();
      this.#dimmed?.show(this.drawn);
    }
  }
}
