/// <reference lib="webworker" />
import { oracleFor } from "./oracles.ts";
import type { TruthQuestion, TruthReply } from "./truth.ts";

/** Milliseconds between two reports of progress. */
const TURN = 50;
/** The number of rays after which the worker reads the clock. */
const RAYS = 64;

const post = (reply: TruthReply) => self.postMessage(reply);

self.onmessage = async ({ data: { surface, positions, viewpoint } }: MessageEvent<TruthQuestion>) => {
  try {
    const { count, from } = await oracleFor(surface, positions);
    if (count !== positions.length / 3) throw new Error("its surface is that of another cloud");
    const sees = from(viewpoint);
    const seen = new Uint8Array(count);
    let told = performance.now();
    for (let i = 0; i < count; i++) {
      seen[i] = Number(sees(i));
      if (i % RAYS > 0 || performance.now() < told + TURN) continue;
      told = performance.now();
      post({ kind: "progress", share: i / count });
    }
    post({ kind: "seen", seen });
  } catch (error) {
    post({ kind: "problem", sentence: error instanceof Error ? error.message : String(error) });
  }
};
