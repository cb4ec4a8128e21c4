import type { CloudPoints } from "./points.ts";
import type { Stage } from "./stage.ts";

/** The number of milliseconds in which one picture fades into the next one. */
const FADE = 160;

/**
 * The quiet change from one answer to the next. An answer for the same place fades in. While the camera is at another
 * place than the answer, all points are drawn behind it: otherwise the points that the camera has just come to see would
 * be a gap, like the shadow of the old viewpoint.
 */
export class Change {
  readonly #stage: Stage;
  readonly #points: CloudPoints;
  readonly #calm = matchMedia("(prefers-reduced-motion: reduce)");
  #fadesSince = -Infinity;
  #fits = true;
  #fitsSince = -Infinity;
  #faded = 1;
  #isOver = true;

  constructor(stage: Stage, points: CloudPoints) {
    this.#stage = stage;
    this.#points = points;
  }

  /** Whether the picture shows nothing but the last answer. */
  get isOver(): boolean {
    return this.#isOver;
  }

  /** Shows an answer. `fades`: it is for the same place as the one before. */
  show(indices: Uint32Array, fades: boolean): void {
    this.#fadesSince = performance.now();
    this.#points.setVisible(indices, fades && !this.#calm.matches);
    this.#faded = 0;
    this.#isOver = false;
    this.#stage.invalidate();
  }

  /** Called every frame. `fits`: the last answer is for the present place of the camera. */
  follow(fits: boolean): void {
    const now = performance.now();
    if (fits && !this.#fits) this.#fitsSince = now;
    if (fits !== this.#fits) this.#isOver = false;
    this.#fits = fits;
    if (this.#isOver) return;
    const faded = this.#share(now, this.#fadesSince);
    this.#points.setFade(faded);
    if (faded !== this.#faded) this.#stage.invalidate();
    this.#faded = faded;
    const filled = fits ? 1 - this.#share(now, this.#fitsSince) : 1;
    this.#stage.setAll({ opacity: filled });
    this.#isOver = fits && faded === 1 && filled === 0;
  }

  #share(now: number, since: number): number {
    return this.#calm.matches ? 1 : Math.min(1, (now - since) / FADE);
  }
}
