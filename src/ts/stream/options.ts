import { type MergeOptions, mergeSettings } from "../cloud/merge.js";
import { flag, givenOptions, integer, listener, pick } from "../query/options.js";
import { readViewpoint } from "../query/positions.js";
import type { ResolvedInversion } from "../query/view-options.js";
import { readSignal } from "../worker/abort.js";
import type { Fetch, Network } from "./remote.js";
import { compiler } from "../files/wasm.js";
import type { CompileFiles } from "../formats/wasm.js";
import type { InitInput } from "../instance/compile.js";

/** How an octree is read. */
export interface OctreeOptions {
  /** Fetches addresses, for instance with a token in the headers. Default: the platform's `fetch`. */
  fetch?: Fetch | undefined;
  /** The wasm that decompresses COPC, if files.wasm of the package cannot be found: its address or its bytes. */
  wasm?: InitInput | undefined;
  /** Whether the colors of the points are read, too, if the octree has colors. Default false. */
  colors?: boolean | undefined;
  /** The most points that are kept in memory after they were read. Default 4,000,000 (96 MB, with colors 120 MB). */
  cache?: number | undefined;
  /** How often a request to an address is repeated after an answer 429 or 5xx or a broken connection. Default 3. */
  retries?: number | undefined;
  /** After this number of milliseconds without a byte, a request to an address is given up. Default 30,000. */
  timeout?: number | undefined;
}

/** How the visible points of an octree are computed. */
export interface OctreeViewOptions {
  /** R of the flipping sphere, in the cloud's units: at least the distance of the farthest point. */
  radius?: number | undefined;
  /**
   * The inversion, with numbers. Without it and without a radius, it is exponential, and its scale comes
   * from the spacing of the cloud, as with `{ exponential: "auto" }`. The answer records it.
   */
  inversion?: ResolvedInversion | { exponential: "auto" } | undefined;
  /**
   * The most points that may be held for this view at once: those that may be visible, and the points
   * of the nodes that are being read. When they do not suffice, the answer is not exact, and says how
   * many nodes are undecided. Default 4,000,000.
   */
  budget?: number | undefined;
  /** The most nodes that are fetched at the same time. Default 6. */
  requests?: number | undefined;
  /** Ends the view. The iteration then throws an `AbortError`. */
  signal?: AbortSignal | undefined;
  /** Is called after each node. */
  onProgress?: ((progress: OctreeProgress) => void) | undefined;
}

/** How far a view is. */
export interface OctreeProgress {
  /** The nodes whose points were taken up. */
  read: number;
  /** The nodes that are hidden, so that they are not needed. */
  hidden: number;
  /** The number of bytes of points that were fetched for this view. */
  bytes: number;
}

export interface OctreeSettings extends Network {
  wasm: CompileFiles;
  colors: boolean;
  cache: number;
}

export interface ViewRequest {
  viewpoint: readonly number[];
  /** Undefined for the automatic inversion. */
  merge: MergeOptions | undefined;
  budget: number;
  requests: number;
  signal: AbortSignal | undefined;
  onProgress: (progress: OctreeProgress) => void;
}

const MANY = 4_000_000;
const MOST_POINTS = 2 ** 28;
const MOST_REQUESTS = 64;
const MOST_RETRIES = 100;
/** The longest time that timers take. */
const LONGEST_TIMEOUT = 2 ** 31 - 1;

export function octreeSettings(options: unknown): OctreeSettings {
  const given = givenOptions(options, ["fetch", "wasm", "colors", "cache", "retries", "timeout"]);
  listener(given, "fetch");
  return {
    // Called without an object: the platform's own fetch refuses any other.
    fetch: (url, init) => ((given["fetch"] ?? fetch) as Fetch)(url, init),
    wasm: compiler(given["wasm"]),
    colors: flag(given, "colors"),
    cache: integer(given, "cache", 0, MOST_POINTS) ?? MANY,
    retries: integer(given, "retries", 0, MOST_RETRIES) ?? 3,
    timeout: integer(given, "timeout", 1, LONGEST_TIMEOUT) ?? 30_000,
  };
}

export function viewRequest(viewpoint: unknown, options: unknown): ViewRequest {
  const given = givenOptions(options, ["radius", "inversion", "budget", "requests", "signal", "onProgress"]);
  return {
    viewpoint: readViewpoint(viewpoint, 3),
    merge: mergeOptions(pick(given, ["radius", "inversion"])),
    budget: integer(given, "budget", 1, MOST_POINTS) ?? MANY,
    requests: integer(given, "requests", 1, MOST_REQUESTS) ?? 6,
    signal: readSignal(given["signal"]),
    onProgress: (listener(given, "onProgress") as ViewRequest["onProgress"] | undefined) ?? (() => undefined),
  };
}

/** The inversion that is asked for, checked before anything is read. Undefined for the automatic one. */
function mergeOptions(given: Record<string, unknown>): MergeOptions | undefined {
  const { radius, inversion } = given;
  const isAutomatic = (inversion as { exponential?: unknown } | undefined)?.exponential === "auto";
  if (radius === undefined && (inversion === undefined || isAutomatic)) {
    return undefined;
  }
  const merge = { ...(radius !== undefined && { radius }), ...(inversion !== undefined && { inversion }) };
  mergeSettings(merge, "the whole octree is seen with");
  return merge as MergeOptions;
}
