type Name<Events> = Extract<keyof Events, string>;

/** Sends events to listeners, as the `EventDispatcher` of three does, which not every viewer has. */
export class Events<Contents extends object> {
  readonly #listeners = new Map<string, unknown[]>();

  /** Calls the listener with each event of that type. */
  addEventListener<T extends Name<Contents>>(
    type: T,
    listener: (event: Contents[T] & Readonly<Record<"type", T> & Record<"target", this>>) => void,
  ): void {
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
