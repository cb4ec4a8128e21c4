import { describe, HprError } from "../base/errors.js";

type Name<Events> = Extract<keyof Events, string>;

/** Sends events to listeners, as the `EventDispatcher` of three does, which not every viewer has. */
export class Events<Contents extends object> {
  readonly #listeners = new Map<string, unknown[]>();

  /**
   * Calls the listener with each event of that type.
   *
   * @throws HprError `option` for what is no function.
   */
  addEventListener<T extends Name<Contents>>(
    type: T,
    listener: (event: Contents[T] & Readonly<Record<"type", T> & Record<"target", this>>) => void,
  ): void {
    if (typeof listener !== "function") {
      throw new HprError("option", `a listener must be a function, got ${describe(listener)}`);
    }
    if (!this.hasEventListener(type, listener)) {
      this.#listeners.set(type, [...(this.#listeners.get(type) ?? []), listener]);
    }
  }

  /** Whether the listener is called with the events of that type. */
  hasEventListener<T extends Name<Contents>>(
    type: T,
    listener: (event: Contents[T] & Readonly<Record<"type", T> & Record<"target", this>>) => void,
  ): boolean {
    return this.#listeners.get(type)?.includes(listener) === true;
  }

  /** Stops calling the listener. */
  removeEventListener<T extends Name<Contents>>(
    type: T,
    listener: (event: Contents[T] & Readonly<Record<"type", T> & Record<"target", this>>) => void,
  ): void {
    this.#listeners.set(type, this.#listeners.get(type)?.filter((one) => one !== listener) ?? []);
  }

  /** Whether events of that type have a listener. @internal */
  protected hears(type: Name<Contents>): boolean {
    return (this.#listeners.get(type)?.length ?? 0) > 0;
  }

  /** @internal */
  protected send<T extends Name<Contents>>(type: T, content: Contents[T]): void {
    const listeners = (this.#listeners.get(type) ?? []) as ((event: object) => void)[];
    for (const listener of listeners) listener.call(this, { ...content, type, target: this });
  }
}

/** A promise that is settled from outside, once. */
export class Readiness {
  readonly promise: Promise<void>;
  #settle!: { resolve: () => void; reject: (error: Error) => void };
  #isSettled = false;

  constructor() {
    this.promise = new Promise((resolve, reject) => {
      this.#settle = { resolve, reject };
    });
  }

  resolve(): void {
    this.#isSettled = true;
    this.#settle.resolve();
  }

  /**
   * Rejects the promise. If nobody hears of the error in another way (`isTold`), it becomes an
   * unhandled rejection, even if the promise is settled already.
   */
  reject(error: Error, isTold: boolean): void {
    if (isTold) {
      this.promise.catch(() => undefined);
    } else if (this.#isSettled) {
      void Promise.reject(error);
    }
    this.#isSettled = true;
    this.#settle.reject(error);
  }
}
