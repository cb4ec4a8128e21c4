import { ask, build, giveMemory, type PointCloud } from "../cloud.js";
import { withHidden } from "../hidden.js";
import { importNodeModule } from "../node.js";
import type { CloudSize } from "../options.js";
import { initSync } from "../start.js";
import { failedReply, type Letter, type Progress, READY, type Replies, type Reply, type Request } from "./protocol.js";

type Post = (message: unknown, transfer: ArrayBuffer[]) => void;

/** By the numbers they are given outside. */
const clouds = new Map<number, PointCloud>();

function answer(letter: Letter<Request>, post: Post): Replies[Request["kind"]] {
  const { cloud: number, content: request } = letter;
  if (request.kind === "create") {
    initSync(request.module);
    const { dimension, stride, skipNonFinite } = request.settings;
    const nonFinite = skipNonFinite ? "skip" : "error";
    const report = (progress: number) => {
      if (request.reporting) {
        post({ cloud: number, content: { progress } satisfies Progress } satisfies Letter, []);
      }
    };
    const created = build(request.positions, { dimension, stride, nonFinite }, report);
    clouds.set(number, created);
    return sizeOf(created);
  }
  const cloud = clouds.get(number);
  if (request.kind === "forget") {
    clouds.delete(number);
    cloud?.dispose();
    return {};
  }
  if (cloud === undefined) {
    throw new Error(`${request.kind} came before create`);
  }
  switch (request.kind) {
    case "append":
      cloud.append(request.positions);
      return sizeOf(cloud);
    case "remove":
      cloud.remove(request.indices);
      return sizeOf(cloud);
    default: {
      giveMemory(cloud, request.spare);
      const found = ask(cloud, request);
      if (request.listing === true && "indices" in found) {
        found.indices = withHidden(found.indices, found.length);
      }
      return found;
    }
  }
}

function sizeOf({ length, skipped, spacing }: PointCloud): CloudSize {
  return { length, skipped, spacing };
}

/** Every request gets a reply, whatever is thrown. */
function serve(letter: Letter<Request>, post: Post): void {
  let reply: Reply<Replies[Request["kind"]]>;
  try {
    reply = { value: answer(letter, post) };
  } catch (thrown) {
    reply = failedReply(thrown);
  }
  const content: Letter = { cloud: letter.cloud, content: reply };
  post(content, "value" in reply ? buffersIn(reply.value) : []);
}

/** What is moved rather than copied. */
function buffersIn(value: Replies[Request["kind"]]): ArrayBuffer[] {
  return Object.values(value).flatMap((field: unknown) =>
    ArrayBuffer.isView(field) ? [field.buffer as ArrayBuffer] : [],
  );
}

async function serveNode(): Promise<void> {
  const { parentPort } = await importNodeModule<typeof import("node:worker_threads")>("node:worker_threads");
  const post: Post = (message, transfer) => parentPort?.postMessage(message, transfer);
  parentPort?.on("message", (letter: Letter<Request>) => {
    serve(letter, post);
  });
  post(READY, []);
}

const scope = globalThis as unknown as { postMessage?: Post };
if (scope.postMessage === undefined) {
  void serveNode();
} else {
  const post: Post = scope.postMessage.bind(globalThis);
  addEventListener("message", (event: MessageEvent<Letter<Request>>) => {
    serve(event.data, post);
  });
  post(READY, []);
}
