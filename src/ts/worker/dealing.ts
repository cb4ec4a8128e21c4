import type { SurveyTask } from "../query/surveys.js";
import { type Replies, type Reply, type Request } from "./protocol.js";
import type { Thread } from "./thread.js";

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
