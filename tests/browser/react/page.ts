// A page with one canvas whose frames are drawn on demand. `app` lets the test change it.
import { Canvas, type RootState } from "@react-three/fiber";
import {
  type UseHiddenPointFilterOptions,
  VisiblePoints,
  type VisiblePointsProps,
} from "hidden-point-removal/react-three-fiber";
import { Component, createElement, type ReactNode, StrictMode, useEffect, useState } from "react";
import { createRoot } from "react-dom/client";
import { BufferAttribute, BufferGeometry, type Points, PointsMaterial } from "three";

type Filter = UseHiddenPointFilterOptions;

export interface App {
  state: RootState;
  points: Points | null;
  /** The numbers of drawn frames, and of reported answers and refusals. */
  frames: number;
  changes: number[];
  errors: string[];
  set: (filter: Filter) => void;
  setCloud: (positions: number[] | null) => void;
}

const app = { points: null, frames: 0, changes: [], errors: [] } as unknown as App;
(globalThis as unknown as { app: App }).app = app;

/** Two layers of points, the second behind the first. */
function layers(): number[] {
  return Array.from({ length: 2000 }, (_, i) => {
    const [r, turn] = [Math.sqrt((i + 0.5) / 2000), 2.399963 * i];
    return [r * Math.cos(turn), r * Math.sin(turn), 0, r * Math.cos(turn), r * Math.sin(turn), -1];
  }).flat();
}

function geometryOf(positions: number[]): BufferGeometry {
  return new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array(positions), 3));
}

/** Shows nothing after an error. */
class Boundary extends Component<{ children: ReactNode }, { failed: boolean }> {
  override state = { failed: false };
  static getDerivedStateFromError() {
    return { failed: true };
  }
  override componentDidCatch(error: Error) {
    app.errors.push(`caught: ${error.message}`);
  }
  override render() {
    return this.state.failed ? null : this.props.children;
  }
}

function Page() {
  const [filter, setFilter] = useState<Filter>({ exponent: 3 });
  const [geometry, setGeometry] = useState<BufferGeometry | null>(() => geometryOf(layers()));
  const [material] = useState(() => new PointsMaterial({ size: 0.01 }));
  useEffect(() => {
    app.set = setFilter;
    app.setCloud = (positions) => {
      setGeometry(positions && geometryOf(positions));
    };
  }, []);
  const told: Filter = {
    onChange: ({ count }) => app.changes.push(count),
    onError: (error) => app.errors.push((error as { code?: string }).code ?? error.message),
  };
  const ref = (points: Points | null) => {
    app.points = points;
  };
  const props = { geometry, material, filter: { ...told, ...filter }, ref } as VisiblePointsProps;
  const onCreated = (state: RootState) => {
    app.state = state;
    state.scene.onBeforeRender = () => app.frames++;
  };
  return createElement(
    Boundary,
    null,
    createElement(
      Canvas,
      { frameloop: "demand", camera: { position: [0, 0, 5] }, onCreated } as Parameters<typeof Canvas>[0],
      geometry && createElement(VisiblePoints, props),
    ),
  );
}

createRoot(document.getElementById("root")!).render(createElement(StrictMode, null, createElement(Page)));
