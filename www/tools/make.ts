import { type Cloud, type Field, type Unit, valueAt } from "../cloud/cloud.ts";

// Parts of a card that is made when its tool is opened.

/** An element with attributes and content. An attribute that is `true` or `false` is there or not. */
export function make<Name extends keyof HTMLElementTagNameMap>(
  name: Name,
  attributes: Record<string, string | boolean> = {},
  ...content: (Node | string)[]
): HTMLElementTagNameMap[Name] {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (typeof value === "boolean") element.toggleAttribute(key, value);
    else element.setAttribute(key, value);
  }
  element.append(...content);
  return element;
}

export function button(
  text: string | Node,
  run: () => void,
  attributes: Record<string, string | boolean> = {},
): HTMLButtonElement {
  const element = make("button", { type: "button", ...attributes }, text);
  element.addEventListener("click", run);
  return element;
}

/** Opens a dialog with a heading, its content and a button that closes it. It is removed when it is closed. */
export function openDialog(id: string, title: string, ...content: (Node | string)[]): HTMLDialogElement {
  const dialog = make(
    "dialog",
    { id, tabindex: "-1", "aria-labelledby": `${id}-title` },
    make("h2", { id: `${id}-title` }, title),
    ...content,
    button("Close", () => dialog.close()),
  );
  dialog.addEventListener("close", () => dialog.remove());
  // A click beside it is a click on the dialog itself.
  dialog.addEventListener("click", (event) => {
    if (event.target === dialog) dialog.close();
  });
  document.body.append(dialog);
  dialog.showModal();
  // It is read and scrolled from its beginning.
  dialog.focus();
  dialog.scrollTop = 0;
  return dialog;
}

/** A number with its label. */
export function numberField(id: string, text: string): { row: HTMLElement; input: HTMLInputElement } {
  const input = make("input", { id, type: "number", step: "any" });
  return { row: make("div", { class: "number" }, make("label", { for: id }, text), input), input };
}

/** A row of a table: its first cell is its head. */
export function tableRow(head: string, ...cells: (string | Node)[]): HTMLTableRowElement {
  const row = make("tr", {}, make("th", { scope: "row" }, head));
  for (const cell of cells) row.append(make("td", {}, cell));
  return row;
}

// Numbers of a cloud as texts.

/** A cloud with the file's own coordinates. */
export interface Placed {
  cloud: Cloud;
  positions: Float32Array | Float64Array;
}

/**
 * The coordinates of a point with the file's own digits. A LAS file stores integers and a scale, and says the decimals.
 * For other files it is the shortest text that gives the same number when it is read.
 */
export function coordinatesAt({ cloud, positions }: Placed, index: number): [string, string, string] {
  const { decimals } = cloud.facts;
  const text = (axis: 0 | 1 | 2) => {
    const value = positions[3 * index + axis]!;
    return decimals ? value.toFixed(decimals[axis]) : shortest(value, positions);
  };
  return [text(0), text(1), text(2)];
}

/** The index of a point in its file. Some points of the file may be left out. */
export function indexInFile({ origin }: Cloud, index: number): number {
  return origin ? origin[index]! : index;
}

/** A point's number in a column, with its meaning if that is known. */
export function fieldText(field: Field, index: number): string {
  const value = valueAt(field, index);
  const label = field.labels?.[value];
  const text = shortest(value, field.values);
  return label === undefined ? text : `${text} (${label})`;
}

/** The shortest text for a number that was stored with four or with eight bytes. */
export function shortest(value: number, { constructor }: { constructor: unknown }): string {
  if (constructor !== Float32Array || !Number.isFinite(value)) return String(value);
  for (let digits = 6; digits < 9; digits++) {
    const text = String(Number(value.toPrecision(digits)));
    if (Math.fround(Number(text)) === value) return text;
  }
  return String(Number(value.toPrecision(9)));
}

/** The part of a vector across the upward axis, and the part along it. */
export function split(vector: readonly number[], upward: readonly number[]): { horizontal: number; height: number } {
  const height = upward.reduce((sum, part, axis) => sum + part * vector[axis]!, 0);
  const rest = upward.map((part, axis) => (part === 0 ? vector[axis]! : 0));
  return { horizontal: Math.hypot(...rest), height };
}

/** How lengths in a cloud are measured: the length of each axis's unit in the common unit. */
export interface Measures {
  /** `null`: the file does not say it. */
  unit: Unit | null;
  scale: [number, number, number];
}

/** The unit of a cloud. If heights have a unit of their own, everything is converted to meters. */
export function measuresOf({ facts: { crs } }: Cloud): Measures {
  const { unit = null, heightUnit = null } = crs ?? {};
  if (!unit || !heightUnit || unit.meters === heightUnit.meters) return { unit, scale: [1, 1, 1] };
  return { unit: { name: "m", meters: 1 }, scale: [unit.meters, unit.meters, heightUnit.meters] };
}

/** The way from one point to another, in the unit of `measures`. */
export function wayBetween({ positions }: Placed, from: number, to: number, { scale }: Measures): number[] {
  return scale.map((length, axis) => length * (positions[3 * to + axis]! - positions[3 * from + axis]!));
}

/** A length to the centimeter, or with three digits if that is more. Without a unit it has six digits. */
export function measured(value: number, unit: Unit | null): string {
  const decimals = unit ? Math.max(0, 2 + Math.ceil(Math.log10(unit.meters))) : 0;
  const three = value === 0 ? 0 : 2 - Math.floor(Math.log10(Math.abs(value)));
  const digits = unit ? Number(value.toFixed(Math.min(20, Math.max(decimals, three)))) : Number(value.toPrecision(6));
  const text =
    Math.abs(digits) >= 1e7 || Math.abs(digits) < 1e-6
      ? String(digits)
      : digits.toLocaleString("en-US", { useGrouping: false, maximumFractionDigits: 12 });
  return `${text}\u00a0${unit?.name ?? (text === "1" ? "unit" : "units")}`;
}
