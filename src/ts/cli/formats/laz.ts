import type { LasHeader } from "../../formats/las.js";
import { FormatProblem } from "../../formats/problem.js";

/** The part of laz-perf (the LAZ decoder of hobu, Apache 2.0) that is used here. */
interface LazPerf {
  HEAPU8: Uint8Array;
  _malloc(bytes: number): number;
  LASZip: new () => { open(pointer: number, length: number): void; getPoint(to: number): void };
}

/** The number of points that are decompressed before they are copied. */
const BATCH = 50_000;

/** All points of a LAZ or COPC file in rows, in the order of the file. */
export async function decompressed(file: Buffer, { count, rowBytes }: LasHeader): Promise<Uint8Array> {
  const perf = await startLazPerf();
  const rows = roomFor(count * rowBytes);
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
async function startLazPerf(): Promise<LazPerf> {
  // TypeScript must not look for it: its types need those of Emscripten.
  const name: string = "laz-perf";
  let found: { createLazPerf: (options: object) => Promise<LazPerf> };
  try {
    found = (await import(name)) as typeof found;
  } catch (cause) {
    throw new FormatProblem("LAZ and COPC need the package laz-perf: npm install laz-perf", { cause });
  }
  const silent = () => undefined;
  return found.createLazPerf({ print: silent, printErr: silent });
}

function roomFor(bytes: number): Uint8Array {
  try {
    return new Uint8Array(bytes);
  } catch (cause) {
    throw new FormatProblem(`no memory for its ${bytes} bytes of points`, { cause });
  }
}
