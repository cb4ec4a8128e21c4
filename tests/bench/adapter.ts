// The time of the adapter for three.js on the page's own thread: in a frame in which nothing
// changes, in a frame that asks the worker, and when an answer is drawn.
import { setFlagsFromString } from "node:v8";
import { runInNewContext } from "node:vm";

import { HiddenPointFilter } from "hidden-point-removal/three";
import { BufferAttribute, BufferGeometry, Group, PerspectiveCamera, Points } from "three";

import { withHidden } from "../../src/ts/cloud/hidden.js";
import { DrawnPoints } from "../../src/ts/three/drawn-points.js";
import { bumpy, type Cloud, dragon } from "./clouds.js";
import { median, type Row, type Table } from "./report.js";
import { orbit } from "./views.js";

const FRAMES = 10_000;
/** This number is small, so that no collection of the young generation comes between these frames. */
const FRAMES_BETWEEN = 500;
const ANSWERS = 21;

export async function timeAdapter(): Promise<Table> {
  const rows: Row[] = [];
  for (const cloud of [dragon("dragon_res3"), dragon("dragon"), bumpy("bumpy-1m")]) {
    console.error(`${cloud.name}: three.js adapter…`);
    for (const mode of ["hide", "dim"] as const) rows.push(await row(cloud, mode));
  }
  const note =
    `The time of the page's own thread, in Node. Microseconds and bytes of garbage of an update() in which nothing changes (means of ${FRAMES}, ` +
    "points and camera in groups of their own). Microseconds of an update() that asks the worker. Milliseconds from an answer's " +
    "arrival until index and draw range are set, without the upload to the graphics card.";
  return { title: "three.js adapter", note, rows };
}

async function row({ name, positions, ...cloud }: Cloud, mode: "hide" | "dim"): Promise<Row> {
  const at = orbit({ name, positions, ...cloud });
  const { points, camera } = scene(positions);
  const filter = new HiddenPointFilter(points, { exponent: 3, mode });
  camera.position.fromArray(at(0));
  filter.update(camera);
  await filter.ready;
  const visible = filter.visibleCount;
  const still = () => {
    filter.update(camera);
  };
  const microseconds = meanMicroseconds(still);
  const bytes = garbageOf(still);
  const asking: number[] = [];
  for (let i = 1; i <= ANSWERS; i++) {
    camera.position.fromArray(at(i));
    const answered = new Promise((resolve) => {
      filter.addEventListener("change", resolve);
    });
    const start = performance.now();
    filter.update(camera);
    asking.push(1000 * (performance.now() - start));
    await answered;
  }
  const indices = (points.geometry.index!.array as Uint32Array<ArrayBuffer>).slice(0, visible);
  filter.dispose();
  const apply = applyingMs(points, indices, mode === "dim");
  return {
    cloud: name,
    points: positions.length / 3,
    mode,
    visible,
    "still, µs": microseconds,
    "still, bytes": bytes,
    "asking, µs": median(asking),
    "applying, ms": apply,
    "applying, ms for 100,000 visible": (apply / visible) * 1e5,
  };
}

function scene(positions: Cloud["positions"]) {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(positions, 3));
  const points = new Points(geometry);
  const camera = new PerspectiveCamera();
  new Group().add(new Group().add(points), new Group().add(camera));
  return { points, camera };
}

export function meanMicroseconds(work: () => void): number {
  for (let i = 0; i < FRAMES; i++) work();
  const start = performance.now();
  for (let i = 0; i < FRAMES; i++) work();
  return (1000 * (performance.now() - start)) / FRAMES;
}

export function garbageOf(work: () => void): number {
  setFlagsFromString("--expose-gc");
  const collect = runInNewContext("gc") as () => void;
  let bytes = 0;
  for (let frame = 0; frame < FRAMES; frame += FRAMES_BETWEEN) {
    collect();
    const before = process.memoryUsage().heapUsed;
    for (let i = 0; i < FRAMES_BETWEEN; i++) work();
    bytes += process.memoryUsage().heapUsed - before;
  }
  return Math.round(bytes / FRAMES);
}

/** The worker lists the dimmed points in the answer's own memory. */
function applyingMs(points: Points, visible: Uint32Array<ArrayBuffer>, dim: boolean): number {
  const drawn = new DrawnPoints(points, { dim, dimsByScore: false, threshold: undefined });
  drawn.take();
  const indices = dim ? withHidden(visible, drawn.total) : visible;
  const times: number[] = [];
  for (let i = 0; i < ANSWERS; i++) {
    const start = performance.now();
    drawn.setVisible(undefined, indices, dim);
    drawn.show();
    times.push(performance.now() - start);
  }
  drawn.release();
  return median(times);
}
