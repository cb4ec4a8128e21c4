import type { TimedView } from "../ask/inquiry.ts";
import type { AgainstPicture } from "../compare/against-picture.ts";
import type { AgainstSurface } from "../compare/against-surface.ts";
import { byId } from "../controls/dom.ts";
import { Segmented } from "../controls/segmented.ts";
import { Slider } from "../controls/slider.ts";
import type { KnownSurface } from "../samples/samples.ts";
import type { Against } from "../settings/settings.ts";
import { SLIDERS } from "../settings/sliders.ts";
import type { Store } from "../settings/store.ts";

const number = new Intl.NumberFormat("en-US");

interface Row {
  label: string;
  color?: string;
  count: number;
  more: string;
}

/** The words on both sides of the divider. */
export interface Sides {
  left: string;
  right: string;
}

/** The choice of the comparison, and its figures. */
export class CompareCard {
  readonly #card = byId("compare-card");
  readonly #against: Segmented<Against>;
  readonly #surfaceChoice = this.#card.querySelector<HTMLInputElement>('[value="surface"]')!;
  readonly #againstNote = byId("against-note");
  readonly #splat: Slider;
  readonly #splatAuto = byId("splat-auto", HTMLButtonElement);
  readonly #tracing = byId("compare-tracing");
  readonly #progress = byId("compare-progress", HTMLProgressElement);
  readonly #stop = byId("compare-stop", HTMLButtonElement);
  readonly #figures = byId("compare-figures", HTMLTableElement);
  readonly #result = byId("compare-result");
  readonly #store: Store;

  /** `onStop`: stops the tracing, or starts it again. */
  constructor(store: Store, onStop: () => void) {
    this.#store = store;
    this.#against = new Segmented<Against>("against", (against) => {
      store.change({ against });
    });
    this.#surfaceChoice.setAttribute("aria-describedby", this.#againstNote.id);
    this.#splat = new Slider("splat", SLIDERS.splat.text, (splat) => {
      store.change({ splat });
    });
    this.#splatAuto.addEventListener("click", () => {
      store.change({ splat: "auto" });
    });
    this.#stop.addEventListener("click", onStop);
  }

  /** Shows the card of a comparison. `null`: nothing is compared. */
  show(surface: KnownSurface | string | null): void {
    this.#card.hidden = surface === null;
    if (surface === null) return;
    const { against, splat } = this.#store.current;
    this.#against.value = against;
    const unknown = typeof surface === "string";
    this.#surfaceChoice.disabled = unknown;
    this.#againstNote.hidden = !unknown;
    this.#againstNote.textContent = unknown ? `No true surface. ${surface}` : "";
    byId("splat-choice").hidden = against !== "zbuffer";
    this.#splatAuto.setAttribute("aria-pressed", String(splat === "auto"));
    if (splat !== "auto") this.#splat.value = splat;
  }

  /** Shows a comparison with all points, which has no figures. */
  showAll(): void {
    this.#tracing.hidden = true;
    this.#fill([], 0, 0);
    this.#result.textContent = "";
  }

  /** Returns `null` as long as there is no result. Until then, all points are on the left. */
  showPicture({ result, problem }: AgainstPicture): Sides | null {
    this.#tracing.hidden = true;
    if (problem !== null || !result) {
      this.#fill([], 0, 0);
      this.#result.textContent = problem ?? "";
      return null;
    }
    const { picture, ours } = result;
    const [both, onlyOurs, onlyReference, outside] = picture.parts.ends;
    const [mine, theirs] = [onlyOurs - both, onlyReference - onlyOurs];
    if (this.#store.current.splat === "auto") this.#splat.value = picture.splat;
    const share = (count: number) => percent(count, picture.inside);
    this.#fill(
      [
        { label: "Z-buffer", count: picture.visible, more: time(picture.milliseconds) },
        { label: nameOf(ours), count: onlyOurs, more: time(ours.milliseconds) },
        { label: "Only the z-buffer", color: "var(--only-reference)", count: theirs, more: share(theirs) },
        { label: `Only ${nameOf(ours)}`, color: "var(--only-ours)", count: mine, more: share(mine) },
      ],
      picture.inside,
      picture.milliseconds,
    );
    const beyond = outside - onlyReference;
    const more =
      beyond > 0
        ? ` Outside the picture, ${nameOf(ours)} ${ours.kind === "looks" ? "see" : "sees"} ${number.format(beyond)} more.`
        : "";
    this.#result.textContent = `Shares of the ${number.format(picture.inside)} points in the picture. The z-buffer knows no others.${more}`;
    return {
      left: `Z-buffer: ${number.format(picture.visible)}`,
      right: `${nameOf(ours)}: ${number.format(onlyOurs)}`,
    };
  }

  /** Returns `null`, too, as long as there is no result. */
  showSurface({ result, problem, progress, stopped }: AgainstSurface, total: number): Sides | null {
    this.#tracing.hidden = (progress === null && !stopped) || problem !== null || result !== null;
    this.#progress.hidden = stopped;
    this.#progress.value = progress ?? 0;
    this.#stop.textContent = stopped ? "Trace rays" : "Stop";
    if (!result) {
      this.#fill([], 0, 0);
      this.#result.textContent = problem ?? (stopped ? "Tracing was stopped." : "Rays are traced when the view rests.");
      return null;
    }
    const { truth, ours } = result;
    const [both, onlyOurs, onlyReference] = truth.parts.ends;
    const [wrong, missed] = [onlyOurs - both, onlyReference - onlyOurs];
    const { hull } = truth;
    const row = (label: string, count: number) => ({ label, count, more: percent(count, total) });
    this.#fill(
      [
        { label: "Rays", count: truth.visible, more: time(truth.milliseconds) },
        { label: nameOf(ours), count: onlyOurs, more: time(ours.milliseconds) },
        { ...row("Wrongly shown", wrong), color: "var(--only-ours)" },
        { ...row("Wrongly hidden", missed), color: "var(--only-reference)" },
        ...(hull ? [row("Wrongly shown, one hull", hull.wrong), row("Wrongly hidden, one hull", hull.missed)] : []),
      ],
      total,
      truth.milliseconds,
    );
    const before = hull ? `, with one hull ${percent(hull.wrong + hull.missed, total)}` : "";
    this.#result.textContent = `Shares of all ${number.format(total)} points. Together ${percent(wrong + missed, total)} are wrong${before}.`;
    return { left: `True: ${number.format(truth.visible)}`, right: `${nameOf(ours)}: ${number.format(onlyOurs)}` };
  }

  #fill(rows: readonly Row[], of: number, milliseconds: number): void {
    this.#figures.hidden = rows.length === 0;
    this.#figures.tBodies[0]!.replaceChildren(...rows.map(rowOf));
    Object.assign(this.#figures.dataset, {
      counts: rows.map(({ count }) => count).join(),
      of: String(of),
      milliseconds: String(milliseconds),
    });
  }
}

/** The method behind an answer, as in the panel. */
function nameOf({ kind, question }: TimedView): string {
  return kind === "looks" ? `${question.method.looks} looks` : "HPR";
}

function rowOf({ label, color, count, more }: Row): HTMLTableRowElement {
  const row = document.createElement("tr");
  const head = document.createElement("th");
  head.scope = "row";
  if (color !== undefined) {
    const swatch = document.createElement("span");
    swatch.className = "swatch";
    swatch.style.background = color;
    head.append(swatch);
  }
  head.append(label);
  row.append(head);
  for (const text of [number.format(count), more]) row.insertCell().textContent = text;
  return row;
}

function percent(count: number, of: number): string {
  return `${of > 0 ? ((100 * count) / of).toFixed(2) : "0.00"}\u00a0%`;
}

function time(milliseconds: number): string {
  if (milliseconds >= 1000) return `${(milliseconds / 1000).toFixed(1)}\u00a0s`;
  return `${milliseconds < 10 ? milliseconds.toFixed(1) : Math.round(milliseconds)}\u00a0ms`;
}
