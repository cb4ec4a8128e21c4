import { CoreCloud } from "../cloud/held-cloud.js";
import { initSync } from "../instance/init-sync.js";
import { requireInstance } from "../instance/instance.js";
import { importNodeModule } from "../base/node.js";
import type { Query } from "../query/queries.js";
import {
  BEAT,
  failedReply,
  type Letter,
  type Progress,
  READY,
  type Replies,
  type Reply,
  type Request,
} from "./protocol.js";

const tasks: (() => void)[] = [];
let channel: MessageChannel | undefined;

/** Resolves in a task of its own, after the messages that have arrived. A timer would wait for some milliseconds. */
export function nextTask(): Promise<void> {
  return new Promise((resolve) => {
    const { setImmediate } = globalThis as { setImmediate?: (act: () => void) => void };
    if (setImmediate !== undefined) {
      // Node reads up to 1000 messages of one channel before it reads those of another.
      setImmediate(resolve);
      return;
    }
    if (channel === undefined) {
      channel = new MessageChannel();
      channel.port1.onmessage = () => tasks.shift()?.();
    }
    tasks.push(resolve);
    channel.port2.postMessage(undefined);
  });
}

type Post = (message: unknown, transfer: ArrayBuffer[]) => void;

/** The milliseconds between two signs of life. */
const BEATS = 500;
let isListening = false;

/** Says from inside of long computations that this worker is alive. It cannot answer meanwhile. */
function listenToBeats(post: Post): void {
  let last = performance.now();
  const beat = () => {
    const now = performance.now();
    if (now - last >= BEATS) {
      last = now;
      post(BEAT, []);
    }
  };
  requireInstance().call((bindings) => {
    bindings.onBeat(beat);
  });
}

/** The clouds by the numbers that they have outside. */
const clouds = new Map<number, CoreCloud>();

function answer(letter: Letter<Request>, post: Post): Replies[Request["kind"]] {
  const { cloud: number, content: request } = letter;
  if (request.kind === "create") {
    initSync(request.module);
    if (!isListening) {
      isListening = true;
      listenToBeats(post);
    }
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
    case "abandon":
    case "survey":
      return {};
    case "append":
      cloud.append(request.positions);
      return cloud.size;
    case "remove":
      cloud.remove(request.indices);
      return cloud.size;
    default:
      return cloud.ask(request);
  }
}

/** The view that is computed in slices. */
let sliced: { cloud: number; isAbandoned: boolean } | undefined;
/** The requests that wait, at most one of each cloud. The clouds take turns, in the order of their requests. */
let waiting: Letter<Request>[] = [];

function receive(letter: Letter<Request>, post: Post): void {
  if (letter.content.kind === "abandon") {
    abandon(letter.cloud, post);
    return;
  }
  waiting.push(letter);
  if (sliced === undefined) serveWaiting(post);
}

/** Serves all requests, up to a view in slices. */
function serveWaiting(post: Post): void {
  for (let next = waiting.shift(); next !== undefined; next = waiting.shift()) {
    if (isSliced(next.content)) {
      void serveInSlices(next.cloud, next.content, post);
      return;
    }
    serve(next, post);
  }
}

function isSliced(request: Request): request is Query<"visibleFrom"> & { sliced: true } {
  return request.kind === "visibleFrom" && request.sliced === true;
}

/**
 * After each slice, one request of another cloud is served, and this view may be given up. Other views in slices wait,
 * because the wasm keeps two unfinished views: each of more clouds would begin again in each of its slices.
 */
async function serveInSlices(cloud: number, request: Query<"visibleFrom">, post: Post): Promise<void> {
  const view = { cloud, isAbandoned: false };
  sliced = view;
  while (!isComplete(clouds.get(cloud), request)) {
    await nextTask();
    if (view.isAbandoned) {
      break;
    }
    const next = waiting.find(({ content }) => !isSliced(content));
    if (next !== undefined) {
      waiting = waiting.filter((letter) => letter !== next);
      serve(next, post);
    }
  }
  sliced = undefined;
  if (view.isAbandoned) {
    giveUp(cloud, post);
  } else {
    serve({ cloud, content: request }, post);
  }
  serveWaiting(post);
}

/** Gives up the view in slices of a cloud, also one that waits. */
function abandon(cloud: number, post: Post): void {
  if (sliced?.cloud === cloud) {
    sliced.isAbandoned = true;
    return;
  }
  const view = waiting.find((letter) => letter.cloud === cloud && isSliced(letter.content));
  if (view !== undefined) {
    waiting = waiting.filter((letter) => letter !== view);
    giveUp(cloud, post);
  }
}

function giveUp(cloud: number, post: Post): void {
  post({ cloud, content: { abandoned: true } satisfies Reply } satisfies Letter, []);
}

/** Computes one slice. Returns whether only the answer is left to ask for. */
function isComplete(cloud: CoreCloud | undefined, request: Query<"visibleFrom">): boolean {
  try {
    return cloud === undefined || cloud.goOn(request);
  } catch {
    // The answer is the same error.
    return true;
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
    receive(letter, post);
  });
  post(READY, []);
}

const scope = globalThis as unknown as { postMessage?: Post };
if (scope.postMessage === undefined) {
  void serveNode();
} else {
  const post: Post = scope.postMessage.bind(globalThis);
  addEventListener("message", (event: MessageEvent<Letter<Request>>) => {
    receive(event.data, post);
  });
  post(READY, []);
}
