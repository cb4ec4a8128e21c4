// A cloud split into nodes, compared with the same cloud in one piece: equal answers, and their times.
import { PointCloud } from "hidden-point-removal";
import { HiddenPointNodesFilter, type HiddenPointNodesFilterEvents } from "hidden-point-removal/nodes";
import { BufferAttribute, BufferGeometry, Group, PerspectiveCamera, Points } from "three";

import { garbageOf, meanMicroseconds } from "./adapter.js";
import { WrongAnswer } from "./check.js";
import { type Cloud, dragon } from "./clouds.js";
import { digestOf } from "./measure.js";
import { median, type Row, type Table } from "./report.js";
import { orbit } from "./views.js";

const VIEWS = 12;
/** Cells along the longest side of the box. */
const GRIDS = [8, 16];

export async function timeNodes(): Promise<Table> {
  const cloud = dragon("dragon");
  const rows: Row[] = [];
  for (const along of GRIDS) {
    console.error(`${cloud.name}: nodes…`);
    rows.push(await row(cloud, along));
  }
  const note =
    "The answer of all nodes, compared with that of the cloud in one piece. Milliseconds from asking to the answer, in Node, " +
    "on one worker: for a view 30° further, and for the same view after a node has gone or come back. Microseconds and bytes of " +
    "garbage of an update() in which nothing changes.";
  return { title: "Nodes of one cloud", note, rows };
}

async function row(cloud: Cloud, along: number): Promise<Row> {
  const { nodes, whole } = split(cloud.positions, along);
  const root = new Group().add(...nodes);
  const camera = new PerspectiveCamera();
  const filter = new HiddenPointNodesFilter(root);
  const changes: HiddenPointNodesFilterEvents["change"][] = [];
  filter.addEventListener("change", (change) => changes.push(change));
  const unsplit = new PointCloud(whole);
  const at = orbit(cloud);
  const [split_, together, changed]: number[][] = [[], [], []];
  let visible = 0;
  for (let i = 0; i < VIEWS; i++) {
    camera.position.fromArray(at(30 * i));
    filter.update(camera);
    await settled(filter);
    const { viewpoint, milliseconds } = changes.at(-1)!;
    const start = performance.now();
    const { indices } = unsplit.visibleFrom(viewpoint!);
    together!.push(performance.now() - start);
    if (digestOf(indices) !== digestOf(drawnOf(nodes))) {
      throw new WrongAnswer(`${nodes.length} nodes have another answer than the cloud in one piece`);
    }
    split_!.push(milliseconds);
    visible = indices.length;
  }
  for (let i = 0; i < VIEWS; i++) {
    const [node] = nodes;
    if (i % 2 === 0) root.remove(node!);
    else root.add(node!);
    filter.update(camera);
    await settled(filter);
    changed!.push(changes.at(-1)!.milliseconds);
  }
  const still = () => {
    filter.update(camera);
  };
  const result = {
    cloud: cloud.name,
    points: whole.length / 3,
    nodes: nodes.length,
    views: VIEWS,
    visible,
    "nodes, ms": median(split_!),
    "in one piece, ms": median(together!),
    "a node gone or back, ms": median(changed!),
    "still, µs": meanMicroseconds(still),
    "still, bytes": garbageOf(still),
  };
  filter.dispose();
  unsplit.dispose();
  return result;
}

function split(positions: Cloud["positions"], along: number): { nodes: Points[]; whole: Float64Array } {
  const bounds = [0, 1, 2].map((axis) => {
    let [low, high] = [Infinity, -Infinity];
    for (let i = axis; i < positions.length; i += 3) {
      [low, high] = [Math.min(low, positions[i]!), Math.max(high, positions[i]!)];
    }
    return { low, side: high - low };
  });
  const side = (Math.max(...bounds.map((bound) => bound.side)) / along) * 1.0001;
  const cells = new Map<string, { corner: number[]; local: number[] }>();
  for (let i = 0; i < positions.length; i += 3) {
    const place = bounds.map(({ low }, axis) => Math.floor((positions[i + axis]! - low) / side));
    const corner = bounds.map(({ low }, axis) => low + place[axis]! * side);
    const name = place.join();
    const cell = cells.get(name) ?? { corner, local: [] };
    cells.set(name, cell);
    corner.forEach((x, axis) => cell.local.push(positions[i + axis]! - x));
  }
  const numbers: number[] = [];
  const nodes = [...cells.values()].map(({ corner, local }) => {
    const single = Float32Array.from(local);
    const node = new Points(new BufferGeometry().setAttribute("position", new BufferAttribute(single, 3)));
    node.position.fromArray(corner);
    single.forEach((x, i) => numbers.push(x + corner[i % 3]!));
    return node;
  });
  return { nodes, whole: Float64Array.from(numbers) };
}

/** The points that the nodes draw, as indices of the whole cloud. */
function drawnOf(nodes: Points[]): Uint32Array {
  let first = 0;
  const ids = nodes.flatMap(({ geometry }) => {
    const shown = Array.from(
      (geometry.index!.array as Uint32Array).subarray(0, geometry.drawRange.count),
      (id) => first + id,
    );
    first += geometry.attributes["position"]!.count;
    return shown;
  });
  return Uint32Array.from(ids);
}

async function settled(filter: HiddenPointNodesFilter): Promise<void> {
  while (!filter.settled) await new Promise((resolve) => setTimeout(resolve, 1));
}
