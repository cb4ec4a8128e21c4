import "../styles/plot.css";
import { isAutomatic } from "../ask/question.ts";
import { Curve } from "../ask/curve.ts";
import type { TimedView } from "../ask/inquiry.ts";
import { byId } from "../controls/dom.ts";
import { MOST_EXPONENT } from "../settings/limits.ts";
import type { Store } from "../settings/store.ts";
import type { Viewer } from "../view/viewer.ts";

/** The frame of the plot, in the units of the drawing. */
const FRAME = { left: 34, right: 272, top: 8, bottom: 92 };

/** The share of visible points against the exponent, for the present view. A click chooses an exponent. */
export class Plot {
  readonly #viewer: Viewer;
  readonly #store: Store;
  readonly #section = byId("plot-section", HTMLDetailsElement);
  readonly #drawing = document.querySelector<SVGSVGElement>("#plot")!;
  readonly #note = byId("plot-note");
  #curve: Curve | null = null;

  constructor(viewer: Viewer, store: Store) {
    this.#viewer = viewer;
    this.#store = store;
    this.#drawing.addEventListener("click", (event) => {
      const { x } = new DOMPoint(event.clientX, event.clientY).matrixTransform(this.#drawing.getScreenCTM()!.inverse());
      const exponent = ((x - FRAME.left) / (FRAME.right - FRAME.left)) * MOST_EXPONENT;
      // The steps are as fine as those of the slider.
      const step = Math.round(20 * Math.min(MOST_EXPONENT, Math.max(0, exponent))) / 20;
      if (store.current.inversion === "spherical") store.change({ radius: { exponent: step } });
    });
  }

  /** Clears the plot, because another cloud is shown. */
  clear(): void {
    const { inquiry, cloud } = this.#viewer.scene;
    this.#curve = new Curve(inquiry, cloud.radius);
    this.#draw();
  }

  /** Called every frame. */
  follow(): void {
    const { current } = this.#store;
    if (!this.#section.open || !this.#section.checkVisibility() || !this.#curve || !this.#viewer.cloud) return;
    const spherical = current.inversion === "spherical";
    this.#drawing.classList.toggle("idle", !spherical);
    if (spherical) {
      this.#curve.follow(current.freeze ?? this.#viewer.viewpoint, current, () => {
        this.#draw();
      });
    } else {
      this.#note.textContent = "Only the spherical method has a radius.";
    }
  }

  /** Shows the radius that an answer was found with. */
  answer({ question, visibility }: TimedView): void {
    // Looks have no radius. The place of the one hull before them stays.
    if (question.method.looks > 0) return;
    place(this.#drawing, "now", visibility.exponent);
    if (isAutomatic(question.method)) this.markAutomatic(visibility.exponent);
  }

  markAutomatic(exponent: number): void {
    place(this.#drawing, "automatic", exponent);
  }

  #draw(): void {
    const { counts } = this.#curve!;
    const total = this.#viewer.scene.cloud.count;
    const points = [...counts]
      .filter(([, count]) => !Number.isNaN(count))
      .map(([exponent, count]) => ({ exponent, share: count / total }))
      .sort((a, b) => a.exponent - b.exponent);
    const y = (share: number) => FRAME.bottom - share * (FRAME.bottom - FRAME.top);
    this.#drawing
      .querySelector(".curve")!
      .setAttribute("points", points.map(({ exponent, share }) => `${across(exponent)},${y(share)}`).join(" "));
    this.#drawing.querySelector(".dots")!.innerHTML = points
      .map(
        ({ exponent, share }) =>
          `<circle cx="${across(exponent)}" cy="${y(share)}" r="2.5"><title>${exponent}: ${percent(share)}</title></circle>`,
      )
      .join("");
    this.#drawing.dataset["points"] = String(points.length);
    this.#drawing.ariaLabel = `Visible share by exponent: ${points.map(({ exponent, share }) => `${exponent}: ${percent(share)}`).join(", ") || "not yet known"}`;
    this.#note.textContent =
      "Exponent: log₁₀ of radius ÷ farthest distance. The dashed line is the automatic one. Click to choose one.";
  }
}

function across(exponent: number): number {
  return FRAME.left + (Math.min(MOST_EXPONENT, Math.max(0, exponent)) / MOST_EXPONENT) * (FRAME.right - FRAME.left);
}

function place(drawing: SVGSVGElement, name: string, exponent: number): void {
  const line = drawing.querySelector(`.${name}`)!;
  for (const end of ["x1", "x2"]) line.setAttribute(end, String(across(exponent)));
}

function percent(share: number): string {
  return `${(100 * share).toFixed(1)} %`;
}
