// A camera turns at 60 frames a second, and nothing is drawn: how old the map of each frame is, which the worker made.
import { WorkerPointCloud } from "hidden-point-removal/worker";

import { bumpy, bumpyFiveMillion, type Cloud, dragon } from "./clouds.js";
import { median, type Row, type Table } from "./report.js";
import { orbit } from "./views.js";

const FRAME = 1000 / 60;
/** Degrees from one frame to the next one. */
const SPEED = 1;
const FRAMES = 300;
/** A viewer draws all points if its map is older than so many degrees. */
const STAND_IN = 2;

export async function timeFrames(): Promise<Table> {
  const rows: Row[] = [];
  for (const made of [dragon("dragon"), bumpy("bumpy-1m"), bumpyFiveMillion()]) rows.push(await turned(made));
  const note = `${FRAMES} frames at 60 a second, ${SPEED}° apart. Milliseconds are medians from the question to the map, messages included.`;
  return { title: "Maps in a worker, for each frame", note, rows };
}

async function turned(made: Cloud): Promise<Row> {
  console.error(`${made.name}: frames…`);
  const cloud = await WorkerPointCloud.create(made.positions, { workers: 1 });
  const at = orbit(made);
  await cloud.visibilityMap(at(0));
  const [times, ages]: number[][] = [[], []];
  let [now, mapped, maps, isBusy] = [0, 0, 0, false];
  // One question is in flight, and the newest viewpoint is the next one.
  const ask = async () => {
    isBusy = true;
    const [asked, begun] = [now, performance.now()];
    await cloud.visibilityMap(at(asked));
    times!.push(performance.now() - begun);
    [mapped, maps, isBusy] = [asked, maps + 1, false];
  };
  let asking = Promise.resolve();
  const begun = performance.now();
  for (let frame = 1; frame <= FRAMES; frame++) {
    await new Promise((resolve) => setTimeout(resolve, begun + FRAME * frame - performance.now()));
    ages!.push(now - mapped);
    now = SPEED * frame;
    if (!isBusy) asking = ask();
  }
  await asking;
  await cloud.dispose();
  return {
    cloud: made.name,
    "map ms": median(times!),
    "frames a map": FRAMES / maps,
    "map's age, mean °": ages!.reduce((sum, age) => sum + age) / FRAMES,
    "frames of all points %": (100 * ages!.filter((age) => age > STAND_IN).length) / FRAMES,
  };
}
