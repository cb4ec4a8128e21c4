// types.test.ts compiles this file like a project that uses the adapters.
import { Deck } from "@deck.gl/core";
import { VisiblePointCloudLayer } from "hidden-point-removal/deck";
import { HiddenPointNodesFilter } from "hidden-point-removal/nodes";
import { useHiddenPointFilter, VisiblePoints } from "hidden-point-removal/react-three-fiber";
import { HiddenPointFilter, type HiddenPointFilterOptions, HprError } from "hidden-point-removal/three";
import { createElement, useRef } from "react";
import { BufferGeometry, PerspectiveCamera, Points, PointsMaterial } from "three";

const options: HiddenPointFilterOptions = {
  exponent: 3,
  mode: "dim",
  worker: false,
  dimMaterial: new PointsMaterial(),
};
const points = new Points(new BufferGeometry(), new PointsMaterial());
const filter = new HiddenPointFilter(points, options);
filter.addEventListener("change", ({ count, milliseconds, target }) => {
  console.log(count + milliseconds, target === filter);
});
filter.addEventListener("error", ({ error }) => {
  console.log(error instanceof HprError && error.code);
});
filter.frozen = filter.enabled;
filter.update(new PerspectiveCamera());
void filter.ready.then(() => filter.visibleCount);
// @ts-expect-error It is counted, not set.
filter.visibleCount = 3;
// @ts-expect-error There is no such event.
filter.addEventListener("changed", () => undefined);

const nodes = new HiddenPointNodesFilter(points, { radius: "auto", nodes: () => [points] });
nodes.addEventListener("change", ({ viewpoint, radius }) => {
  console.log(viewpoint?.length, radius);
});
// @ts-expect-error There is no such mode.
new HiddenPointNodesFilter(points, { mode: "fade" });

export function Scan() {
  const ref = useRef<Points>(null);
  const own = useHiddenPointFilter(ref, {
    exponent: 3,
    frozen: true,
    onChange: ({ count }) => {
      console.log(count);
    },
  });
  console.log(own?.visibleCount);
  return createElement(VisiblePoints, { geometry: points.geometry, filter: { mode: "hide" }, ref });
}

export const layer = new VisiblePointCloudLayer({
  id: "scan",
  data: [[0, 0, 1]],
  getPosition: (point) => point as [number, number, number],
  viewpoint: [0, 0, 5],
  visibility: { radius: "auto" },
  onVisible: ({ count }) => {
    console.log(count);
  },
});
new Deck({ layers: [layer] });
