// The memory that each new view leaves behind, on the page's side and in its worker.
import threads, { BroadcastChannel } from "node:worker_threads";
import { syncBuiltinESMExports } from "node:module";

import type { Visibility } from "hidden-point-removal";
import { WorkerPointCloud } from "hidden-point-removal/worker";

import { type Cloud, dragon } from "./clouds.js";
import { buffers, collected, PROBE, type Probed } from "./probe.js";
import type { Row, Table } from "./report.js";
import { orbit } from "./views.js";

const VIEWS = 60;
/** The number of views before the counting. After them, the recycled memory has room for the largest answer. */
const BEFORE = 3;

export async function measureGarbage(): Promise<Table> {
  const rows: Row[] = [];
  const cloud = dragon("dragon");
  for (const recycled of [false, true]) {
    console.error(`${cloud.name}: garbage of answers${recycled ? ", recycled" : ""}…`);
    rows.push(await row(cloud, recycled));
  }
  const note =
    `Bytes of array buffers that a view leaves to the garbage collectors, means of ${VIEWS} views 1° apart in Node, on the page's side ` +
    "and in the one worker: answers kept for one frame, and given back with recycle(), as the adapters do.";
  return { title: "Memory of answers", note, rows };
}

async function row(cloud: Cloud, recycled: boolean): Promise<Row> {
  const at = orbit(cloud);
  const inWorker = probeWorkers();
  const points = await WorkerPointCloud.create(cloud.positions, { workers: 1 });
  let [page, worker, visible] = [0, 0, 0];
  try {
    for (let i = -BEFORE; i < VIEWS; i++) {
      // Memory that this side releases is counted on the side that allocated it.
      collected();
      const there = await inWorker.ask({ collect: true });
      const before = collected();
      let answer: Visibility | undefined = await points.visibleFrom(at(BEFORE + i), { exponent: 3 });
      const { count } = answer;
      if (recycled) points.recycle(answer);
      answer = undefined;
      if (i >= 0) {
        page += buffers() - before;
        worker += (await inWorker.ask({ collect: false })) - there;
        visible += count;
      }
    }
  } finally {
    inWorker.end();
    await points.dispose();
  }
  return {
    cloud: cloud.name,
    points: cloud.positions.length / 3,
    recycled: recycled ? "yes" : "no",
    visible: Math.round(visible / VIEWS),
    "page, bytes a view": Math.round(page / VIEWS),
    "worker, bytes a view": Math.round(worker / VIEWS),
  };
}

/** Makes the next worker report its memory, too. */
function probeWorkers() {
  const { Worker } = threads;
  const replace = (replacement: typeof Worker) => {
    threads.Worker = replacement;
    syncBuiltinESMExports();
  };
  replace(
    class extends Worker {
      constructor(script: URL) {
        super(script, { execArgv: ["--import", PROBE.href] });
      }
    },
  );
  const channel = new BroadcastChannel(PROBE.href);
  return {
    ask: (question: Probed["question"]) =>
      new Promise<number>((resolve) => {
        channel.onmessage = (event) => {
          const { data } = event as { data: Partial<Probed> };
          if (data.answer !== undefined) resolve(data.answer);
        };
        channel.postMessage({ question });
      }),
    end: () => {
      channel.close();
      replace(Worker);
    },
  };
}
