// Properties of requests that are interrupted: a worker is killed, the cloud is disposed of, or a request is aborted.
import fc from "fast-check";
import { PointCloud } from "hidden-point-removal";
import { WorkerPointCloud } from "hidden-point-removal/worker";
import { CountedWorker, OriginalWorker, replaceWorker, running } from "../../package/node-workers.js";
import { judge, type Outcome, outcomeOf, require } from "./outcome.js";

const START = Array.from({ length: 300 }, (_, i) => Math.sin(i * i));
const MORE = Array.from({ length: 30 }, (_, i) => Math.cos(i));

/** The requests that may be under way when an event happens. */
const REQUESTS = {
  visibleFrom: (cloud, options) => cloud.visibleFrom([0, 0, 5], options),
  visibleFromDirection: (cloud, options) => cloud.visibleFromDirection([0, 0, -1], options),
  visibleFromAny: (cloud, options) => cloud.visibleFromAny([[0, 0, 5]], options),
  visibleFromAtLeast: (cloud, options) => cloud.visibleFromAtLeast(1, [[5, 0, 0]], options),
  autoRadius: (cloud, options) => cloud.autoRadius([0, 0, 5], "opposite", options),
  reconstruct: (cloud, options) => cloud.reconstruct([0, 0, 5], options),
  illuminate: (cloud, options) => cloud.illuminate([[0, 0, 5]], options),
  append: (cloud) => cloud.append(MORE),
  remove: (cloud) => cloud.remove([1, 2]),
} satisfies Record<string, (cloud: WorkerPointCloud, options: Options) => unknown>;

interface Options {
  latest?: boolean;
  signal?: AbortSignal;
}

type Event = "kill" | "dispose" | "abort" | "wait" | "create" | "exit";
type Request = { method: keyof typeof REQUESTS; latest: boolean; signalled: boolean };

const request = fc.record<Request>({
  method: fc.constantFrom(...(Object.keys(REQUESTS) as (keyof typeof REQUESTS)[])),
  latest: fc.boolean(),
  signalled: fc.boolean(),
});
const event = fc.constantFrom<Event>("kill", "kill", "dispose", "abort", "wait", "wait", "create", "exit");

const plan = fc.record({
  placement: fc.constantFrom<object>({}, { workers: 2 }, { workers: 3 }, { shared: true }),
  steps: fc.array(fc.oneof({ weight: 3, arbitrary: request }, { weight: 1, arbitrary: event }), {
    minLength: 1,
    maxLength: 12,
  }),
});

/** Every promise settles, with an answer or with a code that the events explain. The next cloud works. */
export const flights = fc.asyncProperty(plan, async ({ placement, steps }) => {
  replaceWorker(CountedWorker);
  const unhandled: unknown[] = [];
  const note = (reason: unknown) => unhandled.push(reason);
  process.on("unhandledRejection", note);
  try {
    await fly(placement, steps);
    await restarted(placement);
    await new Promise((next) => setTimeout(next, 1));
    require(unhandled.length === 0, `a rejection was left unhandled: ${String(unhandled[0])}`);
  } finally {
    process.off("unhandledRejection", note);
    await Promise.all([...running].map((worker) => worker.terminate()));
    replaceWorker(OriginalWorker);
  }
});

async function fly(placement: object, steps: readonly (Event | Request)[]): Promise<void> {
  const cloud = await WorkerPointCloud.create(START, placement);
  const abort = new AbortController();
  const happened = new Set<Event>();
  const checks: { name: string; codes: string[]; outcome: Promise<Outcome> }[] = [];
  const others: Promise<Outcome>[] = [];
  for (const step of steps) {
    if (typeof step === "object") {
      const { method, latest, signalled } = step;
      const options = { latest, ...(signalled && { signal: abort.signal }) };
      const takesOptions = method !== "append" && method !== "remove";
      const codes = takesOptions && (latest || signalled) ? ["AbortError"] : [];
      checks.push({ name: method, codes, outcome: outcomeOf(() => REQUESTS[method](cloud, options)) });
      continue;
    }
    happened.add(step);
    switch (step) {
      case "kill":
        void [...running][0]?.terminate();
        break;
      case "exit":
        void Promise.all([...running].map((worker) => worker.terminate()));
        break;
      case "dispose":
        void cloud.dispose();
        break;
      case "abort":
        abort.abort();
        break;
      case "create":
        others.push(outcomeOf(async () => (await WorkerPointCloud.create(START, placement)).visibleFrom([0, 0, 5])));
        break;
      case "wait":
        await new Promise((next) => setTimeout(next, 2));
    }
  }
  const ended = [
    ...(happened.has("kill") || happened.has("exit") ? ["internal"] : []),
    ...(happened.has("dispose") ? ["disposed"] : []),
  ];
  for (const { name, codes, outcome } of checks) {
    judge(name, { codes: [...codes, ...ended], sure: false }, await outcome);
  }
  for (const other of others) {
    // A worker that is killed during its start may count as one that cannot be started.
    judge("another cloud", { codes: ended.includes("internal") ? ["internal", "load"] : [], sure: false }, await other);
  }
  await cloud.dispose();
  judge(
    "a request after dispose()",
    { codes: ["disposed", "internal"], sure: true },
    await outcomeOf(() => cloud.append(MORE)),
  );
}

/** Creates a cloud after all events. Its answer must be right. */
async function restarted(placement: object): Promise<void> {
  const next = await WorkerPointCloud.create(START, placement);
  const direct = new PointCloud(START);
  const [there, here] = [await next.visibleFrom([0, 0, 5]), direct.visibleFrom([0, 0, 5])];
  require(there.indices.join() === here.indices.join() &&
    there.radius === here.radius, "the next cloud answers wrongly");
  direct.dispose();
  await next.dispose();
}
