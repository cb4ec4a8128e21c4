// Every adapter in one form: some clouds on a page, each drawn by an adapter of its own, and all in the same worker. Here
// they run without a graphics card. tests/browser draws with one.
import { advance, createRoot, extend } from "@react-three/fiber";
import { HiddenPointNodesFilter } from "hidden-point-removal/nodes";
import { PotreeFilter } from "hidden-point-removal/potree";
import { useHiddenPointFilter, type UseHiddenPointFilterOptions } from "hidden-point-removal/react-three-fiber";
import { HiddenPointFilter } from "hidden-point-removal/three";
import * as webgpu from "hidden-point-removal/three/webgpu";
import { WorkerPointCloud } from "hidden-point-removal/worker";
import { createElement, useRef } from "react";
import * as THREE from "three";
import { afterEach } from "vitest";

import { LayerCloud } from "../../src/ts/deck/layer-cloud.js";
import { followSettings } from "../../src/ts/follow/options.js";
import { viewerOf } from "./potree-viewer";
import { drawn } from "./three-support";

type Filter = HiddenPointFilter | HiddenPointNodesFilter | PotreeFilter;
type Change = { answer: string; count: number };
export type Place = readonly [number, number, number];

/** What one adapter has drawn of one cloud. */
export interface Drawn {
  /** A frame with a camera at this place, in the space of the cloud. */
  look(place: Place): void;
  /** A frame with an orthographic camera that looks along this direction. */
  lookAlong?(direction: Place): void;
  /** The points in the picture, ascending. */
  drawn(): number[];
  /** Whether no answer is on its way or due. */
  readonly settled: boolean;
  /** What is drawn. */
  readonly answer: string | null;
  /** The kinds and the counts of all answers so far. */
  readonly changes: Change[];
  readonly errors: Error[];
  set?(flags: { frozen?: boolean; enabled?: boolean }): unknown;
  readonly filter?: Filter;
  /** Whether the user's own objects are as they were before the adapter came. */
  isAsBefore?(): boolean;
  dispose(): unknown;
}

export interface Adapter {
  name: string;
  /** How many clouds are on the page. Adapters that differ in their drawing alone are tried with one. */
  clouds: readonly number[];
  /** What the form below lacks here: a filter, options that are refused by the call itself. */
  lacks?: readonly ("filter" | "refusal" | "flags" | "direction" | "recovery")[];
  make(positions: Float32Array, options: object): Promise<Drawn> | Drawn;
}

const open: Drawn[] = [];

afterEach(async () => {
  for (const one of open.splice(0)) await one.dispose();
});

/** So many clouds on a page. The adapters are disposed of after the test. */
export async function pageWith(adapter: Adapter, clouds: readonly Float32Array[], options: object): Promise<Drawn[]> {
  const page: Drawn[] = [];
  for (const positions of clouds) {
    const one = await adapter.make(positions, options);
    page.push(one);
    open.push(one);
  }
  return page;
}

export function cameraAt(x: number, y: number, z: number): THREE.PerspectiveCamera {
  const camera = new THREE.PerspectiveCamera();
  camera.position.set(x, y, z);
  return camera;
}

/** A cloud in a group of a scene, and a camera. */
export function pointsOf(positions: Float32Array) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
  const points = new THREE.Points(geometry, new THREE.PointsMaterial());
  const group = new THREE.Group().add(points);
  const camera = cameraAt(0, 0, 5);
  new THREE.Scene().add(group, camera);
  return { geometry, points, group, camera };
}

/** What an adapter has told. */
function listening(filter: Filter) {
  const told = { changes: [] as Change[], errors: [] as Error[] };
  filter.addEventListener("change", (change: Change) => told.changes.push(change));
  filter.addEventListener("error", ({ error }: { error: Error }) => told.errors.push(error));
  return told;
}

/** What adapters change of points, as text. */
function stateOf(parts: THREE.Points[]): string {
  const states = parts.map(({ geometry: { index, drawRange }, children, layers, material }) => {
    const range = [drawRange.start, String(drawRange.count)];
    return [index === null, range, children.length, layers.mask, Object.keys(material)];
  });
  return JSON.stringify(states);
}

/** A filter that is updated with cameras. */
function byCamera(filter: Filter, rest: Pick<Drawn, "drawn" | "isAsBefore">): Drawn {
  const perspective = cameraAt(0, 0, 5);
  const orthographic = new THREE.OrthographicCamera();
  return {
    ...listening(filter),
    ...rest,
    filter,
    look: (place) => {
      perspective.position.set(...place);
      filter.update(perspective);
    },
    lookAlong: (direction) => {
      orthographic.lookAt(...direction);
      filter.update(orthographic);
    },
    get settled() {
      return filter.settled;
    },
    get answer() {
      return filter.answer;
    },
    set: (flags) => Object.assign(filter, flags),
    dispose: () => filter.dispose(),
  };
}

function ofPoints(Filter: typeof HiddenPointFilter): Adapter["make"] {
  return (positions, options) => {
    const { points, geometry } = pointsOf(positions);
    const before = stateOf([points]);
    const isAsBefore = () => stateOf([points]) === before;
    return byCamera(new Filter(points, options), { drawn: () => drawn(geometry), isAsBefore });
  };
}

/** The cloud in this number of nodes. */
function ofNodes(Filter: typeof HiddenPointNodesFilter, count: number): Adapter["make"] {
  return (positions, options) => {
    const group = new THREE.Group();
    const size = Math.ceil(positions.length / 3 / count);
    const parts = Array.from({ length: count }, (_, k) => {
      const { points } = pointsOf(positions.slice(3 * size * k, 3 * size * (k + 1)));
      group.add(points);
      return points;
    });
    const ofAll = () => parts.flatMap(({ geometry }, k) => drawn(geometry).map((i) => size * k + i));
    const before = stateOf(parts);
    return byCamera(new Filter(group, options), { drawn: ofAll, isAsBefore: () => stateOf(parts) === before });
  };
}

/** A canvas of React's, which does not draw. `render` is called instead. */
export async function rootOf(frameloop: "never" | "demand", render: () => void) {
  extend(THREE as never);
  const nothing = () => undefined;
  const canvas = { style: {}, addEventListener: nothing, removeEventListener: nothing };
  const methods = { render, setPixelRatio: nothing, setSize: nothing, getPixelRatio: () => 1 };
  const gl = { ...methods, domElement: canvas, shadowMap: {}, xr: canvas };
  const root = createRoot(canvas as never);
  await root.configure({ gl: () => gl, frameloop, size: { width: 9, height: 9, top: 0, left: 0 } });
  return root;
}

/** A `<points>` with the hook. */
const ofReact: Adapter["make"] = async (positions, options) => {
  const { geometry } = pointsOf(positions);
  const root = await rootOf("never", () => undefined);
  const told = { changes: [] as Change[], errors: [] as Error[] };
  const made = { filter: null as HiddenPointFilter | null };
  let own: UseHiddenPointFilterOptions = {
    ...options,
    onChange: (change) => told.changes.push(change),
    onError: (error) => told.errors.push(error),
  };
  const Scan = (props: { own: UseHiddenPointFilterOptions }) => {
    const points = useRef<THREE.Points>(null);
    made.filter = useHiddenPointFilter(points, props.own);
    return createElement("points", { ref: points, geometry });
  };
  const render = () => root.render(createElement(Scan, { own })).getState();
  const { camera } = render();
  let time = 0;
  while (made.filter === null) {
    await new Promise((next) => setTimeout(next, 1));
    advance(++time);
  }
  return {
    ...told,
    get filter() {
      return made.filter!;
    },
    look: (place) => {
      camera.position.set(...place);
      advance(++time);
    },
    drawn: () => drawn(geometry),
    get settled() {
      return made.filter?.settled ?? true;
    },
    get answer() {
      return made.filter?.answer ?? null;
    },
    set: async (flags) => {
      own = { ...own, ...flags };
      render();
      const isSet = () => Object.entries(flags).every(([name, value]) => Reflect.get(made.filter!, name) === value);
      while (!isSet()) await new Promise((next) => setTimeout(next, 1));
    },
    isAsBefore: () => geometry.index === null && geometry.drawRange.count === Infinity,
    dispose: async () => {
      root.unmount();
      while (geometry.index !== null) await new Promise((next) => setTimeout(next, 1));
    },
  };
};

/** The cloud of a layer of deck.gl. The layer itself needs a graphics card. */
const ofDeck: Adapter["make"] = (positions, options) => {
  const told = { changes: [] as Change[], errors: [] as Error[] };
  const all = Array.from({ length: positions.length / 3 }, (_, i) => i);
  let shown = all;
  const cloud = new LayerCloud({
    answer: ({ indices }, answer) => {
      shown = [...indices];
      told.changes.push({ answer, count: indices.length });
    },
    map: () => undefined,
    error: (error) => told.errors.push(error),
  });
  const settings = followSettings({ ...options }, { hasShaders: true });
  cloud.setPositions(() => positions);
  const want = (from: Place, isDirection: boolean) => {
    if (cloud.want({ from, isDirection }, settings, false)) shown = all;
  };
  return {
    ...told,
    look: (place) => want(place, false),
    lookAlong: (direction) => want(direction, true),
    drawn: () => shown,
    get settled() {
      return cloud.settled;
    },
    get answer() {
      return told.changes.at(-1)?.answer ?? null;
    },
    dispose: () => cloud.dispose(),
  };
};

/** A stream of answers, of which this draws the points. */
const ofStream: Adapter["make"] = async (positions, options) => {
  const told = { changes: [] as Change[], errors: [] as Error[] };
  const cloud = await WorkerPointCloud.create(positions, { shared: true });
  const stream = cloud.follow({
    ...options,
    onAnswer: ({ answer, visibility: { count } }) => told.changes.push({ answer, count }),
    onError: (error) => told.errors.push(error),
  });
  return {
    ...told,
    look: (place) => {
      stream.look(place);
    },
    lookAlong: (direction) => {
      stream.lookAlong(direction);
    },
    drawn: () => Array.from(stream.visible ?? Array.from({ length: cloud.length }, (_, i) => i)),
    get settled() {
      return stream.settled;
    },
    get answer() {
      return stream.last?.answer ?? null;
    },
    dispose: async () => {
      stream.dispose();
      await cloud.dispose();
    },
  };
};

/** The cloud in three nodes of an octree of Potree's, one of them far from the origin. */
const ofPotree: Adapter["make"] = (positions, options) => {
  const viewer = viewerOf(positions, 3);
  const before = viewer.own();
  const filter = new PotreeFilter(viewer, options);
  const one = byCamera(filter, { drawn: () => viewer.drawn(), isAsBefore: () => viewer.own() === before });
  const lookBy = (camera: THREE.Camera) => {
    viewer.camera = camera;
    viewer.frame();
  };
  const camera = cameraAt(0, 0, 5);
  return Object.defineProperties(one, {
    look: {
      value: (place: Place) => {
        camera.position.set(...place);
        lookBy(camera);
      },
    },
    lookAlong: {
      value: (direction: Place) => {
        const along = new THREE.OrthographicCamera();
        along.lookAt(...direction);
        lookBy(along);
      },
    },
  });
};

export const ADAPTERS: Adapter[] = [
  { name: "HiddenPointFilter", clouds: [1, 3], make: ofPoints(HiddenPointFilter) },
  { name: "HiddenPointFilter for WebGPU", clouds: [1], make: ofPoints(webgpu.HiddenPointFilter) },
  { name: "HiddenPointNodesFilter of one node", clouds: [1], make: ofNodes(HiddenPointNodesFilter, 1) },
  { name: "HiddenPointNodesFilter for WebGPU", clouds: [3], make: ofNodes(webgpu.HiddenPointNodesFilter, 3) },
  { name: "useHiddenPointFilter", clouds: [3], make: ofReact, lacks: ["direction", "refusal"] },
  { name: "VisiblePointCloudLayer", clouds: [1, 3], make: ofDeck, lacks: ["filter", "flags", "refusal"] },
  { name: "PotreeFilter", clouds: [3], make: ofPotree },
  { name: "ViewStream", clouds: [1, 3], make: ofStream, lacks: ["filter", "flags", "refusal", "recovery"] },
];
