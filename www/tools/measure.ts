import { byId } from "../controls/dom.ts";
import { Segmented } from "../controls/segmented.ts";
import type { Spot } from "./find.ts";
import { make } from "./make.ts";
import { measured, measuresOf, split, wayBetween } from "./figures.ts";
import type { Mark } from "./marks.ts";
import type { AreaMeasure } from "./measure/area.ts";
import type { Profile } from "./measure/profile.ts";
import { row } from "./pick.ts";
import type { Bench, Tool } from "./tool.ts";

/**
 * Shows the distance between two clicked points, its horizontal part and the difference of their heights, in the file's
 * units. Many distances can be shown at once. Also measures the area of a polygon, and shows a profile.
 */
export class Measure implements Tool {
  readonly name = "measure";
  readonly uses = "clicks";
  readonly #bench: Bench;
  readonly #output = byId("measure-result");
  readonly #remove = byId("measure-clear", HTMLButtonElement);
  #from: { index: number; mark: Mark } | null = null;
  #lines: { ends: readonly [number, number]; mark: Mark }[] = [];
  readonly #mode = modeChoice(() => {
    this.clear();
    void this.#begin(this.#mode.value!);
  });
  /** The measure of another kind. Its code is downloaded when it is chosen. */
  #other: AreaMeasure | Profile | null = null;

  constructor(bench: Bench) {
    this.#bench = bench;
    this.#remove.addEventListener("click", () => {
      this.clear();
      byId("view").focus();
    });
  }

  click(spot: Spot): void {
    const index = this.#bench.pointAt(spot);
    if (typeof index === "string") {
      this.#output.textContent = index;
    } else if (this.#other) {
      this.#add(this.#other, index);
    } else if (!this.#from) {
      this.#from = { index, mark: this.#bench.marks.ring(index) };
      this.#output.textContent = "Now the second point.";
    } else {
      const from = this.#from.index;
      this.#drop();
      this.measure(from, index);
    }
  }

  /** The area or the profile as words of the address. `null`: there is none, or it is not finished. */
  get other(): { mode: OtherMode; words: string } | null {
    const words = this.#other?.words ?? null;
    return words === null ? null : { mode: this.#other!.mode, words };
  }

  /**
   * Chooses an area or a profile. Resolves with a function that puts it on points. `null`: its code could not be
   * downloaded. `width`: the width of a profile's strip.
   */
  async ready(mode: OtherMode): Promise<((indices: readonly number[], width?: number) => void) | null> {
    this.#mode.value = mode;
    await this.#begin(mode);
    const other = this.#other;
    if (other?.mode !== mode) return null;
    return (indices, width) => {
      // The user may have chosen something else since.
      if (this.#other === other) for (const index of indices) this.#add(other, index, width);
    };
  }

  #add(other: AreaMeasure | Profile, index: number, width?: number): void {
    this.#output.replaceChildren(...other.add(index, width));
    this.#remove.hidden = false;
    this.#bench.changed();
  }

  /** The pairs of points whose distances are shown. */
  get pairs(): readonly (readonly [number, number])[] {
    return this.#lines.map(({ ends }) => ends);
  }

  /** The last distance. `null`: there is none. */
  get distance(): number | null {
    const { distance } = this.#output.dataset;
    return distance === undefined ? null : Number(distance);
  }

  /** Shows the distance between two points. */
  measure(from: number, to: number): void {
    const { viewer, marks } = this.#bench;
    const measures = measuresOf(viewer.cloud!);
    const { unit } = measures;
    const way = wayBetween(viewer.scene, from, to, measures);
    const distance = Math.hypot(...way);
    const { horizontal, height } = split(way, this.#bench.upward());
    this.#lines.push({ ends: [from, to], mark: marks.line(from, to, measured(distance, unit)) });
    this.#output.replaceChildren(
      row("Distance", measured(distance, unit)),
      row("Horizontal", measured(horizontal, unit)),
      row("Height difference", measured(height, unit)),
    );
    this.#output.dataset["distance"] = String(distance);
    this.#remove.hidden = false;
    this.#bench.changed();
  }

  cancel(): boolean {
    const begun = this.#from !== null;
    this.#drop();
    if (begun) this.#invite();
    return begun;
  }

  leave(): void {
    this.cancel();
  }

  clear(): void {
    this.#drop();
    for (const { mark } of this.#lines.splice(0)) mark.remove();
    this.#other?.clear();
    this.#invite();
    delete this.#output.dataset["distance"];
    this.#remove.hidden = true;
    this.#bench.changed();
  }

  async #begin(mode: Mode): Promise<void> {
    if (this.#other && "element" in this.#other) this.#other.element.remove();
    this.#other = null;
    this.#invite();
    try {
      if (mode === "area") this.#other = new (await import("./measure/area.ts")).AreaMeasure(this.#bench);
      if (mode === "profile") {
        const profile = new (await import("./measure/profile.ts")).Profile(this.#bench);
        byId("measure-card").append(profile.element);
        this.#other = profile;
      }
    } catch {
      this.#mode.value = "distance";
    }
    this.#invite();
  }

  #invite(): void {
    this.#output.textContent = this.#other?.invitation ?? "Click two points.";
  }

  #drop(): void {
    this.#from?.mark.remove();
    this.#from = null;
  }
}

type OtherMode = AreaMeasure["mode"] | Profile["mode"];
type Mode = "distance" | OtherMode;

/** The choice of what is measured. It is made here, so that it is not part of the first download. */
function modeChoice(onChange: () => void): Segmented<Mode> {
  const choice = make("fieldset", { id: "measure-what", class: "segmented" });
  choice.append(make("legend", { class: "unseen" }, "What is measured"));
  for (const [i, mode] of ["distance", "area", "profile"].entries()) {
    const input = make("input", { type: "radio", name: "measure-what", value: mode });
    input.checked = i === 0;
    choice.append(make("label", {}, input, mode[0]!.toUpperCase() + mode.slice(1)));
  }
  byId("measure-card").prepend(choice);
  return new Segmented<Mode>("measure-what", onChange);
}
