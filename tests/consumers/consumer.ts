/** The indices that a consumer finds visible, in its own thread and through the worker entry. */
export interface Answered {
  here?: number[];
  there?: number[];
  error?: string;
}

/** One way in which the package is used. */
export interface Consumer {
  name: string;
  /** The version of the program that builds or runs it. */
  version: string;
  /** Only `npm run consumers` runs it: it is slow, or similar to another consumer. */
  further?: true;
  /** Why it cannot run here, if it cannot. */
  lacking?: string;
  /** The lines that a user must write besides `init()`, as docs/BUNDLERS.md has them. */
  glue?: readonly string[];
  /** Installs what it needs into a folder of its own, and returns the folder. */
  prepare?: () => string;
  /** Builds and asks. Gets the folder, if there is one. */
  run: (folder: string) => Promise<Answered>;
}

/** Reads the answer of a page: opens the address and waits for its `<output>`. */
export type Visit = (address: string) => Promise<Answered>;
