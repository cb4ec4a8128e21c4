import type { LoadRequest } from "../loaders/index.ts";
import type { Sample } from "../samples/samples.ts";

/** Says which points may be left out when a file is read. */
export interface FileOptions {
  skipNonFinite: boolean;
  /** The largest number of points that are shown. */
  limit?: number;
  /** An octree with more points than this is streamed. Without it, nothing is. */
  streamFrom?: number;
}

/** Sample files lie beside the page, or beside the element's module. `base` is the address of that page or module. */
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

/** The address as the page reads it. `null` for a text that is no address. */
export function addressOf(text: string): URL | null {
  return URL.canParse(text, document.baseURI) ? new URL(text, document.baseURI) : null;
}

/** The name of a file on the web, for use in a sentence. */
export function nameOf(text: string): string {
  return addressOf(text)?.pathname.split("/").pop() || text;
}
