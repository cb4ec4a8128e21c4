import type { LoadRequest } from "../loaders/index.ts";
import type { Sample } from "../samples/samples.ts";

/** What reading a file may leave out. */
export interface FileOptions {
  skipNonFinite: boolean;
  /** How many points of it are shown at most. */
  limit?: number;
}

/** The bytes of a sample lie beside the page, or beside the element's module: `base` is the address of either. */
export function requestForSample({ label, from }: Sample, base: string): LoadRequest {
  return "file" in from
    ? { kind: "sample", name: label, url: new URL(from.file, base).href }
    : { kind: "shape", name: label, shape: from.generator };
}

/** A file on the web. A text that is not an address is kept unchanged: its download fails with a clear message. */
export function requestForAddress(text: string, options: FileOptions): LoadRequest {
  const url = addressOf(text);
  return { kind: "url", name: nameOf(text), url: url?.href ?? text, ...options };
}

/** As the page around reads it; `null` for a text that is no address. */
export function addressOf(text: string): URL | null {
  return URL.canParse(text, document.baseURI) ? new URL(text, document.baseURI) : null;
}

/** What a sentence calls a file on the web. */
export function nameOf(text: string): string {
  return addressOf(text)?.pathname.split("/").pop() || text;
}
