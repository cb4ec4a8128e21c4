import { allocating } from "../base/memory.js";
import type { Query } from "../query/queries.js";
import { Dealing } from "./dealing.js";
import { failedReply, isProgress, READY, type Reply, type Request } from "./protocol.js";
import { type Part, Sectors } from "./sectors.js";
import { joinThread } from "./shared-thread.js";
import type { GuestEvents, Thread } from "./thread.js";

/**
 * Threads that hold the same cloud, each in its own wasm instance, and act as one. A request to the
 * team is a request to all members, and is answered when all have answered. A view is divided among
 * the members by direction, so that no member waits for another. Every visible point is in the
 * answer of exactly one member.
 */
export class Team {
  readonly #events: GuestEvents;
  #members: Thread[] = [];
  #starting = 0;
  readonly #sectors = new Sectors();
  #asked: Request | undefined;
  /** The view that the last request asked for as a draft. The first member may go on from it. */
  #drafted: string | undefined;
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
          // The team needs all of its members: each answers only its part of a view.
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
      this.#drafted = undefined;
      const dealing = new Dealing(request.task, this.#members, (reply) => {
        this.#dealing = undefined;
        this.#events.message(reply);
      });
      this.#dealing = dealing;
      queueMicrotask(() => {
        dealing.deal();
      });
      return;
    }
    let copies: { request: Request; transfer: ArrayBuffer[] }[];
    const isDivided = isForAll(request) && !this.#goesOn(request);
    const asked = isDivided ? this.#members : this.#members.slice(0, 1);
    this.#drafted = isDraft(request) ? viewOf(request) : undefined;
    try {
      copies = asked.map((_, number) => copyFor(request, number, asked.length, this.#sectors));
    } catch (thrown) {
      // No member has been asked, so no member has changed.
      queueMicrotask(() => {
        this.#events.message(failedReply(thrown));
      });
      return;
    }
    this.#asked = request;
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

  /**
   * Whether the first member alone should go on from its draft of the same view. A draft is a third
   * of the work. So this is as fast as two members that start from nothing.
   */
  #goesOn(request: Request): boolean {
    if (this.#members.length > 2 || request.kind !== "visibleFrom" || request.settings.mask !== undefined) {
      return false;
    }
    return this.#drafted === viewOf(request);
  }

  #combined(): Reply {
    const replies = this.#replies as Reply[];
    if (replies.length === 1) {
      this.#asked = undefined;
      return replies[0]!;
    }
    const failures = replies.filter((reply) => "error" in reply);
    const values = replies.flatMap((reply) => ("value" in reply ? [reply.value] : []));
    const lost = failures.find(({ error }) => error.code === "internal") ?? failures[0];
    const asked = this.#asked;
    this.#asked = undefined;
    if (lost !== undefined) {
      const isChange = asked?.kind === "append" || asked?.kind === "remove";
      if (!isChange || lost.error.code === "internal" || values.length === 0) {
        return lost;
      }
      // Some members had no memory for the change, and the others have changed. The team goes on
      // without the first ones.
      this.#dismiss((_, number) => "error" in replies[number]!);
    }
    try {
      const isView = asked?.kind === "visibleFrom" || asked?.kind === "visibleFromCamera";
      return { value: isView ? this.#sectors.joined(values as Part[], asked.spare) : values[0] };
    } catch (thrown) {
      return failedReply(thrown);
    }
  }

  #dismiss(isDismissed: (thread: Thread, number: number) => boolean): void {
    const dismissed = this.#members.filter(isDismissed);
    this.#members = this.#members.filter((thread) => !dismissed.includes(thread));
    for (const thread of dismissed) {
      void thread.end();
    }
  }
}

/**
 * Changes concern all members, and so do views that can be divided. Any other request can be
 * answered by one member.
 */
function isForAll(request: Request): boolean {
  switch (request.kind) {
    case "create":
    case "append":
    case "remove":
      return true;
    case "visibleFrom":
    case "visibleFromCamera":
      return request.divisible;
    default:
      return false;
  }
}

function isDraft(request: Request): request is Query<"visibleFrom"> {
  return request.kind === "visibleFrom" && request.settings.draft && request.settings.mask === undefined;
}

/** The same text for a view and for its draft. */
function viewOf({ viewpoint, settings }: Query<"visibleFrom">): string {
  return JSON.stringify([viewpoint, { ...settings, draft: false }]);
}

/** The request to one member: with its own arrays, and with its sector of a view. */
function copyFor(
  request: Request,
  number: number,
  count: number,
  sectors: Sectors,
): { request: Request; transfer: ArrayBuffer[] } {
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
    case "forget":
    case "abandon":
    case "survey":
      return { request, transfer: [] };
    case "visibleFrom":
    case "visibleFromCamera":
      if (count > 1) {
        const spare = sectors.spareFor(number);
        return {
          request: { ...request, sector: { number, count }, spare, sliced: false },
          transfer: listed(spare),
        };
      }
      return { request, transfer: listed(request.spare) };
    default:
      return { request, transfer: listed(request.spare) };
  }
}

/** The first member gets the array itself. */
function ownCopy<T extends Float32Array | Float64Array | Uint32Array>(array: T, number: number): T {
  return number === 0
    ? array
    : allocating(`a copy of ${array.length} numbers for each worker`, () => array.slice() as T);
}

function listed(buffer: ArrayBuffer | undefined): ArrayBuffer[] {
  return buffer === undefined ? [] : [buffer];
}
