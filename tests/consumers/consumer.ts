/** What a consumer says is visible, in its own thread and through the worker entry. */
export interface Answered {
  here?: number[];
  there?: number[];
  error?: string;
}

/** One way in which the package is used. */
export interface Consumer {
  name: string;
  /** Of what builds or runs it. */
  version: string;
  /** Why it cannot be run here, if so. */
  lacking?: string;
  run: () => Promise<Answered>;
}

/** How a page's answer is read: opens the address and waits for its `<output>`. */
export type Visit = (address: string) => Promise<Answered>;
