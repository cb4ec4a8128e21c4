// The component for React in a canvas that draws on demand. adapters.test.ts has what all adapters share.
import { type UseHiddenPointFilterOptions, VisiblePoints } from "hidden-point-removal/react-three-fiber";
import { Component, createElement, type ReactNode, StrictMode } from "react";
import type { BufferGeometry, Points } from "three";
import { afterEach, beforeEach, expect, it, vi } from "vitest";

import { pointsOf, rootOf } from "./adapters";

/** Two layers of points, the second behind the first. */
const layers = Array.from({ length: 500 }, (_, i) => {
  const [r, turn] = [Math.sqrt((i + 0.5) / 500), 2.399963 * i];
  return [r * Math.cos(turn), r * Math.sin(turn), 0, r * Math.cos(turn), r * Math.sin(turn), -1];
}).flat();

/** Shows nothing after an error. */
class Boundary extends Component<{ children: ReactNode; caught: (error: Error) => void }, { failed: boolean }> {
  override state = { failed: false };
  static getDerivedStateFromError() {
    return { failed: true };
  }
  override componentDidCatch(error: Error) {
    this.props.caught(error);
  }
  override render() {
    return this.state.failed ? null : this.props.children;
  }
}

vi.stubGlobal("requestAnimationFrame", (frame: (time: number) => void) => setTimeout(frame, 1, performance.now()));
vi.stubGlobal("cancelAnimationFrame", clearTimeout);

/** What is told of one canvas. The one before may still tell of its end. */
const fresh = () => ({ frames: 0, changes: [] as number[], errors: [] as string[], points: null as Points | null });
let app: ReturnType<typeof fresh>;
let root: Awaited<ReturnType<typeof rootOf>>;
let own: { filter: UseHiddenPointFilterOptions; geometry: BufferGeometry | null };

beforeEach(async () => {
  const told = (app = fresh());
  root = await rootOf("demand", () => told.frames++);
  own = { filter: { exponent: 3 }, geometry: pointsOf(Float32Array.from(layers)).geometry };
  render();
  await reached(() => told.changes.length > 0 && told.points !== null);
});

afterEach(() => {
  root.unmount();
});

const reached = (test: () => boolean) => expect.poll(test, { interval: 2 }).toBe(true);

function render(change: Partial<typeof own> = {}) {
  Object.assign(own, change);
  const told = app;
  const filter: UseHiddenPointFilterOptions = {
    ...own.filter,
    onChange: ({ count }) => told.changes.push(count),
    onError: (error) => told.errors.push((error as { code?: string }).code ?? error.message),
  };
  const ref = (points: Points | null) => void (told.points = points);
  const { geometry } = own;
  const scan = geometry && createElement(VisiblePoints, { geometry, filter, ref } as never);
  const caught = (error: Error) => told.errors.push(`caught: ${error.message}`);
  return root.render(createElement(StrictMode, null, createElement(Boundary, { caught, children: scan }))).getState();
}

const shown = () => app.points!.geometry.drawRange.count;

it("draws the visible points in a frame that it asked for, and no more frames", async () => {
  expect(shown()).toBe(app.changes.at(-1));
  expect(shown()).toBeGreaterThanOrEqual(500);
  expect(shown()).toBeLessThan(600);
  const before = app.changes.length;
  let frames = -1;
  while (frames !== app.frames) {
    frames = app.frames;
    await new Promise((next) => setTimeout(next, 300));
  }
  const { camera, invalidate } = render();
  camera.position.set(0, 0, -6);
  camera.lookAt(0, 0, 0);
  invalidate();
  // One frame to ask, another to draw the answer.
  await reached(() => app.frames >= frames + 2 && app.changes.length === before + 1);
  const { array } = app.points!.geometry.index!;
  expect([...array.slice(0, 250)].filter((i) => i % 2 === 0).length).toBeLessThan(50);
});

it("goes on with other options and geometries, and leaves with its points", async () => {
  const first = app.points!.geometry;
  const before = app.changes.length;
  // A new object with the same values asks nothing.
  render({ filter: { exponent: 3, frozen: true } });
  render({ filter: { exponent: 3, frozen: true, enabled: false } });
  await reached(() => first.index === null);
  expect(app.changes.length).toBe(before);
  render({ filter: { exponent: 6, mode: "dim" } });
  await reached(() => app.points!.children.length === 1 && app.changes.at(-1)! > 750);
  render({ filter: { exponent: 3 }, geometry: pointsOf(Float32Array.of(0, 0, 1, 0, 0, 0.5, 1, 0, 0)).geometry });
  await reached(() => app.changes.at(-1) === 2);
  expect([shown(), first.index]).toEqual([2, null]);
  render({ geometry: null });
  await reached(() => app.points === null);
  render({ geometry: pointsOf(Float32Array.of(0, 0, 1, 0, 0, 0.5)).geometry });
  await reached(() => app.changes.at(-1) === 1);
  expect(app.errors).toEqual([]);
});

it("reports refusals of answers to onError, and other refusals to the error boundary", async () => {
  for (const name of ["error", "warn"] as const) vi.spyOn(console, name).mockReturnValue();
  render({ filter: { radius: 0.1 } });
  await reached(() => app.errors.includes("radius"));
  render({ filter: { mode: "fade" as never } });
  await reached(() => app.errors.some((error) => error.startsWith("caught: mode")));
  vi.restoreAllMocks();
});
