import type { Answers, Query } from "../query/queries.js";
import { HprError, type HprErrorCode } from "../base/errors.js";
import type { CloudSettings, CloudSize } from "../query/options.js";
import type { SurveyTask } from "../query/surveys.js";

/**
 * The messages between the page and its worker. First, the worker says `"ready"` once. While it computes, it
 * says `"beat"` about every half second. After `"ready"`, each request about a cloud gets one reply, and the next request about that cloud is sent only
 * after the reply. The first request is `create`. The last one is `forget`, and nobody waits for
 * its reply.
 */
export type Request =
  | {
      kind: "create";
      module: WebAssembly.Module;
      positions: Float32Array | Float64Array;
      settings: CloudSettings;
      /** Whether to send `Progress` before the reply. */
      reporting: boolean;
    }
  | { kind: "append"; positions: Float32Array | Float64Array }
  | { kind: "remove"; indices: Uint32Array }
  | { kind: "forget" }
  /**
   * Gives up the view that is being computed, if it can be given up. This has no reply of its own.
   * It is the only letter that may come before the reply to the request before.
   */
  | { kind: "abandon" }
  /**
   * Asks many views as soon as the page is `ready`. The team deals them out to its members, so this is never sent to a
   * worker.
   */
  | { kind: "survey"; task: SurveyTask; ready: Promise<void> }
  /** With `sliced`, a view is computed in slices, so that it can be given up. */
  | (Query & { sliced?: boolean });

/** The value of a reply, by the kind of its request. */
export interface Replies extends Answers {
  create: CloudSize;
  append: CloudSize;
  remove: CloudSize;
  forget: object;
  abandon: object;
  survey: object;
}

/** Whether the worker replies to a request. */
export function isReplied({ kind }: Request): boolean {
  return kind !== "abandon" && kind !== "forget";
}

export type Reply<Value = unknown> =
  | { value: Value }
  | { error: { code: HprErrorCode; message: string } }
  // An error on this side, not of the worker.
  | { thrown: unknown }
  // Nobody waits for the answer any more.
  | { abandoned: true };

/** A request or a reply, with the cloud that it is about: several clouds may share a worker. */
export interface Letter<Content = unknown> {
  cloud: number;
  content: Content;
}

export const READY = "ready";
/** A sign of life, in the middle of a computation. */
export const BEAT = "beat";

/** The share of a request that is done, from 0 to 1. */
export interface Progress {
  progress: number;
}

export function isProgress(message: unknown): message is Progress {
  return typeof message === "object" && message !== null && "progress" in message;
}

/** An error in a form that can be sent to the page: sending would lose its class. */
export function failedReply(thrown: unknown): Reply<never> {
  const code = thrown instanceof HprError ? thrown.code : "internal";
  return { error: { code, message: thrown instanceof Error ? thrown.message : String(thrown) } };
}

/** What a thread reports. After `died` or `hung` it reports nothing more. */
export interface ThreadEvents {
  message(message: unknown): void;
  died(cause: unknown): void;
}

/** What the user of a thread hears besides. */
export interface GuestEvents extends ThreadEvents {
  /** The thread owes a reply and has given no sign of life for long. It is ended. */
  hung(): void;
}

/** A worker of the browser or of Node, behind one interface. */
export interface Thread {
  post(message: unknown, transfer: ArrayBuffer[]): void;
  /** While the thread is busy, Node's process does not end. */
  setBusy(busy: boolean): void;
  /** Ends the thread, which frees its memory. After that, nothing is reported. */
  end(): Promise<void>;
}
