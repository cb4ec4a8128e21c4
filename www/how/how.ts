import "./how.css";
import { upVector } from "../cloud/cloud.ts";
import type { Store } from "../settings/settings.ts";
import { eased } from "../controls/controls.ts";
import { THEMES } from "../view/theme.ts";
import type { Viewer } from "../view/viewer.ts";
import {
  drawCloud,
  drawFlipped,
  type Drawn,
  type Flipped,
  HIDDEN,
  MISSED,
  Thinned,
  type Turn,
  VISIBLE,
  WRONG,
} from "./picture.ts";

const PAGE = `
  <h2 id="how-title">How it works</h2>
  <p class="note">Every point is flipped out of a sphere around the eye: the nearer it is, the farther it goes. The points on the
  convex hull of the flipped points are the ones that the eye sees.</p>
  <div class="pictures">
    <figure><canvas data-picture="cloud" role="img" aria-label="The cloud and the eye, from a second camera"></canvas>
      <figcaption>The cloud and the eye. Drag to look around.</figcaption></figure>
    <figure><canvas data-picture="flipped" role="img" aria-label="The flipped points and their hull"></canvas>
      <figcaption>The flipped points and their hull. Dashed: the sphere.</figcaption></figure>
  </div>
  <div class="slider"><label for="how-radius">Radius of the sphere</label><output for="how-radius"></output>
    <input id="how-radius" type="range" min="0" max="5" step="0.02" /></div>
  <ul class="legend"></ul>
  <p data-say role="status"></p>
  <div class="buttons"><button type="button" data-do="automatic">Automatic radius</button>
    <button type="button" data-do="again">Flip again</button><button type="button" data-do="close">Close</button></div>`;

/** The number of milliseconds in which the points fly to their flipped places. */
const FLIGHT = 1600;
/** A radius that differs by less than this from the automatic exponent is about right. */
const NEAR = 0.45;

const number = new Intl.NumberFormat("en-US");

/** Opens the lesson about the viewer's present cloud and viewpoint. Resolves when its first picture is there. */
export async function showHow(viewer: Viewer, store: Store): Promise<void> {
  const dialog = document.createElement("dialog");
  dialog.id = "how";
  dialog.tabIndex = -1;
  dialog.setAttribute("aria-labelledby", "how-title");
  dialog.innerHTML = PAGE;
  document.body.append(dialog);
  dialog.showModal();
  dialog.focus();
  const at = viewer.scene.answer.question.viewpoint;
  let thinned: Thinned;
  try {
    thinned = await Thinned.of(viewer.scene.cloud, at);
  } catch (error) {
    dialog.remove();
    throw error;
  }
  const lesson = new Lesson(dialog, thinned, turnFrom(viewer, upVector(store.current.up)));
  dialog.addEventListener("close", () => {
    lesson.end();
    dialog.remove();
  });
  await lesson.begin();
}

class Lesson {
  readonly #dialog: HTMLDialogElement;
  readonly #thinned: Thinned;
  readonly #slider: HTMLInputElement;
  readonly #calm = matchMedia("(prefers-reduced-motion: reduce)");
  #turn: Turn;
  #flipped: Flipped | null = null;
  /** The points that the eye sees with the automatic radius. */
  #seen: Uint8Array | null = null;
  #begun = 0;
  #frame = 0;

  constructor(dialog: HTMLDialogElement, thinned: Thinned, turn: Turn) {
    this.#dialog = dialog;
    this.#thinned = thinned;
    this.#turn = turn;
    this.#slider = this.#part("#how-radius", HTMLInputElement);
    this.#slider.valueAsNumber = thinned.automatic;
    this.#slider.addEventListener("input", () => void this.#flip());
    const acts: Record<string, () => void> = {
      automatic: () => {
        this.#slider.valueAsNumber = thinned.automatic;
        void this.#flip();
      },
      again: () => this.#fly(),
      close: () => dialog.close(),
    };
    for (const button of dialog.querySelectorAll<HTMLButtonElement>("[data-do]")) {
      button.addEventListener("click", acts[button.dataset["do"]!]!);
    }
    // A click beside it is a click on the dialog itself.
    dialog.addEventListener("click", (event) => {
      if (event.target === dialog) dialog.close();
    });
    for (const canvas of dialog.querySelectorAll("canvas")) this.#bindDrag(canvas);
    addEventListener("resize", this.#redraw);
  }

  async begin(): Promise<void> {
    await this.#flip();
    this.#seen ??= this.#flipped && this.#flipped.visible;
    this.#tell();
    this.#fly();
  }

  end(): void {
    cancelAnimationFrame(this.#frame);
    removeEventListener("resize", this.#redraw);
    this.#thinned.dispose();
  }

  async #flip(): Promise<void> {
    try {
      this.#flipped = await this.#thinned.flip(this.#slider.valueAsNumber);
    } catch (error) {
      // A newer radius has been asked for, or the lesson has ended.
      if (this.#dialog.isConnected && !(error instanceof DOMException)) throw error;
      return;
    }
    this.#tell();
    this.#redraw();
  }

  #kinds(): Uint8Array {
    const seen = this.#seen;
    return this.#flipped!.visible.map((isVisible, i) => {
      if (seen === null || seen[i] === isVisible) return isVisible ? VISIBLE : HIDDEN;
      return isVisible ? WRONG : MISSED;
    });
  }

  #tell(): void {
    if (!this.#flipped) return;
    const counts = [0, 0, 0, 0];
    for (const kind of this.#kinds()) counts[kind]!++;
    const legend: [string, number, string][] = [
      ["--plain", counts[VISIBLE]!, "on the hull: seen"],
      ["--hidden-dimmed", counts[HIDDEN]!, "inside the hull: hidden"],
      ["--only-ours", counts[WRONG]!, "more than with the automatic radius"],
      ["--only-reference", counts[MISSED]!, "fewer than with the automatic radius"],
    ];
    this.#part("ul", HTMLUListElement).replaceChildren(
      ...legend.map(([color, count, words]) => {
        const row = document.createElement("li");
        const swatch = document.createElement("i");
        swatch.style.setProperty("--own", color === "--plain" ? this.#theme().plain : `var(${color})`);
        row.append(swatch, `${number.format(count)} ${words}`);
        return row;
      }),
    );
    const exponent = this.#slider.valueAsNumber;
    const times = this.#flipped.radius / this.#thinned.farthest;
    this.#part("output", HTMLOutputElement).value =
      `${times < 10 ? times.toFixed(1) : number.format(Math.round(times))} × the farthest distance`;
    this.#slider.ariaValueText = this.#part("output", HTMLOutputElement).value;
    this.#part("[data-say]", HTMLElement).textContent = verdict(exponent - this.#thinned.automatic);
  }

  #fly(): void {
    this.#begun = performance.now();
    this.#redraw();
  }

  readonly #redraw = () => {
    cancelAnimationFrame(this.#frame);
    this.#frame = requestAnimationFrame(() => this.#draw());
  };

  #draw(): void {
    if (!this.#flipped) return;
    const share = this.#calm.matches ? 1 : Math.min(1, (performance.now() - this.#begun) / FLIGHT);
    const { plain, hiddenDimmed, onlyOurs, onlyReference, accent } = this.#theme();
    const soft = getComputedStyle(this.#dialog).getPropertyValue("--soft");
    const drawn: Drawn = {
      thinned: this.#thinned,
      flipped: this.#flipped,
      kinds: this.#kinds(),
      turn: this.#turn,
      // It begins and ends slowly.
      progress: eased(share),
      colors: {
        visible: plain,
        hidden: hiddenDimmed,
        wrong: onlyOurs,
        missed: onlyReference,
        accent,
        soft,
        face: plain,
      },
    };
    drawCloud(this.#part('[data-picture="cloud"]', HTMLCanvasElement), drawn);
    drawFlipped(this.#part('[data-picture="flipped"]', HTMLCanvasElement), drawn);
    if (share < 1) this.#redraw();
  }

  #bindDrag(canvas: HTMLCanvasElement): void {
    canvas.addEventListener("pointerdown", (event) => canvas.setPointerCapture(event.pointerId));
    canvas.addEventListener("pointermove", (event) => {
      if (!canvas.hasPointerCapture(event.pointerId)) return;
      const { right, up, out } = this.#turn;
      const [sideways, upward] = [event.movementX / 150, event.movementY / 150];
      this.#turn = turned(turned({ right, up, out }, "right", "out", -sideways), "up", "out", upward);
      this.#redraw();
    });
  }

  #theme() {
    return THEMES[document.documentElement.dataset["theme"] === "light" ? "light" : "dark"];
  }

  #part<T extends HTMLElement>(selector: string, type: abstract new () => T): T {
    const found = this.#dialog.querySelector(selector);
    if (!(found instanceof type)) throw new Error(`The lesson has no ${selector}.`);
    return found;
  }
}

/** What the radius does, by how far its exponent is from the automatic one. */
function verdict(above: number): string {
  if (above > NEAR) {
    return "Too large: the flipped points are almost a sphere, so nearly all of them lie on the hull. Points of the back shine through the front.";
  }
  if (above < -NEAR) {
    return "Too small: the sphere bends the flipped points so much that the hull passes over hollows. Visible points are missed.";
  }
  return "About the automatic radius: most points of the front lie on the hull, and most points behind them stay inside it.";
}

/** The second camera stands at the side: it sees the eye and the cloud beside each other. */
function turnFrom(viewer: Viewer, up: readonly number[]): Turn {
  const { cloud, answer } = viewer.scene;
  const ahead = unit(cloud.center.map((value, axis) => value - answer.question.viewpoint[axis]!));
  const across = cross(ahead, up);
  const right = Math.hypot(...across) > 1e-6 ? ahead : [1, 0, 0];
  const out = unit(Math.hypot(...across) > 1e-6 ? across : cross(right, up));
  const flat = { right, up: cross(out, right), out };
  return turned(turned(flat, "right", "out", 0.5), "up", "out", 0.35);
}

/** Turns two of the three directions. */
function turned(turn: Turn, a: keyof Turn, b: keyof Turn, angle: number): Turn {
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  return {
    ...turn,
    [a]: turn[a].map((value, axis) => cos * value - sin * turn[b][axis]!),
    [b]: turn[b].map((value, axis) => sin * turn[a][axis]! + cos * value),
  };
}

function cross(a: readonly number[], b: readonly number[]): number[] {
  return [a[1]! * b[2]! - a[2]! * b[1]!, a[2]! * b[0]! - a[0]! * b[2]!, a[0]! * b[1]! - a[1]! * b[0]!];
}

function unit(vector: readonly number[]): number[] {
  const length = Math.hypot(...vector) || 1;
  return vector.map((value) => value / length);
}
