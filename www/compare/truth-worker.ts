import { HIDDEN, partsOf, VISIBLE } from "../view/parts.ts";
import { oracleFor } from "./oracles.ts";
import type { KnownSurface } from "../samples/samples.ts";
import type { Errors, TruthAnswer, TruthQuestion } from "./protocol.ts";
import { receive } from "./receive.ts";
import type { Oracle } from "./tracer.ts";

/** Milliseconds between two reports of progress. Messages are read at each report. */
const TURN = 50;
/** The number of rays after which the worker reads the clock. */
const RAYS = 64;

interface Traced {
  place: string;
  said: Uint8Array;
  milliseconds: number;
}

let oracle: Oracle | null = null;
/** The last truth. Our settings do not change it. */
let traced: Traced | null = null;

receive(
  async (
    positions,
    { surface, viewpoint, visible: ours, hull }: TruthQuestion,
    stopped,
    progress,
  ): Promise<TruthAnswer | null> => {
    const place = viewpoint.join();
    if (traced?.place !== place) traced = await trace(surface, positions, viewpoint, stopped, progress);
    if (traced === null) return null;
    const { said, milliseconds } = traced;
    const visible = said.reduce((sum, one) => sum + one, 0);
    return { parts: partsOf(said, ours), visible, hull: hull && errorsOf(said, visible, hull), milliseconds };
  },
);

function errorsOf(said: Uint8Array, visible: number, shown: Uint32Array): Errors {
  let right = 0;
  for (const index of shown) if (said[index] === VISIBLE) right++;
  return { wrong: shown.length - right, missed: visible - right };
}

async function trace(
  surface: KnownSurface,
  positions: Float32Array,
  viewpoint: readonly number[],
  stopped: () => boolean,
  progress: (fraction: number) => void,
): Promise<Traced | null> {
  oracle ??= await oracleFor(surface, positions);
  const { count } = oracle;
  if (count !== positions.length / 3) throw new Error("its surface is that of another cloud");
  const sees = oracle.from(viewpoint);
  const said = new Uint8Array(count);
  let milliseconds = 0;
  for (let i = 0; i < count;) {
    if (stopped()) return null;
    const begun = performance.now();
    while (i < count && performance.now() < begun + TURN) {
      for (const end = Math.min(count, i + RAYS); i < end; i++) said[i] = sees(i) ? VISIBLE : HIDDEN;
    }
    milliseconds += performance.now() - begun;
    progress(i / count);
    await new Promise((resolve) => setTimeout(resolve));
  }
  return { place: viewpoint.join(), said, milliseconds };
}
