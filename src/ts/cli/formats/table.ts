import type { CloudFile } from "../../formats/cloud-file.js";
import { markLength } from "../../formats/text.js";
import type { Frame } from "./point-file.js";

/** XYZ, TXT, CSV and PTS: one point per line. The lines above the first point are kept. */
export function tableFrame(file: Buffer, { records }: CloudFile): Frame {
  // In Latin-1, which keeps every byte.
  const start = records.start(0);
  const head = start > markLength(file) ? file.toString("latin1", 0, start) : "";
  return { header: ({ length }) => Buffer.from(withCount(head, length), "latin1") };
}

/** The head with another number in the line that holds only the number of points. */
function withCount(head: string, count: number): string {
  return head.replace(/(^|[\r\n])([ \t\v\f]*)\d+(?=[ \t\v\f]*([\r\n]|$))/, `$1$2${count}`);
}
