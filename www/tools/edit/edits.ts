import type { Attribute, Cloud, LoadedCloud } from "../../cloud/cloud.ts";
import { type Field, valueAt } from "../../cloud/facts.ts";
import { partOf } from "../../cloud/part.ts";
import { prepareCloud } from "../../cloud/prepare.ts";
import { byId } from "../../controls/dom.ts";
import { CLASSES, CLASSIFICATION } from "../../../src/ts/formats/las/classes.js";
import type { Store } from "../../settings/store.ts";
import { STATION_COLORS } from "../../settings/table.ts";
import type { ExportActions, OpenedCloud } from "../export.ts";
import { indicesWhere } from "../indices.ts";
import { button, make } from "../make.ts";
import type { Select } from "../select.ts";
import type { Bench } from "../tool.ts";
import { rangeFields } from "./range.ts";

/** A point whose class nobody has set. */
const UNCLASSIFIED = 1;
const MOST_STEPS = 10;

const number = new Intl.NumberFormat("en-US");

/** A change that can be undone. */
interface Step {
  /** The name of the button that undoes it. */
  said: string;
  undo: () => void | Promise<void>;
}

/** Changes of the selected points: only these are kept, they are hidden, or they get a class. */
export class Edits {
  readonly #bench: Bench;
  readonly #store: Store;
  readonly #select: Select;
  readonly #actions: ExportActions;
  readonly #class = make(
    "select",
    { "aria-label": "Class for the selected points" },
    ...Object.entries(CLASSES).map(
      ([value, name]) => new Option(`${value} ${name}`, value, value === "2", value === "2"),
    ),
  );
  readonly #ofSelected: HTMLElement;
  readonly #undo = button("Undo", () => void this.#takeBack(), { hidden: true });
  readonly #said = make("output", { id: "edit-result" });
  readonly #range: ReturnType<typeof rangeFields>;
  #steps: Step[] = [];
  /** Whether another cloud is being shown because of a change here. */
  isOwn = false;
  /** How many steps back all points of the file are on screen. */
  #parts = 0;

  constructor(bench: Bench, store: Store, select: Select, actions: ExportActions, card: HTMLElement) {
    this.#bench = bench;
    this.#store = store;
    this.#select = select;
    this.#actions = actions;
    this.#range = rangeFields(bench, (indices) => {
      select.choose(indices);
    });
    this.#ofSelected = make(
      "div",
      { class: "files", hidden: true },
      button("Keep these", () => void this.#keep(select.indices)),
      button("Hide these", () => void this.#keep(this.#others())),
      this.#class,
      button("Set the class", () => {
        this.#classify();
      }),
    );
    const invert = button("Invert", () => {
      select.choose(this.#others());
    });
    card.append(
      this.#range.element,
      this.#ofSelected,
      make("div", { class: "buttons" }, invert, this.#undo),
      this.#said,
    );
    this.follow();
  }

  /** Called when other points are selected. */
  follow(): void {
    this.#ofSelected.hidden = this.#select.indices.length === 0;
    this.#range.element.hidden = !this.#select.isRange;
    if (this.#select.isRange) this.#range.fill();
  }

  /** Called when another cloud is about to be shown. */
  clear(): void {
    this.#range.forget();
    if (this.isOwn) return;
    this.#steps = [];
    this.#parts = 0;
    this.#said.textContent = "";
    this.#showUndo();
  }

  /** All points that are not selected, ascending. */
  #others(): Uint32Array {
    const chosen = new Uint8Array(this.#bench.viewer.scene.cloud.count);
    for (const index of this.#select.indices) chosen[index] = 1;
    return indicesWhere(chosen.length, (index) => chosen[index] === 0);
  }

  async #keep(indices: Uint32Array): Promise<void> {
    const { viewer } = this.#bench;
    if (!viewer.cloud) return;
    if (indices.length === 0) {
      this.#said.textContent = "No point would be left.";
      return;
    }
    const before = loadedFrom(viewer.scene);
    const isWhole = this.#parts === 0;
    const name = this.#bench.name();
    await this.#show(partOf(before, indices), `${name.replace(/ \(part\)$/, "")} (part)`, false);
    this.#parts++;
    this.#push({
      said: `Undo: all ${number.format(before.positions.length / 3)} points`,
      undo: async () => {
        this.#parts--;
        await this.#show(before, name, isWhole);
      },
    });
  }

  /** Shows other points of the cloud on screen, from the same place. `isWhole`: they are all of its points again. */
  async #show(cloud: LoadedCloud, name: string, isWhole: boolean): Promise<void> {
    const { viewer } = this.#bench;
    const whole = this.#actions.whole();
    if (!whole || !viewer.cloud) return;
    const { freeze, lights, color, size, fieldOfView, up } = this.#store.current;
    const of = whole.request.kind === "made" ? null : whole.request;
    const source: OpenedCloud = {
      request: { kind: "made", name, make: () => prepareCloud(cloud), of: isWhole ? of : null },
      sample: isWhole ? whole.sample : null,
      name: isWhole ? whole.name : null,
      view: { at: viewer.viewpoint, target: viewer.target ?? [...viewer.cloud.center] },
      // The colors by stations come back when the stations are asked about the other points.
      settings: { freeze, lights, size, fieldOfView, up, ...(color === STATION_COLORS ? {} : { color }) },
      notes: [],
    };
    this.isOwn = true;
    this.#said.textContent = "";
    try {
      await this.#actions.open(source, whole);
      this.#said.textContent = `${number.format(cloud.positions.length / 3)} points are left.`;
    } finally {
      this.isOwn = false;
    }
  }

  #classify(): void {
    const { viewer } = this.#bench;
    const { cloud } = viewer.scene;
    const before = cloud.fields.find(({ name }) => name === CLASSIFICATION);
    const attribute = cloud.attributes.find(({ name }) => name === CLASSIFICATION) ?? null;
    const color = this.#store.current.color;
    const values = Uint8Array.from({ length: cloud.count }, (_, i) => (before ? valueAt(before, i) : UNCLASSIFIED));
    const { indices } = this.#select;
    for (const index of indices) values[index] = Number(this.#class.value);
    const labels = { ...CLASSES, ...before?.labels };
    this.#setClasses(
      { name: CLASSIFICATION, values, labels },
      { name: CLASSIFICATION, kind: "category", values, labels },
    );
    this.#store.change({ color: CLASSIFICATION });
    const text = this.#class.selectedOptions[0]!.text;
    this.#said.textContent = `${number.format(indices.length)} points have class ${text}.`;
    this.#push({
      said: `Undo: class ${text}`,
      undo: () => {
        if (this.#store.current.color === CLASSIFICATION && !attribute) this.#store.change({ color });
        this.#setClasses(before ?? null, attribute);
        this.#said.textContent = "";
      },
    });
  }

  #setClasses(field: Field | null, attribute: Attribute | null): void {
    const { viewer } = this.#bench;
    const { cloud } = viewer.scene;
    cloud.fields = replaced(cloud, field);
    viewer.setAttribute(CLASSIFICATION, attribute);
  }

  #push(step: Step): void {
    this.#steps = [...this.#steps, step].slice(-MOST_STEPS);
    this.#showUndo();
  }

  async #takeBack(): Promise<void> {
    const step = this.#steps.pop();
    this.#undo.disabled = true;
    await step?.undo();
    this.#undo.disabled = false;
    this.#showUndo();
    byId("view").focus();
  }

  #showUndo(): void {
    this.#undo.hidden = this.#steps.length === 0;
    this.#undo.title = this.#steps.at(-1)?.said ?? "";
  }
}

/** The columns of a cloud with another one for the classes. `null`: with none. */
function replaced({ fields }: Cloud, field: Field | null): Field[] {
  if (!field) return fields.filter(({ name }) => name !== CLASSIFICATION);
  return fields.some(({ name }) => name === CLASSIFICATION)
    ? fields.map((other) => (other.name === CLASSIFICATION ? field : other))
    : [...fields, field];
}

/** The cloud on screen as a loader would hand it over. */
function loadedFrom({ cloud, positions }: { cloud: Cloud; positions: LoadedCloud["positions"] }): LoadedCloud {
  const { colors, attributes, fields, facts, origin } = cloud;
  return { positions, colors, attributes: [...attributes], fields: [...fields], facts, ...(origin && { origin }) };
}
