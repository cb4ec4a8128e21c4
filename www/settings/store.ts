import type { Settings } from "./settings.ts";

type Listener = (now: Settings, before: Settings) => void;

/** The present settings. Each change makes a new object. So if a value is the same object, it is unchanged. */
export class Store {
  #settings: Settings;
  readonly #listeners: Listener[] = [];

  constructor(settings: Settings) {
    this.#settings = settings;
  }

  get current(): Settings {
    return this.#settings;
  }

  change(part: Partial<Settings>): void {
    const before = this.#settings;
    this.#settings = { ...before, ...part };
    for (const listener of this.#listeners) listener(this.#settings, before);
  }

  /** Calls the listener with the settings now, and at every change from now on. */
  follow(listener: Listener): void {
    this.#listeners.push(listener);
    listener(this.#settings, this.#settings);
  }
}
