import { FormatProblem } from "../problem.js";

/** The part that is used of laz-perf, the LAZ decoder of hobu (Apache 2.0). `createLazPerf()` of its package makes it. */
export interface LazPerf {
  /** If the memory has grown, this is another array. */
  readonly HEAPU8: Uint8Array;
  /** Takes memory of the decoder. */
  _malloc(bytes: number): number;
  /** Gives it back. */
  _free(pointer: number): void;
  ChunkDecoder: new () => {
    /** Begins with a chunk of compressed points. */
    open(format: number, recordLength: number, pointer: number): void;
    /** Writes the next point to an address. */
    getPoint(pointer: number): void;
    /** Ends the decoder. */
    delete(): void;
  };
}

/** How the points of a chunk are stored. */
export interface ChunkLayout {
  format: number;
  /** The number of bytes of a point. */
  rowBytes: number;
}

/** The number of points that are decompressed before they are taken. */
const BATCH = 4096;

/** Decompresses a chunk of points. `take` gets a view with the bytes of each point at a place. */
export function decodeChunk(
  perf: LazPerf,
  chunk: Uint8Array,
  count: number,
  { format, rowBytes }: ChunkLayout,
  take: (view: DataView, at: number) => void,
): void {
  const from = perf._malloc(chunk.length);
  const to = perf._malloc(BATCH * rowBytes);
  if (from === 0 || to === 0) throw new FormatProblem(`laz-perf has no memory for ${chunk.length} bytes`);
  const decoder = new perf.ChunkDecoder();
  perf.HEAPU8.set(chunk, from);
  decoder.open(format, rowBytes, from);
  for (let first = 0; first < count; first += BATCH) {
    const batch = Math.min(BATCH, count - first);
    for (let row = 0; row < batch; row++) decoder.getPoint(to + row * rowBytes);
    // If the memory has grown, its buffer has been replaced.
    const view = new DataView(perf.HEAPU8.buffer, to, batch * rowBytes);
    for (let row = 0; row < batch; row++) take(view, row * rowBytes);
  }
  // After an error the whole decoder is given up, so its memory need not be freed.
  decoder.delete();
  perf._free(from);
  perf._free(to);
}

let started: Promise<LazPerf> | undefined;

/** The decoder for all files that come without one. It needs the optional package laz-perf. */
export function sharedLazPerf(): Promise<LazPerf> {
  return (started ??= startLazPerf());
}

/** Gives up a decoder after an error: its memory may be damaged. */
export function forgetLazPerf(): void {
  started = undefined;
}

async function startLazPerf(): Promise<LazPerf> {
  // TypeScript must not look for it: its types need those of Emscripten.
  const name: string = "laz-perf";
  let found: { createLazPerf: (options: object) => Promise<LazPerf> };
  try {
    found = (await import(name)) as typeof found;
  } catch (cause) {
    started = undefined;
    throw new FormatProblem("LAZ and COPC need the package laz-perf: npm install laz-perf", { cause });
  }
  return withoutListeners(() => found.createLazPerf({ print: () => undefined, printErr: () => undefined }));
}

/** The decoder listens to all uncaught errors of the process, which are not its own. */
async function withoutListeners<T>(start: () => Promise<T>): Promise<T> {
  const { process: node } = globalThis as { process?: Partial<NodeJS.Process> };
  const events = ["uncaughtException", "unhandledRejection"] as const;
  const before = events.map((event) => node?.listeners?.(event as "exit") ?? []);
  const result = await start();
  events.forEach((event, i) => {
    for (const listener of node?.listeners?.(event as "exit") ?? []) {
      if (!before[i]!.includes(listener)) node!.removeListener!(event, listener);
    }
  });
  return result;
}
