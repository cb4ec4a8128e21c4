/// <reference lib="webworker" />
import { init, type MergeOptions } from "hidden-point-removal";
import { type Octree, openOctree } from "hidden-point-removal/stream";
import type { Streamed } from "../cloud/cloud.ts";
import { compileFiles } from "../loaders/download.ts";
import { LoadProblem } from "../loaders/protocol.ts";
import type { StreamReply, StreamStep, StreamTold, StreamView } from "./streamed-inquiry.ts";

/** The most points that are kept for the next view. */
const KEPT = 4_000_000;

const post = (reply: StreamReply, transfer: Transferable[] = []) => self.postMessage(reply, { transfer });

let opening: Promise<Octree> | undefined;
let source: Streamed | undefined;
let running = new AbortController();
let goOn: () => void = () => undefined;

self.onmessage = ({ data: told }: MessageEvent<StreamTold>) => {
  if (told.kind === "open") {
    source = told.streamed;
  } else if (told.kind === "next") {
    goOn();
  } else {
    running.abort();
    goOn();
    if (told.kind === "view") void show(told.turn, told.view, (running = new AbortController()).signal);
  }
};

/** Opens the octree for the first view. If that fails, the next view tries again. */
function open({ from, name, colorScale, points }: Streamed): Promise<Octree> {
  opening ??= Promise.all([compileFiles(name), init()])
    .then(([wasm]) => openOctree(from, { wasm, cache: KEPT, colors: colorScale !== null }))
    .then((octree) => {
      // The coarser levels on the page are those of the file that was opened first.
      if (octree.points !== points) throw new LoadProblem(`${name} has changed. Open it again.`);
      return octree;
    })
    .catch((error: unknown) => {
      opening = undefined;
      throw error;
    });
  return opening;
}

async function show(turn: number, view: StreamView, signal: AbortSignal): Promise<void> {
  try {
    const octree = await open(source!);
    const options = { ...(await optionsFor(octree, view)), budget: source!.budget, signal };
    for await (const step of octree.visibleFrom(view.viewpoint, options)) {
      if (signal.aborted) return;
      const positions = step.positions();
      const colors = displayed(step.colors(), source!.colorScale);
      const { exact, nodes, points, radius, inversion } = step;
      const merge: MergeOptions = radius > 0 ? { radius, inversion } : { inversion };
      const taken = new Promise<void>((resolve) => (goOn = resolve));
      post({ kind: "step", turn, step: { positions, colors, exact, nodes, points, merge } }, [
        positions.buffer,
        ...(colors ? [colors.buffer] : []),
      ]);
      await taken;
    }
    post({ kind: "end", turn });
  } catch (error) {
    if (!signal.aborted) post({ kind: "problem", turn, sentence: sentenceOf(error) });
  }
}

/** Colors in bytes. */
function displayed(colors: Uint16Array | undefined, scale: number | null): StreamStep["colors"] {
  if (!colors || scale === null) return null;
  return new Uint8Array(Uint8ClampedArray.from(colors, (value) => value * scale).buffer);
}

async function optionsFor(octree: Octree, { method }: StreamView): Promise<MergeOptions> {
  if (method === "automatic") return {};
  if ("length" in method) return { radius: method.length };
  const { exponential } = method;
  return exponential === "auto" ? {} : { inversion: { exponential: exponential * (await octree.spacing()) } };
}

function sentenceOf(error: unknown): string {
  if (error instanceof LoadProblem) return error.message;
  const said = error instanceof Error ? error.message : String(error);
  return `${source!.name} could not be read further: ${said.replace(/\.$/, "")}.`;
}
