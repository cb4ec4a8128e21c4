import { HprError, type HprErrorCode } from "../errors.js";
import type { CloudSettings, ViewSettings } from "../options.js";
import type { ChosenRadius } from "../visibility.js";

/**
 * What the page and its worker say to each other. The worker says `"ready"`
 * once; after that, every request gets one reply before the next is sent. The
 * first request is `create`: a worker holds one cloud.
 */
export type Request =
  | {
      kind: "create";
      module: WebAssembly.Module;
      positions: Float32Array | Float64Array;
      settings: CloudSettings;
    }
  | { kind: "visibleFrom"; viewpoint: Viewpoint; settings: ViewSettings; sector?: Sector }
  | { kind: "autoRadius"; viewpoint: Viewpoint }
  | { kind: "append"; positions: Float32Array | Float64Array }
  | { kind: "remove"; indices: Uint32Array };

export type Viewpoint = [x: number, y: number, z: number];

/** Which part of a view is asked for, where several workers share it: number 0 to count − 1. */
export interface Sector {
  number: number;
  count: number;
}

/** `length` and `skipped` of a cloud. */
export interface CloudSize {
  length: number;
  skipped: number;
}

/** The value of a reply, by the kind of its request. */
export interface Replies {
  create: CloudSize;
  /** With the length of the cloud that was asked; it may grow while this is on its way. */
  visibleFrom: ChosenRadius & { indices: Uint32Array; length: number };
  autoRadius: ChosenRadius;
  append: CloudSize;
  remove: CloudSize;
}

export type Reply<Value = unknown> =
  | { value: Value }
  | { error: { code: HprErrorCode; message: string } };

export const READY = "ready";

/** An error as it crosses the border, where its class would be lost. */
export function failedReply(thrown: unknown): Reply<never> {
  const code = thrown instanceof HprError ? thrown.code : "internal";
  return { error: { code, message: thrown instanceof Error ? thrown.message : String(thrown) } };
}
