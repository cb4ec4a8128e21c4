// The time of a query, also compared with the hulls of other libraries.
import { PointCloud } from "hidden-point-removal";

import { WrongAnswer } from "./check.js";
import type { Cloud } from "./clouds.js";
import { ENGINES } from "./engines.js";
import { digestOf, type Outcome, type Task } from "./measure.js";
import { compareWithPeer, PEER_LIMIT_MS, type Peer, type PeerResult, type View } from "./peers.js";
import { median, type Row, type Table } from "./report.js";
import { tasksFor } from "./views.js";

/** Makes two tables of all clouds. Throws at the first wrong answer. */
export function timeQueries(clouds: Iterable<Cloud>, peers: Peer[]): Table[] {
  const [cold, others]: Row[][] = [[], []];
  for (const cloud of clouds) {
    const tasks = tasksFor(cloud);
    const measured = measureAll(cloud, tasks);
    tasks.forEach((task, t) => {
      const outcomes = [...measured].map(([engine, all]) => [engine, all[t]!] as const);
      cold!.push(coldRow(cloud, task, outcomes));
      const taking = peers.filter((peer) => peer.takes(cloud));
      if (taking.length === 0) return;
      const view = viewOf(cloud, task, outcomes[0]![1]);
      for (const peer of taking) {
        console.error(`${cloud.name}, exponent ${task.exponent}: ${peer.name}…`);
        others!.push(peerRow(view, compareWithPeer(peer, view), outcomes));
      }
    });
  }
  return [
    { title: "Cold queries", note: COLD, rows: cold! },
    { title: "Other hulls on the same flipped points", note: PEERS, rows: others! },
  ];
}

const COLD =
  "Median milliseconds of one query on one core, after a view from the other side, so that nothing of " +
  "the last view helps. Building (in Node) is not counted. The viewpoint is 2.5 bounding radii away; for the room it is inside. All engines gave the same visible set and radius, " +
  "to the bit.";
const PEERS =
  "Milliseconds of the hull alone, and how many times longer that takes than the whole cold query, flip included. " +
  "The last column counts labels that differ; where an exact program judged such labels, Qhull was wrong. " +
  `A peer is stopped after ${PEER_LIMIT_MS / 1000} s.`;

/** The outcomes of all engines. They must give the same visible set and radius, to the bit. */
function measureAll(cloud: Cloud, tasks: Task[]): Map<string, Outcome[]> {
  const measured = new Map<string, Outcome[]>();
  const answers = (outcomes: Outcome[]) => outcomes.map(({ radius, digest }) => `${digest} with R = ${radius}`).join();
  for (const [engine, measure] of Object.entries(ENGINES)) {
    console.error(`${cloud.name}: ${engine}…`);
    measured.set(engine, measure(cloud, tasks));
  }
  const different = new Set([...measured.values()].map(answers));
  if (different.size > 1) throw new WrongAnswer(`${cloud.name}: ${[...different].join(" and ")}`);
  return measured;
}

type Outcomes = (readonly [engine: string, outcome: Outcome])[];

function coldRow(cloud: Cloud, { exponent }: Task, outcomes: Outcomes): Row {
  const points = cloud.positions.length / 3;
  const { visible } = outcomes[0]![1];
  const build = outcomes.find(([engine]) => engine === "wasm")![1].build;
  return {
    cloud: cloud.name,
    source: cloud.source,
    points,
    exponent,
    visible,
    "share %": (visible / points) * 100,
    "build ms": median(build),
    ...Object.fromEntries(outcomes.map(([engine, { cold }]) => [`${engine} ms`, median(cold)])),
  };
}

/** Asks a timed question again for its whole answer. It must be equal to the timed answer. */
function viewOf(cloud: Cloud, { exponent, viewpoint }: Task, timed: Outcome): View {
  const points = new PointCloud(cloud.positions);
  const { indices, radius } = points.visibleFrom(viewpoint, { exponent });
  points.dispose();
  if (digestOf(indices) !== timed.digest) throw new WrongAnswer(`${cloud.name}: the same question got another answer`);
  return { cloud, exponent, viewpoint, radius, indices };
}

function peerRow({ cloud, exponent }: View, { peer, milliseconds, differing }: PeerResult, outcomes: Outcomes): Row {
  const row: Row = { cloud: cloud.name, points: cloud.positions.length / 3, exponent, peer };
  const stopped = milliseconds === undefined;
  const time = stopped ? PEER_LIMIT_MS : median(milliseconds);
  const shown = (value: number): string | number => (stopped ? `> ${Math.round(value)}` : value);
  row["peer ms"] = shown(time);
  for (const [engine, { cold }] of outcomes) row[`÷ ${engine}`] = shown(time / median(cold));
  row["other labels"] = stopped ? "" : differing;
  return row;
}
