import { EventDispatcher, type EventListener } from "three";

import { addTag } from "../base/tag.js";

type Name<Events> = Extract<keyof Events, string>;

/**
 * Calls the listeners of events. An error without a listener becomes an unhandled rejection, like
 * the error of any promise that nobody awaits.
 */
export abstract class Reporter<Events extends { error: { error: Error } }> extends EventDispatcher<Events> {
  readonly #heard = new Set<unknown>();

  static {
    addTag(this.prototype, "HiddenPointFilter");
  }

  /** Calls the listener with each event of that type. */
  override addEventListener<T extends Name<Events>>(type: T, listener: EventListener<Events[T], T, this>): void {
    if (type === "error") {
      this.#heard.add(listener);
    }
    super.addEventListener(type, listener);
  }

  /** Stops calling the listener. */
  override removeEventListener<T extends Name<Events>>(type: T, listener: EventListener<Events[T], T, this>): void {
    if (type === "error") {
      this.#heard.delete(listener);
    }
    super.removeEventListener(type, listener);
  }

  /** Whether anybody listens to errors. */
  protected get isHeard(): boolean {
    return this.#heard.size > 0;
  }
}
