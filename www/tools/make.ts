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
