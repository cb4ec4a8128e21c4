// The memory of the wasm: its peak, its growth over many viewpoints, and at ten million points.
import { WrongAnswer } from "./check.js";
import { type Cloud, dragon, huge } from "./clouds.js";
import type { MemoryUse, MemoryWork } from "./memory-engine.js";
import type { Point } from "./measure.js";
import { ask, program, writeCloud } from "./paths.js";
import type { Row, Table } from "./report.js";
import { EXPONENTS, orbit } from "./views.js";

const MB = 1e6;
/** Small steps and leaps in turn: after a leap, the results kept from the last view are of no use. */
const VIEWS = 50;
const ROUNDS = 20;

export function measureMemory(): Table {
  const cloud = dragon("dragon");
  const at = orbit(cloud);
  const rows = EXPONENTS.map((exponent) => row(cloud, { views: [at(0), at(1), at(180)], rounds: 1, exponent }));
  const views = Array.from({ length: VIEWS }, (_, i): Point => at(i % 2 === 0 ? i : 137 * i));
  rows.push(row(cloud, { views, rounds: ROUNDS, exponent: 0 }));
  const large = huge();
  rows.push(row(large, { views: [orbit(large)(0)], rounds: 1, exponent: 3 }));
  const note =
    "The WebAssembly memory, which never shrinks: its size after building, and its peak. Over many viewpoints it must stop " +
    `growing: each of ${VIEWS} is asked ${ROUNDS} times, and what is needed after the first time is compared with the last.`;
  return { title: "Memory", note, rows };
}

function row(cloud: Cloud, work: MemoryWork): Row {
  console.error(`${cloud.name}: memory over ${work.views.length * work.rounds} queries…`);
  const [file] = writeCloud(cloud);
  const output = ask(process.execPath, [program("memory-engine"), file], { input: JSON.stringify(work) });
  const use = JSON.parse(output!) as MemoryUse;
  const points = cloud.positions.length / 3;
  const [first, last] = [use.rounds[0]!, use.rounds.at(-1)!];
  if (last > 1.01 * first) throw new WrongAnswer(`${cloud.name}: memory grew from ${first} to ${last} bytes`);
  return {
    cloud: cloud.name,
    points,
    exponent: work.exponent === 0 ? "automatic" : String(work.exponent),
    queries: work.views.length * work.rounds,
    visible: use.visible,
    "built MB": use.built / MB,
    "peak MB": last / MB,
    "bytes a point, built": use.built / points,
    "bytes a point, peak": last / points,
    "growth after the first round": `${(last / first - 1) * 100} %`,
    "build ms": use.milliseconds.build,
    "query ms": use.milliseconds.query,
  };
}
