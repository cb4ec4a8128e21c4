/// <reference lib="webworker" />
import { oracleFor } from "./oracles.ts";
import type { TruthQuestion, TruthReply } from "./truth.ts";

const post = (reply: TruthReply) => self.postMessage(reply);

self.onmessage = async ({ data: { surface, positions, viewpoint } }: MessageEvent<TruthQuestion>) => {
  try {
    const { count, from } = await oracleFor(surface, positions);
    if (count !== positions.length / 3) throw new Error("its surface is that of another cloud");
    const sees = from(viewpoint);
    post(Uint8Array.from({ length: count }, (_, i) => Number(sees(i))));
  } catch (error) {
    post(error instanceof Error ? error.message : String(error));
  }
};
