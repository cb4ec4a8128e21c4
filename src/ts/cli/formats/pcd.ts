import type { ChosenColumns } from "../../formats/axes.js";
import type { CloudFile } from "../../formats/cloud-file.js";
import { type PcdHeader, readPcdHeader } from "../../formats/pcd.js";
import type { Frame } from "./point-file.js";

/** PCD: text, binary and compressed. A compressed file is written as plain binary. */
export function pcdFrame(file: Buffer, _: CloudFile, chosen?: ChosenColumns): Frame {
  const header = readPcdHeader(file, chosen);
  return { header: ({ length }) => Buffer.from(headerOf(file, header, length), "latin1") };
}

/** The header for another number of points. It is in Latin-1, which keeps every byte. */
function headerOf(file: Buffer, { lines, data }: PcdHeader, count: number): string {
  const values: Record<string, string> = {
    WIDTH: String(count),
    HEIGHT: "1",
    POINTS: String(count),
    DATA: data === "ascii" ? "ascii" : "binary",
  };
  return lines
    .map(({ start, end }) =>
      file.toString("latin1", start, end).replace(/^(\s*)(\w+)(\s+)\S+/, (same, indent, keyword: string, space) => {
        const value = values[keyword.toUpperCase()];
        return value === undefined ? same : `${indent}${keyword}${space}${value}`;
      }),
    )
    .join("");
}
