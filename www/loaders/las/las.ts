import type { LoadedCloud } from "../../cloud/cloud.ts";
import { bytes, eachRow, type Reading } from "../blocks.ts";
import { checkByteLength } from "../limits.ts";
import { LoadProblem } from "../problem.ts";
import { type LasHeader, readHeader } from "./header.ts";
import { checkChunkTable, checkLazFormat, lasEndsEarly, lazDamaged } from "../../../src/ts/formats/laz.js";
import { startLazPerf } from "./perf.ts";
import { RecordTaker } from "./records.ts";

/** The number of points that are decompressed between two reports of progress. */
const BATCH = 50_000;

/** Reads a LAS or LAZ file. A file with an octree (COPC) is read node by node. */
export async function readLas(reading: Reading): Promise<LoadedCloud> {
  const { name, blob } = reading;
  const read = async (from: number, to: number) => new Uint8Array(await bytes(name, blob, from, to));
  const header = await readHeader(name, blob);
  if (header.count === 0) throw new LoadProblem(`${name} holds no points.`);
  if (header.isCopc) {
    const { readCopc } = await import("./copc.ts");
    return readCopc(reading, read, blob);
  }
  const taker = new RecordTaker(header, reading);
  if (header.compressed) {
    checkLazFormat(header);
    checkByteLength(name, blob.size);
    await checkChunkTable(header, blob.size, read);
    await decompress(reading, header, taker);
  } else {
    if (header.count * header.rowBytes > blob.size - header.start) throw lasEndsEarly(header.count);
    await eachRow(reading, header, (view, at) => {
      taker.take(view, at);
    });
  }
  return taker.finish();
}

/** The whole file is copied into the decoder's memory, and its points come out one after another. */
async function decompress(reading: Reading, header: LasHeader, taker: RecordTaker): Promise<void> {
  const { name, blob, onProgress } = reading;
  const perf = await startLazPerf(name);
  const { count, rowBytes } = header;
  try {
    const file = perf._malloc(blob.size);
    const piece = 1 << 24;
    for (let at = 0; at < blob.size; at += piece) {
      const part = await bytes(name, blob, at, at + piece);
      perf.HEAPU8.set(new Uint8Array(part), file + at);
    }
    const rows = perf._malloc(BATCH * rowBytes);
    const decoder = new perf.LASZip();
    decoder.open(file, blob.size);
    for (let first = 0; first < count; first += BATCH) {
      onProgress(first / count);
      const batch = Math.min(BATCH, count - first);
      for (let row = 0; row < batch; row++) decoder.getPoint(rows + row * rowBytes);
      const view = new DataView(perf.HEAPU8.buffer, rows, batch * rowBytes);
      for (let row = 0; row < batch; row++) taker.take(view, row * rowBytes);
    }
  } catch (error) {
    // The decoder throws numbers, traps and aborts. Each of these means that the file is damaged.
    throw error instanceof LoadProblem ? error : lazDamaged();
  }
}
