import { allocating } from "../base/errors.js";
import {
  failedReply,
  type GuestEvents,
  isProgress,
  READY,
  type Replies,
  type Reply,
  type Request,
  type Thread,
} from "./protocol.js";
import { joinThread } from "./shared-thread.js";
import type { SurveyTask } from "../query/surveys.js";
import { hasNodeModules, importNodeModule } from "../base/node.js";

/**
 * Threads that hold the same cloud, each in its own wasm instance. All members make a change, and it is answered when
 * all have answered. A question is answered by the first member. The views of a survey are dealt out.
 */
export class Team {
  readonly #events: GuestEvents;
  #members: Thread[] = [];
  #starting = 0;
  /** The answers by member. A member that was not asked, or has not answered yet, has none. */
  #replies: (Reply | undefined)[] = [];
  #missing = 0;
  /** The share of the request that is done, by member. */
  #progress: number[] = [];
  /** The survey that is being answered. */
  #dealing: Dealing | undefined;

  private constructor(events: GuestEvents) {
    this.#events = events;
  }

  /** Uses its own threads, or else one thread that other teams share. */
  static async start(size: number | "shared", events: GuestEvents): Promise<Team> {
    const team = new Team(events);
    await team.#start(size === "shared" ? 1 : size, size === "shared");
    return team;
  }

  async #start(size: number, shared: boolean): Promise<void> {
    this.#starting = size;
    const starts = Array.from({ length: size }, async () => {
      const own: { thread?: Thread } = {};
      own.thread = await joinThread(shared, {
        message: (message) => {
          this.#message(own.thread, message);
        },
        died: (cause) => {
          this.#events.died(cause);
        },
        hung: () => {
          this.#events.hung();
        },
      });
      return own.thread;
    });
    const settled = await Promise.allSettled(starts);
    this.#members = settled.flatMap((start) => (start.status === "fulfilled" ? [start.value] : []));
    const failed = settled.find((start) => start.status === "rejected");
    if (failed !== undefined) {
      await this.end();
      throw failed.reason;
    }
  }

  /**
   * One reply answers the request, however many members are asked. The arrays in the request are
   * given away.
   */
  post(request: Request): void {
    if (request.kind === "survey") {
      const dealing = new Dealing(request.task, this.#members, (reply) => {
        this.#dealing = undefined;
        this.#events.message(reply);
      });
      this.#dealing = dealing;
      const failed = (thrown: unknown) => {
        this.#dealing = undefined;
        this.#events.message({ thrown } satisfies Reply);
      };
      void request.ready.then(() => {
        if (this.#dealing === dealing) dealing.deal();
      }, failed);
      return;
    }
    const asked = isChange(request) ? this.#members : this.#members.slice(0, 1);
    let copies: { request: Request; transfer: ArrayBuffer[] }[];
    try {
      copies = asked.map((_, number) => copyFor(request, number));
    } catch (thrown) {
      // No member has been asked, so no member has changed.
      queueMicrotask(() => {
        this.#events.message(failedReply(thrown));
      });
      return;
    }
    this.#replies = [];
    this.#missing = asked.length;
    this.#progress = asked.map(() => 0);
    asked.forEach((thread, number) => {
      const { request, transfer } = copies[number]!;
      thread.post(request, transfer);
    });
  }

  /** Gives up the view that is being computed, if it is computed in slices. Its reply says so. */
  abandon(): void {
    this.#members[0]?.post({ kind: "abandon" } satisfies Request, []);
  }

  /** While the team is busy, Node's process does not end. */
  setBusy(busy: boolean): void {
    for (const thread of this.#members) {
      thread.setBusy(busy);
    }
  }

  /** Ends all threads, which frees their memory. After that, nothing is reported. */
  async end(): Promise<void> {
    this.#dealing = undefined;
    await Promise.all(this.#members.map((thread) => thread.end()));
  }

  #message(from: Thread | undefined, message: unknown): void {
    if (message === READY) {
      this.#starting -= 1;
      if (this.#starting === 0) {
        this.#events.message(READY);
      }
      return;
    }
    if (this.#dealing !== undefined && from !== undefined) {
      this.#dealing.reply(from, message as Reply);
      return;
    }
    const number = this.#members.findIndex((thread) => thread === from);
    if (isProgress(message)) {
      this.#progress[number] = message.progress;
      const sum = this.#progress.reduce((sum, share) => sum + share, 0);
      this.#events.message({ progress: sum / this.#progress.length });
      return;
    }
    this.#replies[number] = message as Reply;
    this.#missing -= 1;
    if (this.#missing === 0) {
      this.#events.message(this.#combined());
    }
  }

  #combined(): Reply {
    const replies = this.#replies as Reply[];
    const failures = replies.filter((reply) => "error" in reply);
    const lost = failures.find(({ error }) => error.code === "internal");
    const done = replies.find((reply) => !("error" in reply));
    if (lost !== undefined || done === undefined) {
      return lost ?? replies[0]!;
    }
    // Some members had no memory for the change, and the others have changed. The team goes on without the first ones.
    const isDismissed = (number: number) => replies[number] !== undefined && "error" in replies[number];
    const dismissed = this.#members.filter((_, number) => isDismissed(number));
    this.#members = this.#members.filter((_, number) => !isDismissed(number));
    for (const thread of dismissed) void thread.end();
    return done;
  }
}

/** The requests that concern all members. */
function isChange({ kind }: Request): boolean {
  return kind === "create" || kind === "append" || kind === "remove";
}

/** The request to one member, with its own arrays. */
function copyFor(request: Request, number: number): { request: Request; transfer: ArrayBuffer[] } {
  switch (request.kind) {
    case "create":
    case "append": {
      const positions = ownCopy(request.positions, number);
      return { request: { ...request, positions }, transfer: [positions.buffer as ArrayBuffer] };
    }
    case "remove": {
      const indices = ownCopy(request.indices, number);
      return { request: { ...request, indices }, transfer: [indices.buffer as ArrayBuffer] };
    }
    default:
      return { request, transfer: [] };
  }
}

/** The first member gets the array itself. */
function ownCopy<T extends Float32Array | Float64Array | Uint32Array>(array: T, number: number): T {
  return number === 0
    ? array
    : allocating(`a copy of ${array.length} numbers for each worker`, () => array.slice() as T);
}

/** A refusal. Of several, the one with the lowest place is reported. */
interface Failure {
  place: number;
  reply: Reply;
}

/** Deals the views of a survey out to threads, one at a time each. So none waits for another. */
export class Dealing {
  readonly #task: SurveyTask;
  readonly #done: (reply: Reply) => void;
  #idle: Thread[];
  readonly #running = new Map<Thread, number>();
  #failure: Failure | undefined;

  /** @param done is called with the reply to the survey, at the end. */
  constructor(task: SurveyTask, threads: readonly Thread[], done: (reply: Reply) => void) {
    this.#task = task;
    task.resume();
    this.#idle = [...threads];
    this.#done = done;
  }

  /** Gives each idle thread a view, as long as there are some. */
  deal(): void {
    while (this.#failure === undefined && this.#idle.length > 0) {
      // When all views are asked, no view has a higher number.
      const next = this.#attempt(Infinity, () => this.#task.next(this.#running.size));
      if (next === undefined) break;
      const thread = this.#idle.pop()!;
      this.#running.set(thread, next.number);
      thread.post(next.view satisfies Request, []);
    }
    if (this.#running.size === 0) {
      this.#done(this.#failure?.reply ?? { value: {} });
    }
  }

  /** Takes the reply of a thread. */
  reply(thread: Thread, reply: Reply): void {
    const number = this.#running.get(thread)!;
    this.#running.delete(thread);
    this.#idle.push(thread);
    if ("value" in reply) {
      this.#attempt(number, () => {
        this.#task.take(number, reply.value as Replies["visibleFrom"]);
      });
    } else {
      this.#fail(number, reply);
    }
    this.deal();
  }

  #attempt<T>(number: number, act: () => T): T | undefined {
    try {
      return act();
    } catch (thrown) {
      this.#fail(number, { thrown });
      return undefined;
    }
  }

  /** Keeps the refusal of the first view, as if the views were asked in turn. A lost thread comes before all refusals. */
  #fail(number: number, reply: Reply): void {
    const isLost = "error" in reply && reply.error.code === "internal";
    const place = isLost ? -1 : number;
    if (this.#failure === undefined || place < this.#failure.place) this.#failure = { place, reply };
  }
}

/** More workers would only wait for memory, and each of them holds the whole cloud. */
export const MAX_WORKERS = 64;
/** For fewer points, a second worker gains too little. */
const CROSSOVER = 200_000;
/** The largest number of points by default, summed over the copies of all workers. */
const MAX_DEFAULT_POINTS = 16_000_000;

/** How many workers gain something when they share many views of a cloud with this number of points. */
export async function defaultWorkers(points: number): Promise<number> {
  if (points < CROSSOVER) {
    return 1;
  }
  const fit = Math.floor(MAX_DEFAULT_POINTS / points);
  return Math.max(1, Math.min(await cores(), MAX_WORKERS, fit));
}

async function cores(): Promise<number> {
  const { navigator } = globalThis as { navigator?: { hardwareConcurrency?: unknown } };
  const count = navigator?.hardwareConcurrency;
  if (typeof count === "number" && count >= 1) {
    return Math.floor(count);
  }
  if (hasNodeModules()) {
    const os = await importNodeModule<typeof import("node:os")>("node:os");
    return os.availableParallelism();
  }
  return 1;
}
