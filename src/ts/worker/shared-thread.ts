import {
  BEAT,
  type GuestEvents,
  isProgress,
  isReplied,
  type Letter,
  READY,
  type Request,
  type Thread,
  type ThreadEvents,
} from "./protocol.js";
import { startThread } from "./start-thread.js";

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
  readonly #pulse = new Pulse(() => {
    this.#hung();
  });

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

  join(events: GuestEvents): Thread {
    const number = this.#next++;
    const guest: Guest = { events, busy: false, owed: 0 };
    this.#guests.set(number, guest);
    if (this.#ready) {
      queueMicrotask(() => this.#guests.get(number)?.events.message(READY));
    }
    return {
      post: (content, transfer) => {
        guest.owed += isReplied(content as Request) ? 1 : 0;
        this.#expect();
        this.#thread?.post({ cloud: number, content } satisfies Letter, transfer);
      },
      setBusy: (busy) => {
        this.#setBusy(number, busy);
      },
      end: () => this.#leave(number),
    };
  }

  message(message: unknown): void {
    this.#pulse.heard();
    if (message === BEAT) {
      return;
    }
    if (message === READY) {
      this.#ready = true;
      for (const { events } of this.#present()) {
        events.message(READY);
      }
      return;
    }
    const { cloud, content } = message as Letter;
    // Nobody waits for the last reply to a cloud that has left.
    const guest = this.#guests.get(cloud);
    if (guest !== undefined) {
      guest.owed -= isProgress(content) ? 0 : 1;
      this.#expect();
      guest.events.message(content);
    }
  }

  died(cause: unknown): void {
    this.#end(({ events }) => {
      events.died(cause);
    });
  }

  #hung(): void {
    this.#end(({ events }) => {
      events.hung();
    });
    void this.#thread?.end();
  }

  #end(tell: (guest: Guest) => void): void {
    if (this.#over) {
      return;
    }
    this.#over = true;
    this.#pulse.expect(false);
    this.#closed();
    this.#present().forEach(tell);
  }

  #expect(): void {
    this.#pulse.expect(!this.#over && this.#present().some(({ owed }) => owed > 0));
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
    this.#expect();
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
  events: GuestEvents;
  busy: boolean;
  /** The number of requests without a reply. */
  owed: number;
}

let common: Promise<SharedThread> | undefined;

/** A place in a thread: in a thread of its own, or in the shared thread. */
export async function joinThread(shared: boolean, events: GuestEvents): Promise<Thread> {
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

/** How often the page looks, in milliseconds. A computing worker says more often that it is alive. */
const TICK = 1000;
/** A worker that owes a reply and is silent for so many ticks has died without a word. */
const SILENT = 20;

/**
 * Notices when a worker that owes a reply says nothing more. It counts ticks of the page's own timer, not the
 * time: while the machine sleeps or the page is throttled, the worker may not run either.
 */
export class Pulse {
  readonly #lost: () => void;
  #ticks = 0;
  #timer: ReturnType<typeof setInterval> | undefined;

  constructor(lost: () => void) {
    this.#lost = lost;
  }

  /** To be called with each message of the worker. */
  heard(): void {
    this.#ticks = 0;
  }

  /** Whether the worker owes a reply from now on. */
  expect(isOwed: boolean): void {
    if (!isOwed) {
      clearInterval(this.#timer);
      this.#timer = undefined;
    } else if (this.#timer === undefined) {
      this.#ticks = 0;
      this.#timer = setInterval(() => {
        this.#tick();
      }, TICK);
      // In Node, the timer must not keep the process alive. The busy worker does.
      (this.#timer as { unref?: () => void }).unref?.();
    }
  }

  #tick(): void {
    this.#ticks += 1;
    if (this.#ticks >= SILENT) {
      this.expect(false);
      this.#lost();
    }
  }
}
