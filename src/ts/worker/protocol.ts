import type { Answers, Found } from "../query/answers.js";
import { HprError, type HprErrorCode } from "../base/errors.js";
import type { CloudSettings, CloudSize } from "../query/options.js";
import type { Query } from "../query/queries.js";

/**
 * What the page and its worker say to each other. The worker says `"ready"` once. After
 * that, every request about a cloud gets one reply before the next about it is sent; the
 * first is `create`, and `forget` the last, whose reply nobody awaits.
 */
export type Request =
  | {
      kind: "create";
      module: WebAssembly.Module;
      positions: Float32Array | Float64Array;
      settings: CloudSettings;
      /** Whether `Progress` is wanted before the reply. */
      reporting: boolean;
    }
  | { kind: "append"; positions: Float32Array | Float64Array }
  | { kind: "remove"; indices: Uint32Array }
  | { kind: "forget" }
  /** With memory for the answer's indices, where there is some; `listing`: hidden points' after them (see `hidden.ts`). */
  | (Query & { spare?: ArrayBuffer | undefined; listing?: boolean });

/** The value of a reply, by the kind of its request. */
export interface Replies extends Answers {
  create: CloudSize;
  append: CloudSize;
  remove: CloudSize;
  forget: object;
}

type KindWithIndices = { [Kind in keyof Replies]: Replies[Kind] extends Found ? Kind : never }[keyof Replies];

/** The kinds of requests whose replies have indices, which may be written into spare memory: all of them, and no other. */
export const WITH_INDICES: Readonly<Record<KindWithIndices, true>> = {
  visibleFrom: true,
  visibleFromDirection: true,
  visibleFromSeveral: true,
  reconstruct: true,
};

export type Reply<Value = unknown> = { value: Value } | { error: { code: HprErrorCode; message: string } };

/** A request or a reply, with the cloud that it is about: several may share a worker. */
export interface Letter<Content = unknown> {
  cloud: number;
  content: Content;
}

export const READY = "ready";

/** Which share of a request is done, from 0 to 1. */
export interface Progress {
  progress: number;
}

export function isProgress(message: unknown): message is Progress {
  return typeof message === "object" && message !== null && "progress" in message;
}

/** An error as it crosses the border, where its class would be lost. */
export function failedReply(thrown: unknown): Reply<never> {
  const code = thrown instanceof HprError ? thrown.code : "internal";
  return { error: { code, message: thrown instanceof Error ? thrown.message : String(thrown) } };
}
