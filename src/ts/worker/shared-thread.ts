import { type Letter, READY } from "./protocol.js";
import { startThread } from "./start-thread.js";
import type { Thread, ThreadEvents } from "./thread.js";

/**
 * A thread in which several clouds live. Each cloud uses it like a thread of its own. The thread
 * ends when the last cloud has left, because only its end frees the memory.
 */
class SharedThread implements ThreadEvents {
  readonly #guests = new Map<number, Guest>();
  #thread: Thread | undefined;
  #ready = false;
  #over = false;
  #next = 0;
  readonly #closed: () => void;

  private constructor(closed: () => void) {
    this.#closed = closed;
  }

  static async start(closed: () => void): Promise<SharedThread> {
    const shared = new SharedThread(closed);
    shared.#thread = await startThread(shared);
    return shared;
  }

  get over(): boolean {
    return this.#over;
  }

  join(events: ThreadEvents): Thread {
    const number = this.#next++;
    this.#guests.set(number, { events, busy: false });
    if (this.#ready) {
      queueMicrotask(() => this.#guests.get(number)?.events.message(READY));
    }
    return {
      post: (content, transfer) => {
        this.#thread?.post({ cloud: number, content } satisfies Letter, transfer);
      },
      setBusy: (busy) => {
        this.#setBusy(number, busy);
      },
      end: () => this.#leave(number),
    };
  }

  message(message: unknown): void {
    if (message === READY) {
      this.#ready = true;
      for (const { events } of this.#present()) {
        events.message(READY);
      }
      return;
    }
    const { cloud, content } = message as Letter;
    // Nobody waits for the last reply to a cloud that has left.
    this.#guests.get(cloud)?.events.message(content);
  }

  died(cause: unknown): void {
    if (this.#over) {
      return;
    }
    this.#over = true;
    this.#closed();
    for (const { events } of this.#present()) {
      events.died(cause);
    }
  }

  /** A copy of the present list: a cloud may leave while it is told something. */
  #present(): Guest[] {
    return [...this.#guests.values()];
  }

  #setBusy(number: number, busy: boolean): void {
    const guest = this.#guests.get(number);
    if (guest !== undefined) {
      guest.busy = busy;
    }
    this.#thread?.setBusy(this.#present().some((other) => other.busy));
  }

  async #leave(number: number): Promise<void> {
    if (!this.#guests.delete(number)) {
      return;
    }
    if (this.#guests.size > 0 && !this.#over) {
      this.#thread?.post({ cloud: number, content: { kind: "forget" } } satisfies Letter, []);
      this.#setBusy(number, false);
      return;
    }
    if (!this.#over) {
      this.#over = true;
      this.#closed();
    }
    await this.#thread?.end();
  }
}

interface Guest {
  events: ThreadEvents;
  busy: boolean;
}

let common: Promise<SharedThread> | undefined;

/** A place in a thread: in a thread of its own, or in the shared thread. */
export async function joinThread(shared: boolean, events: ThreadEvents): Promise<Thread> {
  if (!shared) {
    return (await SharedThread.start(() => undefined)).join(events);
  }
  const starting = (common ??= startCommon());
  const thread = await starting;
  // The thread may have ended while this cloud waited.
  return thread.over ? joinThread(shared, events) : thread.join(events);
}

function startCommon(): Promise<SharedThread> {
  const forget = () => {
    if (common === starting) {
      common = undefined;
    }
  };
  const starting = SharedThread.start(forget);
  starting.catch(forget);
  return starting;
}
