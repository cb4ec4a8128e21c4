/// <reference lib="webworker" />
import type { LoadedCloud } from "../cloud.ts";
import { SHAPES } from "../shapes/index.ts";
import { download } from "./download.ts";
import { checkByteLength, checkedCloud } from "./limits.ts";
import { LoadProblem } from "./problem.ts";
import { readFile } from "./read.ts";
import type { LoadReply, LoadRequest } from "./protocol.ts";

const post = (reply: LoadReply, transfer: Transferable[] = []) => { self.postMessage(reply, { transfer }); };
const progress = (step: string, fraction: number | null) => { post({ kind: "progress", step, fraction }); };

self.onmessage = async ({ data: request }: MessageEvent<LoadRequest>) => {
  try {
    const cloud = await load(request);
    const buffers = [cloud.positions.buffer, ...(cloud.colors ? [cloud.colors.buffer] : [])];
    post({ kind: "cloud", cloud }, buffers as ArrayBuffer[]);
  } catch (error) {
    const problem = error instanceof LoadProblem ? error : new LoadProblem(`${request.name} could not be read: ${String(error)}`);
    post({ kind: "problem", sentence: problem.message, nonFinite: problem.nonFinite });
  }
};

async function load(request: LoadRequest): Promise<LoadedCloud> {
  if (request.kind === "shape") {
    progress("Making", null);
    return SHAPES[request.shape]();
  }
  let data: ArrayBuffer;
  if (request.kind === "file") {
    checkByteLength(request.name, request.file.size);
    progress("Reading", null);
    data = await request.file.arrayBuffer();
  } else {
    data = await download(request.name, request.url, (fraction) => { progress("Downloading", fraction); });
  }
  if (request.kind === "sample") {
    // A server that answers with a page for what it does not have.
    if (data.byteLength % 12 !== 0) throw new LoadProblem(`${request.name} could not be downloaded: the server sent something else.`);
    return { positions: new Float32Array(data), colors: null };
  }
  progress("Reading", null);
  return checkedCloud(request.name, readFile(request.name, data), request.skipNonFinite);
}
