import type { Attribute } from "../cloud/cloud.ts";
import { byId } from "../controls/controls.ts";
import type { Box, Store, Viewpoint } from "../settings/settings.ts";
import type { Viewer } from "../view/viewer.ts";
import { endsOf } from "./information.ts";
import { button, make, numberField } from "./make.ts";

/** The controls of the part that is looked at: a check box for each class, and the sides of a box. */
export class PartControls {
  readonly #viewer: Viewer;
  readonly #store: Store;
  /** The boxes of the classes, and the sides of the clip box: x, y, z of its lower corner, then of its upper one. */
  #classes: { value: number; input: HTMLInputElement }[] = [];
  readonly #sides = ["from", "to"].flatMap((end) =>
    ["x", "y", "z"].map((axis) => numberField(`${axis}-${end}`, `${axis} ${end}`)),
  );
  readonly #list = make("div", { class: "checks" });
  #ends: Box | null = null;
  #column: Attribute | undefined;

  constructor(viewer: Viewer, store: Store, selected: () => Uint32Array) {
    this.#viewer = viewer;
    this.#store = store;
    for (const { input } of this.#sides) input.addEventListener("change", () => this.#clip());
    const clip = () => {
      const indices = selected();
      const { positions } = viewer.scene;
      const chosen = Float64Array.from(
        { length: 3 * indices.length },
        (_, i) => positions[3 * indices[Math.floor(i / 3)]! + (i % 3)]!,
      );
      if (indices.length > 0) store.change({ box: endsOf(chosen) });
    };
    byId("part").append(
      this.#list,
      ...this.#sides.map(({ row }) => row),
      make(
        "div",
        { class: "buttons" },
        button("Box of the selection", clip),
        button("All points", () => store.change({ box: null, without: null })),
      ),
    );
    store.follow(() => this.#show());
  }

  /** Called when a cloud is shown. */
  begin(): void {
    const { cloud, positions } = this.#viewer.scene;
    this.#ends = endsOf(positions);
    const categories = cloud.attributes.filter(({ kind }) => kind === "category");
    const column = (this.#column = categories.find(({ name }) => /class/i.test(name)) ?? categories[0]);
    const values = [...new Set(column?.values)].sort((a, b) => a - b);
    this.#classes = values.map((value) => {
      const input = make("input", { type: "checkbox" });
      input.addEventListener("change", () => this.#choose());
      return { value, input };
    });
    this.#list.replaceChildren(
      ...this.#classes.map(({ value, input }) =>
        make("label", {}, input, column!.labels?.[value] ?? `${column!.name} ${value}`),
      ),
    );
    this.#show();
  }

  #choose(): void {
    const values = this.#classes.filter(({ input }) => !input.checked).map(({ value }) => value);
    this.#store.change({ without: values.length > 0 ? { column: this.#column!.name, values } : null });
  }

  /** An empty side, and one in the wrong order, is that of the cloud. */
  #clip(): void {
    const sides = this.#sides.map(({ input }, i) =>
      Number.isNaN(input.valueAsNumber) ? this.#ends!.flat()[i]! : input.valueAsNumber,
    );
    const [low, high] = [sides.slice(0, 3), sides.slice(3)];
    const box: Box = [low, high].map(
      (_, end) => low.map((a, axis) => (end === 0 ? Math.min : Math.max)(a, high[axis]!)) as Viewpoint,
    ) as Box;
    this.#store.change({ box: box.join() === this.#ends!.join() ? null : box });
  }

  #show(): void {
    const { box, without } = this.#store.current;
    for (const { value, input } of this.#classes) {
      input.checked = !(without?.column === this.#column?.name && without?.values.includes(value));
    }
    const sides = (box ?? this.#ends ?? []).flat();
    for (const [i, { input }] of this.#sides.entries()) input.value = String(sides[i] ?? "");
  }
}
