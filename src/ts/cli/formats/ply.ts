import type { ChosenColumns } from "../../formats/axes.js";
import type { CloudFile } from "../../formats/cloud-file.js";
import { type PlyHeader, readPlyHeader } from "../../formats/ply.js";
import type { Frame } from "./point-file.js";

/** PLY, ASCII and binary. Only the vertices are kept: faces would point to vertices that are gone. */
export function plyFrame(file: Buffer, _: CloudFile, chosen?: ChosenColumns): Frame {
  const header = readPlyHeader(file, chosen);
  const { elements, vertices } = header;
  return {
    leftOut: elements.filter((one) => one !== vertices && one.count > 0).map(({ name, count }) => `${count} × ${name}`),
    header: ({ length }) => Buffer.from(headerOf(file, header, length), "latin1"),
  };
}

/** The header for another number of points. It is in Latin-1, which keeps every byte. */
function headerOf(file: Buffer, { lines }: PlyHeader, count: number): string {
  return lines
    .filter(({ element }) => element === undefined || element === "vertex")
    .map(({ start, end }) => file.toString("latin1", start, end))
    .map((text) => text.replace(/^(\s*element\s+vertex\s+)\d+/, `$1${count}`))
    .join("");
}
