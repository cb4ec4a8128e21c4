import { BATCH, save, stemOf } from "../files.ts";
import { coordinatesAt, indexInFile, measured, measuresOf, split, wayBetween } from "../figures.ts";
import { button, make, numberField } from "../make.ts";
import type { Mark } from "../marks.ts";
import type { Bench } from "../tool.ts";
import { THROUGH } from "./words.ts";

/** The width of the strip as a share of the length of the line, until the user gives one. */
const WIDTH = 0.02;
const PLOT = { width: 560, height: 320, left: 108, bottom: 44, top: 12, right: 12 };

/** The points in a strip along a line: how far along the line each one is, and how high. */
interface Strip {
  indices: Uint32Array;
  along: Float64Array;
  height: Float64Array;
  length: number;
  width: number;
  /** Whether hidden points belong to it. */
  isThrough: boolean;
}

/** A profile: the heights of the points in a strip between two clicked points. */
export class Profile {
  readonly mode = "profile";
  readonly invitation = "Click both ends of the profile.";
  readonly element: HTMLElement;
  readonly #bench: Bench;
  readonly #canvas = make("canvas", { width: String(PLOT.width), height: String(PLOT.height), role: "img" });
  readonly #width = numberField("profile-width", "Width of the strip");
  readonly #more: HTMLElement;
  #ends: number[] = [];
  #mark: Mark | null = null;
  #strip: Strip | null = null;

  constructor(bench: Bench) {
    this.#bench = bench;
    this.#width.input.addEventListener("change", () => {
      this.#find();
      bench.changed();
    });
    this.#more = make(
      "div",
      { class: "profile", hidden: true },
      this.#canvas,
      this.#width.row,
      button("Save as CSV", () => void this.#save()),
    );
    this.element = this.#more;
    // The plot has the colors of the theme in which it was drawn.
    new MutationObserver(() => {
      if (this.#strip) this.#plot(this.#strip);
    }).observe(document.documentElement, { attributeFilter: ["data-theme"] });
  }

  /** Both ends, the width and whether hidden points belong to it, for the address. `null`: it is not finished. */
  get words(): string | null {
    if (!this.#strip || !(this.#strip.width > 0)) return null;
    const { width, isThrough } = this.#strip;
    return [...this.#ends, width, ...(isThrough ? [THROUGH] : [])].join();
  }

  /** Takes an end. Returns what is known then. `width`: the width of the strip. */
  add(index: number, width?: number): Node[] {
    if (this.#ends.length === 2) this.clear();
    this.#ends.push(index);
    const [from, to] = this.#ends;
    this.#mark?.remove();
    if (to === undefined) {
      this.#mark = this.#bench.marks.ring(from!);
      return [document.createTextNode("Now the other end.")];
    }
    const { viewer } = this.#bench;
    const measures = measuresOf(viewer.cloud!);
    const { horizontal } = split(wayBetween(viewer.scene, from!, to, measures), this.#bench.upward());
    this.#mark = this.#bench.marks.line(from!, to, measured(horizontal, measures.unit));
    this.#width.input.value = String(width ?? Number((WIDTH * horizontal).toPrecision(2)));
    this.#more.hidden = false;
    return [document.createTextNode(this.#find())];
  }

  clear(): void {
    this.#ends = [];
    this.#mark?.remove();
    this.#mark = null;
    this.#strip = null;
    this.#more.hidden = true;
  }

  #find(): string {
    const { viewer, through } = this.#bench;
    const { scene } = viewer;
    const [from, to] = this.#ends as [number, number];
    const measures = measuresOf(scene.cloud);
    const upward = this.#bench.upward();
    const flat = (way: readonly number[]) => way.map((value, axis) => (upward[axis] === 0 ? value : 0));
    const line = flat(wayBetween(scene, from, to, measures));
    const length = Math.hypot(...line);
    const width = Math.abs(this.#width.input.valueAsNumber) || 0;
    const isThrough = through();
    const among = isThrough ? null : scene.visible;
    const count = among?.length ?? scene.cloud.count;
    const found: { index: number; along: number; height: number }[] = [];
    for (let k = 0; k < count; k++) {
      const index = among ? among[k]! : k;
      const way = wayBetween(scene, from, index, measures);
      const along = length > 0 ? flat(way).reduce((sum, value, axis) => sum + value * line[axis]!, 0) / length : 0;
      if (along < 0 || along > length) continue;
      const across = Math.sqrt(Math.max(0, Math.hypot(...flat(way)) ** 2 - along ** 2));
      if (across > width / 2) continue;
      const height = upward.reduce(
        (sum, part, axis) => sum + part * measures.scale[axis]! * scene.positions[3 * index + axis]!,
        0,
      );
      found.push({ index, along, height });
    }
    found.sort((a, b) => a.along - b.along);
    this.#strip = {
      indices: Uint32Array.from(found, ({ index }) => index),
      along: Float64Array.from(found, ({ along }) => along),
      height: Float64Array.from(found, ({ height }) => height),
      length,
      width,
      isThrough,
    };
    this.#plot(this.#strip);
    return saidOf(this.#strip);
  }

  #plot(strip: Strip): void {
    const { along, height, length } = strip;
    const said = saidOf(strip);
    const [low, high] = height.reduce(
      ([a, b], value) => [Math.min(a, value), Math.max(b, value)],
      [Infinity, -Infinity],
    );
    const { unit } = measuresOf(this.#bench.viewer.cloud!);
    const style = getComputedStyle(this.#canvas);
    const context = this.#canvas.getContext("2d")!;
    const [wide, tall] = [PLOT.width - PLOT.left - PLOT.right, PLOT.height - PLOT.top - PLOT.bottom];
    context.clearRect(0, 0, PLOT.width, PLOT.height);
    context.fillStyle = context.strokeStyle = style.color;
    context.strokeRect(PLOT.left, PLOT.top, wide, tall);
    context.font = `26px ${style.fontFamily}`;
    const empty = !(high >= low);
    const text = (value: number) => String(Number(value.toPrecision(6)));
    if (!empty) {
      context.textAlign = "right";
      context.fillText(text(high), PLOT.left - 6, PLOT.top + 22, PLOT.left - 8);
      context.fillText(text(low), PLOT.left - 6, PLOT.top + tall, PLOT.left - 8);
      context.fillText(measured(length, unit), PLOT.left + wide, PLOT.height - 10);
      context.textAlign = "left";
      context.fillText("0", PLOT.left, PLOT.height - 10);
    }
    context.fillStyle = style.getPropertyValue("--accent");
    for (let i = 0; i < along.length; i++) {
      const x = PLOT.left + (length > 0 ? along[i]! / length : 0) * wide;
      const y = PLOT.top + (high > low ? (high - height[i]!) / (high - low) : 0.5) * tall;
      context.fillRect(x - 1, y - 1, 3, 3);
    }
    this.#canvas.ariaLabel = empty
      ? said
      : `Profile: ${said}, heights from ${text(low)} to ${text(high)} over ${measured(length, unit)}`;
  }

  async #save(): Promise<void> {
    if (!this.#strip) return;
    await save(`${stemOf(this.#bench.name())}-profile.csv`, this.#csv(this.#strip));
  }

  *#csv({ indices, along, height }: Strip): Generator<string> {
    const { scene } = this.#bench.viewer;
    yield "index,along,height,x,y,z\n";
    for (let from = 0; from < indices.length; from += BATCH) {
      const lines = Array.from(indices.subarray(from, from + BATCH), (index, k) => {
        const figures = [along[from + k]!, height[from + k]!].map((value) => Number(value.toPrecision(12)));
        return [indexInFile(scene.cloud, index), ...figures, ...coordinatesAt(scene, index)].join();
      });
      yield `${lines.join("\n")}\n`;
    }
  }
}

function saidOf({ indices: { length } }: Strip): string {
  return `${length.toLocaleString("en-US")} ${length === 1 ? "point" : "points"} in the strip`;
}
