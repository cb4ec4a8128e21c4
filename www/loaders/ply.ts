import type { LoadedCloud } from "../cloud/cloud.ts";
import { LONGEST_PLY_HEADER, type PlyHeader, readPlyHeader as headerIn } from "../../src/ts/formats/ply.js";
import { bytes, type Reading } from "./blocks.ts";
import { checkEnd, endOfRows, otherColumns, type Points, readBinaryRows, readTextRows } from "./rows.ts";

/** Other names of colors in some files. */
const NAMES: Record<string, string> = {
  r: "red", diffuse_red: "red", g: "green", diffuse_green: "green", b: "blue", diffuse_blue: "blue",
}; // prettier-ignore

/** The vertices of a PLY file. Its faces are ignored. */
export async function readPly(reading: Reading): Promise<LoadedCloud> {
  const header = await readPlyHeader(reading);
  const { elements, vertices, axes, end, lines } = header;
  const points = { group: vertices, axes, others: otherColumns(vertices, axes, called) };
  const cloud =
    header.format === "ascii"
      ? await readTextRows(reading, { start: end, firstNumber: lines.length + 1 }, elements, points)
      : await readBinary(reading, header, points);
  const faces = elements.some((element) => element.name === "face" && element.count > 0);
  return { ...cloud, isMesh: faces && cloud.positions.length === 3 * vertices.count };
}

export async function readPlyHeader({ name, blob }: Reading): Promise<PlyHeader> {
  return headerIn(new Uint8Array(await bytes(name, blob, 0, LONGEST_PLY_HEADER)));
}

function called(name: string): string {
  const lower = name.toLowerCase();
  return NAMES[lower] ?? (/^(red|green|blue)$/.test(lower) ? lower : name.replace(/^scalar_/, ""));
}

async function readBinary(reading: Reading, header: PlyHeader, points: Points): Promise<LoadedCloud> {
  const { format, elements, vertices, end } = header;
  const littleEndian = format === "binary_little_endian";
  let at = end;
  let cloud: LoadedCloud | undefined;
  for (const element of elements) {
    if (element === vertices) cloud = await readBinaryRows(reading, at, points, littleEndian);
    at = await endOfRows(reading, at, element, littleEndian);
  }
  await checkEnd(reading, at, elements.at(-1)!.name);
  return cloud!;
}
