import type { Cloud } from "../cloud/cloud.ts";
import type { Content } from "../../src/ts/formats/write/content.js";

export { BATCH } from "../../src/ts/formats/write/content.js";

/** Joins pieces into a file that the browser saves. Between the pieces, the page continues to draw. */
export async function save(name: string, parts: Iterable<BlobPart>): Promise<void> {
  const done: Blob[] = [];
  for (const part of parts) {
    // Each piece is its own Blob: text is encoded here, and encoding megabytes at once would stop the page.
    done.push(new Blob([part]));
    await new Promise((resolve) => setTimeout(resolve));
  }
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob(done));
  link.download = name;
  link.click();
  // By then the browser has begun to read it.
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}

/** The numbers of a cloud for a file. Its colors are in bytes, as most programs expect them. */
export function contentOf({ colors, fields }: Cloud): Pick<Content, "colors" | "fields"> {
  return { colors, fields: fields.filter(({ name }) => !colors || !/^(red|green|blue)$/.test(name)) };
}

/** The beginning of the name of a file that is saved: the name of the cloud, without its ending and without signs. */
export function stemOf(name: string): string {
  const stem = name
    .toLowerCase()
    .replace(/\.\w{1,4}$/, "")
    .replace(/[^\p{L}\p{N}]+/gu, "-")
    .replace(/^-+|-+$/g, "");
  return stem || "cloud";
}

/** Copies a text. Returns `false` if the browser refuses: the connection is not secure, or the user forbids it. */
export async function copy(text: string): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    return false;
  }
}
