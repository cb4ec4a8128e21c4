import type { LasHeader } from "../../formats/las.js";
import type { LazFiles } from "../../formats/laz-perf.js";
import { FormatProblem } from "../../formats/problem.js";
import { allocating } from "../memory.js";

/** The number of points that are decompressed before they are copied. */
const BATCH = 50_000;

/** All points of a LAZ or COPC file in rows, in the order of the file. */
export async function decompressed(file: Buffer, { count, rowBytes }: LasHeader): Promise<Uint8Array> {
  const perf = await startLazPerf();
  const rows = allocating(`its ${count * rowBytes} bytes of points`, () => new Uint8Array(count * rowBytes));
  const from = perf._malloc(file.length);
  if (from === 0) throw new FormatProblem(`laz-perf has no memory for its ${file.length} bytes`);
  perf.HEAPU8.set(file, from);
  const to = perf._malloc(BATCH * rowBytes);
  const decoder = new perf.LASZip();
  decoder.open(from, file.length);
  for (let first = 0; first < count; first += BATCH) {
    const batch = Math.min(BATCH, count - first);
    for (let row = 0; row < batch; row++) decoder.getPoint(to + row * rowBytes);
    // If the memory has grown, its buffer has been replaced.
    rows.set(perf.HEAPU8.subarray(to, to + batch * rowBytes), first * rowBytes);
  }
  return rows;
}

/** The package is optional: only LAZ and COPC files need it. */
async function startLazPerf(): Promise<LazFiles> {
  // TypeScript must not look for it: its types need those of Emscripten.
  const name: string = "laz-perf";
  let found: { createLazPerf: (options: object) => Promise<LazFiles> };
  try {
    found = (await import(name)) as typeof found;
  } catch (cause) {
    throw new FormatProblem("LAZ and COPC need the package laz-perf: npm install laz-perf", { cause });
  }
  const silent = () => undefined;
  return found.createLazPerf({ print: silent, printErr: silent });
}
