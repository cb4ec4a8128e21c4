import { PointCloud, visibleInSector } from "../cloud.js";
import { initSync } from "../loader.js";
import { importNodeModule } from "../node.js";
import { type CloudSize, failedReply, READY, type Replies, type Reply, type Request } from "./protocol.js";

type Post = (message: unknown, transfer: ArrayBuffer[]) => void;

let cloud: PointCloud | undefined;

function answer(request: Request): Replies[Request["kind"]] {
  if (request.kind === "create") {
    initSync(request.module);
    const { stride, skipNonFinite } = request.settings;
    const nonFinite = skipNonFinite ? "skip" : "error";
    cloud = new PointCloud(request.positions, { stride, nonFinite });
    return sizeOf(cloud);
  }
  if (cloud === undefined) {
    throw new Error(`${request.kind} came before create`);
  }
  switch (request.kind) {
    case "visibleFrom": {
      const { viewpoint, settings, sector } = request;
      const { indices, radius, exponent, evaluations } =
        sector === undefined
          ? cloud.visibleFrom(viewpoint, settings)
          : visibleInSector(cloud, viewpoint, settings, sector);
      return { indices, radius, exponent, evaluations, length: cloud.length };
    }
    case "autoRadius":
      return cloud.autoRadius(request.viewpoint);
    case "append":
      cloud.append(request.positions);
      return sizeOf(cloud);
    case "remove":
      cloud.remove(request.indices);
      return sizeOf(cloud);
  }
}

function sizeOf({ length, skipped }: PointCloud): CloudSize {
  return { length, skipped };
}

/** Every request gets a reply, whatever is thrown. */
function serve(request: Request, post: Post): void {
  let reply: Reply<Replies[Request["kind"]]>;
  try {
    reply = { value: answer(request) };
  } catch (thrown) {
    reply = failedReply(thrown);
  }
  const moved =
    "value" in reply && "indices" in reply.value ? [reply.value.indices.buffer as ArrayBuffer] : [];
  post(reply, moved);
}

async function serveNode(): Promise<void> {
  const { parentPort } =
    await importNodeModule<typeof import("node:worker_threads")>("node:worker_threads");
  const post: Post = (message, transfer) => parentPort?.postMessage(message, transfer);
  parentPort?.on("message", (request: Request) => {
    serve(request, post);
  });
  post(READY, []);
}

const scope = globalThis as unknown as { postMessage?: Post };
if (scope.postMessage === undefined) {
  void serveNode();
} else {
  const post: Post = scope.postMessage.bind(globalThis);
  addEventListener("message", (event: MessageEvent<Request>) => {
    serve(event.data, post);
  });
  post(READY, []);
}
