/// <reference lib="webworker" />
import type { LoadedCloud } from "../cloud/cloud.ts";
import { prepareCloud } from "../cloud/prepare.ts";
import { makeSample } from "../samples/generators.ts";
import { download } from "./download.ts";
import { MAX_POINTS } from "../settings/limits.ts";
import { checkedCloud } from "./limits.ts";
import { LoadProblem, type LoadReply, missingPart, type WorkerRequest } from "./protocol.ts";

const post = (reply: LoadReply, transfer: Transferable[] = []) => self.postMessage(reply, { transfer });

/** The least number of milliseconds between two reports. The eye does not see faster changes. */
const EVERY = 50;
let last = { step: "", at: 0 };
const progress = (step: string, fraction: number | null) => {
  const now = performance.now();
  if (step === last.step && now < last.at + EVERY) return;
  last = { step, at: now };
  post({ kind: "progress", step, fraction });
};

self.onmessage = async ({ data: request }: MessageEvent<WorkerRequest>) => {
  try {
    const prepared = prepareCloud(await load(request));
    const { positions, copy, cloud } = prepared;
    const columns = [...cloud.attributes, ...cloud.fields].map(({ values }) => values);
    const arrays = [positions, copy, cloud.local, cloud.spacing.local, cloud.colors, ...columns];
    // Most fields are attributes, too.
    const buffers = new Set(arrays.flatMap((array) => (array ? [array.buffer as ArrayBuffer] : [])));
    post({ kind: "cloud", prepared }, [...buffers]);
  } catch (error) {
    const isMissing = error instanceof TypeError && error.message.includes("import");
    const problem = isMissing
      ? missingPart(request.name)
      : error instanceof LoadProblem
        ? error
        : new LoadProblem(`${request.name} could not be read: ${String(error)}.`);
    post({ kind: "problem", sentence: problem.message, rest: problem.rest });
  }
};

/** The beginning of the text, short enough for a sentence. */
function shortened(address: string): string {
  return address.length > 60 ? `${address.slice(0, 60)}…` : address;
}

async function load(request: WorkerRequest): Promise<LoadedCloud> {
  const { name } = request;
  const downloading = (fraction: number | null) => progress("Downloading", fraction);
  if (request.kind === "shape") {
    progress("Making", null);
    return makeSample(request.shape);
  }

  const onProgress = (fraction: number) => progress("Reading", fraction);
  const { limit = MAX_POINTS } = request;
  if (request.kind === "files") {
    const { readSeveral } = await import("./several.ts");
    return readSeveral(request.files, { limit, onProgress });
  }
  const { skipNonFinite, damaged, chosen } = request;
  const check = (cloud: LoadedCloud) => checkedCloud(name, cloud, skipNonFinite === true);
  // Refuses texts that cannot be read as an address, and addresses that hold their own content (data:). A program hands over
  // its own cloud by blob:.
  if (request.kind === "url" && !request.url.startsWith("blob:") && !URL.canParse(".", request.url)) {
    throw new LoadProblem(`“${shortened(request.url)}” is not the address of a file.`);
  }
  if (/\.copc\.laz$/i.test(name)) {
    const { coarseOf } = await import("./octree.ts");
    const coarse = await coarseOf(name, request.kind === "file" ? request.file : request.url, limit);
    if (coarse !== null) return check(coarse);
  }
  const blob = request.kind === "file" ? request.file : await download(name, request.url, downloading);
  if (blob.size === 0) throw new LoadProblem(`${name} is empty.`);
  progress("Reading", null);
  const beside = async (other: string) => {
    if (request.kind !== "url") {
      throw new LoadProblem(`${name} keeps its points in ${other}. Export it as one GLB file.`);
    }
    const found = await download(
      other,
      new URL(other.split("/").map(encodeURIComponent).join("/"), request.url).href,
      downloading,
    );
    return new Uint8Array(await found.arrayBuffer());
  };
  // Samples do not need it, and the first cloud is one.
  const { readCloud } = await import("./read.ts");
  return check(await readCloud({ name, blob, limit, onProgress, beside, damaged, chosen }));
}
