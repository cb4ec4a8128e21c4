import type { SurveyTask } from "../query/surveys.js";
import { failedReply, type Replies, type Reply, type Request } from "./protocol.js";
import type { Thread } from "./thread.js";

/** Deals the views of a survey out to threads, one at a time each. So none waits for another. */
export class Dealing {
  readonly #task: SurveyTask;
  readonly #done: (reply: Reply) => void;
  #idle: Thread[];
  readonly #running = new Map<Thread, number>();
  /** The memory of answers that were taken. */
  readonly #spares: ArrayBuffer[] = [];
  #failure: Reply | undefined;

  /** @param done is called with the reply to the survey, at the end. */
  constructor(task: SurveyTask, threads: readonly Thread[], done: (reply: Reply) => void) {
    this.#task = task;
    this.#idle = [...threads];
    this.#done = done;
  }

  /** Gives each idle thread a view, as long as there are some. */
  deal(): void {
    while (this.#failure === undefined && this.#idle.length > 0) {
      const next = this.#attempt(() => this.#task.next(this.#running.size));
      if (next === undefined) break;
      const thread = this.#idle.pop()!;
      const spare = this.#spares.pop();
      const { settings } = this.#task;
      const request = { kind: "visibleFrom", viewpoint: next.viewpoint, settings, divisible: false, spare } as const;
      this.#running.set(thread, next.number);
      thread.post(request satisfies Request, spare === undefined ? [] : [spare]);
    }
    if (this.#running.size === 0) {
      this.#done(this.#failure ?? { value: {} });
    }
  }

  /** Takes the reply of a thread. */
  reply(thread: Thread, reply: Reply): void {
    const number = this.#running.get(thread)!;
    this.#running.delete(thread);
    this.#idle.push(thread);
    if ("value" in reply) {
      const found = reply.value as Replies["visibleFrom"];
      this.#attempt(() => {
        this.#task.take(number, found);
      });
      this.#spares.push(found.indices.buffer);
    } else {
      this.#failure ??= reply;
    }
    this.deal();
  }

  #attempt<T>(act: () => T): T | undefined {
    try {
      return act();
    } catch (thrown) {
      this.#failure ??= failedReply(thrown);
      return undefined;
    }
  }
}
