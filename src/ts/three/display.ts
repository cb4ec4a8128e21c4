import type { Material, Points } from "three";

import { DimmedPoints } from "./dimmed.js";
import { DrawnPoints } from "./drawn-points.js";

/** Draws either all points or only the visible ones. The hidden points may be drawn, too, but dimmed. */
export class Display {
  readonly drawn: DrawnPoints;
  readonly #dimmed: DimmedPoints | undefined;
  #isAnswered = false;
  #enabled = true;

  /** @throws HprError `option` if the material cannot be dimmed. */
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

  /** How many points are drawn, without the dimmed ones. */
  get count(): number {
    return this.#isAnswered && this.#enabled ? this.drawn.visible : this.drawn.total;
  }

  /**
   * Draws the visible points. `indices` are their ascending indices among the points that `drawn`
   * has read. With `isListed`, the indices of the hidden points follow in memory already.
   *
   * @throws HprError `too-large`, `option`.
   */
  answer(indices: Uint32Array, isListed = false): void {
    this.drawn.setVisible(indices, isListed);
    this.#isAnswered = true;
    this.#show();
  }

  /** Copies the changes of the points since the last frame. Called in every frame. */
  follow(): void {
    this.#dimmed?.follow();
  }

  /** Draws all points, until there is an answer or `enabled` is set to true. */
  showAll(): void {
    this.drawn.showAll();
    this.#dimmed?.hide();
  }

  /** Releases the points if they are no longer the ones that were read. */
  leaveOthers(): void {
    if (!this.drawn.isSame) {
      this.leave();
    }
  }

  /** Releases the points that were read. */
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
