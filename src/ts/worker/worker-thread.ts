import { CoreCloud } from "../cloud/core-cloud.js";
import { withHidden } from "../cloud/hidden.js";
import { requireInstance } from "../instance/instance.js";
import { importNodeModule } from "../base/node.js";
import { initSync } from "../instance/start.js";
import { failedReply, type Letter, type Progress, READY, type Replies, type Reply, type Request } from "./protocol.js";

type Post = (message: unknown, transfer: ArrayBuffer[]) => void;

/** The clouds by the numbers that they have outside. */
const clouds = new Map<number, CoreCloud>();

function answer(letter: Letter<Request>, post: Post): Replies[Request["kind"]] {
  const { cloud: number, content: request } = letter;
  if (request.kind === "create") {
    initSync(request.module);
    const report = (progress: number) => {
      if (request.reporting) {
        post({ cloud: number, content: { progress } satisfies Progress } satisfies Letter, []);
      }
    };
    const created = new CoreCloud(requireInstance(), request.positions, request.settings, report);
    clouds.set(number, created);
    return created.size;
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
      return cloud.size;
    case "remove":
      cloud.remove(request.indices);
      return cloud.size;
    default: {
      cloud.keepMemory(request.spare);
      const found = cloud.ask(request);
      if (request.listing === true && "indices" in found) {
        found.indices = withHidden(found.indices, found.length);
      }
      return found;
    }
  }
}

/** Replies to every request, also after an error. */
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

/** The buffers that are moved instead of copied. */
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
