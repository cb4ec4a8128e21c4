import { button, make } from "../make.ts";
import { coordinatesAt } from "../figures.ts";
import { indicesWhere } from "../indices.ts";
import type { Bench } from "../tool.ts";

const AXES = ["x", "y", "z"] as const;

/** Fields for a box in the file's coordinates, and a button that selects the points in it. */
export function rangeFields(
  bench: Bench,
  choose: (indices: Uint32Array) => void,
): { element: HTMLElement; fill: () => void; forget: () => void } {
  const rows = AXES.map((axis) => {
    const input = (end: string) =>
      make("input", { type: "number", step: "any", "aria-label": `${end} ${axis} of the box` });
    return { axis, low: input("Least"), high: input("Greatest") };
  });
  let isFilled = false;
  const select = () => {
    const { viewer } = bench;
    if (!viewer.cloud) return;
    const { positions, cloud } = viewer.scene;
    // A number in a field is rounded to the file's digits, and the point that it was taken from is inside.
    const slack = cloud.facts.decimals?.map((digits) => 0.5 * 10 ** -digits) ?? [0, 0, 0];
    const stored = (value: number) => (positions instanceof Float32Array ? Math.fround(value) : value);
    const ends = rows.map(
      ({ low, high }, k) =>
        [stored(endOf(low, -Infinity)) - slack[k]!, stored(endOf(high, Infinity)) + slack[k]!] as const,
    );
    const isInside = (i: number) =>
      ends.every(([low, high], k) => positions[3 * i + k]! >= low && positions[3 * i + k]! <= high);
    choose(indicesWhere(cloud.count, isInside));
  };
  const element = make(
    "div",
    { class: "range", hidden: true },
    ...rows.flatMap(({ axis, low, high }) => [make("span", {}, axis), low, make("span", {}, "to"), high]),
    button("Select the points in the box", select),
  );
  return {
    element,
    /** Fills in the bounds of the cloud. Numbers that are there already stay. */
    fill: () => {
      if (isFilled || !bench.viewer.cloud) return;
      isFilled = true;
      const { scene } = bench.viewer;
      for (const [k, { low, high }] of rows.entries()) {
        const [least, greatest] = endsOf(scene.positions, k);
        low.value = coordinatesAt(scene, least)[k]!;
        high.value = coordinatesAt(scene, greatest)[k]!;
      }
    },
    forget: () => {
      isFilled = false;
    },
  };
}

function endOf({ valueAsNumber }: HTMLInputElement, otherwise: number): number {
  return Number.isNaN(valueAsNumber) ? otherwise : valueAsNumber;
}

/** The indices of the points with the least and with the greatest coordinate. */
function endsOf(positions: ArrayLike<number>, axis: number): [number, number] {
  let [least, greatest] = [0, 0];
  for (let i = 1; i < positions.length / 3; i++) {
    if (positions[3 * i + axis]! < positions[3 * least + axis]!) least = i;
    if (positions[3 * i + axis]! > positions[3 * greatest + axis]!) greatest = i;
  }
  return [least, greatest];
}
