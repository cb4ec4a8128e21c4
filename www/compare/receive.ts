/// <reference lib="webworker" />
import type { Parts } from "../view/parts.ts";
import type { Reply, Told } from "./protocol.ts";

/** Answers a question. Returns `null` if `stopped` ended the computation. */
type Ask<Question> = (
  positions: Float32Array,
  question: Question,
  stopped: () => boolean,
  progress: (fraction: number) => void,
) => Promise<{ parts: Parts } | null>;

/** The worker's side: receives the cloud and answers questions about it. */
export function receive(ask: Ask<never>): void {
  const post = (reply: Reply<{ parts: Parts }>, moved: Transferable[] = []) => {
    self.postMessage(reply, { transfer: moved });
  };
  let positions = new Float32Array();
  let turn = 0;
  self.onmessage = async ({ data: told }: MessageEvent<Told<never>>) => {
    if (told.kind === "points") {
      if (told.at === 0) positions = new Float32Array(3 * told.count);
      positions.set(told.points, told.at);
      return;
    }
    const own = ++turn;
    if (told.kind === "stop") return;
    try {
      const answer = await ask(
        positions,
        told.question,
        () => turn !== own,
        (fraction) => {
          post({ kind: "progress", fraction });
        },
      );
      if (answer === null) post({ kind: "stopped" });
      else post({ kind: "answer", answer }, [answer.parts.order.buffer]);
    } catch (error) {
      post({ kind: "problem", sentence: error instanceof Error ? error.message : String(error) });
    }
  };
}
