import type { CloudFile, Reading } from "./cloud-file.js";
import { splatColors } from "./colors.js";
import { Contradictions } from "./contradictions.js";
import { LONGEST_PLY_HEADER, type PlyHeader, readPlyHeader } from "./ply.js";
import { checkEnd, endOfRows, otherColumns, type Points, readBinaryRows, readTextRows } from "./read-rows.js";
import { fieldsSaid, listsIn } from "./rows.js";

const SPLATS = "it holds Gaussian splats: their centers are read as points, with their base colors";

/** The vertices of a PLY file. Its faces are ignored. */
export async function readPly(reading: Reading): Promise<CloudFile> {
  const header = readPlyHeader(await reading.source.read(0, LONGEST_PLY_HEADER), reading.chosen);
  const { elements, vertices, axes, end, lines } = header;
  const points = {
    group: vertices,
    axes,
    others: otherColumns(vertices, axes, (name) => name.replace(/^scalar_/, "")),
  };
  const cloud =
    header.format === "ascii"
      ? await readTextRows(reading, { start: end, firstNumber: lines.length + 1 }, elements, points)
      : await readBinary(reading, header, points);
  const packed = splatColors(cloud.columns);
  return {
    ...cloud,
    ...(packed && { packed, notes: [...cloud.notes, SPLATS] }),
    unread: listsIn(vertices),
    axes: fieldsSaid(vertices.fields, axes),
  };
}

async function readBinary(reading: Reading, header: PlyHeader, points: Points): Promise<CloudFile> {
  const { format, elements, vertices, end } = header;
  const littleEndian = format === "binary_little_endian";
  const found = new Contradictions(reading.damaged);
  let at = end;
  let cloud: CloudFile | undefined;
  for (const element of elements) {
    if (element === vertices) cloud = await readBinaryRows(reading, at, points, littleEndian);
    at = await endOfRows(reading, at, element, littleEndian, found);
  }
  await checkEnd(reading.source, at, elements.at(-1)!.name, found);
  return { ...cloud!, notes: [...new Set([...cloud!.notes, ...found.notes])] };
}
