import type { PreparedCloud } from "../cloud/cloud.ts";
import type { GeneratorName } from "../samples/generators.ts";

/** What the page asks of the loading worker; one request each. */
export type LoadRequest =
  | { kind: "sample"; name: string; url: string }
  | { kind: "shape"; name: string; shape: GeneratorName }
  | ({ kind: "url"; name: string; url: string } & ReadOptions)
  | ({ kind: "file"; name: string; file: File } & ReadOptions);

interface ReadOptions {
  skipNonFinite: boolean;
  /** Of more points than these, only every so manyth is to be shown. */
  limit?: number;
}

/** What comes back: any number of steps, then the cloud or what was wrong. `fraction` is null where it cannot be known. */
export type LoadReply =
  | { kind: "progress"; step: string; fraction: number | null }
  | { kind: "cloud"; prepared: PreparedCloud }
  | { kind: "problem"; sentence: string; nonFinite: number };
