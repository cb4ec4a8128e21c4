import type { Reading } from "./cloud-file.js";
import { FormatProblem } from "./problem.js";
import { bytesSource, type Source, wholeFile } from "./source.js";
import { looksBinary } from "./text.js";

/** The text of a file in UTF-8. Some spreadsheets export text with two bytes for each character. */
export async function textOf({ source, records }: Reading): Promise<Source> {
  const start = await source.read(0, 4096);
  const encoding = encodingOf(start);
  if (encoding === "utf-8") {
    if (looksBinary(start)) throw new FormatProblem("it is not text");
    return source;
  }
  // The bytes of points cannot be taken from text in another encoding.
  if (records) throw new FormatProblem("it is text in UTF-16; save it in UTF-8");
  return bytesSource(new TextEncoder().encode(new TextDecoder(encoding).decode(await wholeFile(source))));
}

/** The encoding by the byte order mark. */
function encodingOf([first, second]: Uint8Array): "utf-8" | "utf-16le" | "utf-16be" {
  if (first === 0xff && second === 0xfe) return "utf-16le";
  return first === 0xfe && second === 0xff ? "utf-16be" : "utf-8";
}
