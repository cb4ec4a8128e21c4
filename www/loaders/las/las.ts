import type { LoadedCloud } from "../../cloud/cloud.ts";
import { bytes, eachRow, type Reading } from "../blocks.ts";
import { checkByteLength } from "../limits.ts";
import { endsEarly, LoadProblem } from "../problem.ts";
import { checkFormat, damaged } from "./compressed.ts";
import { type LasHeader, readHeader } from "./header.ts";
import { startLazPerf } from "./perf.ts";
import { RecordTaker } from "./records.ts";

/** The number of points that are decompressed between two reports of progress. */
const BATCH = 50_000;

/** Reads a LAS or LAZ file. A file with an octree (COPC) is read node by node. */
export async function readLas(reading: Reading): Promise<LoadedCloud> {
  const { name, blob } = reading;
  const header = await readHeader(name, blob);
  if (header.count === 0) throw new LoadProblem(`${name} holds no points.`);
  if (header.isCopc) {
    const { readCopc } = await import("./copc.ts");
    return readCopc(reading, async (from, to) => new Uint8Array(await bytes(name, blob, from, to)));
  }
  const taker = new RecordTaker(header, reading);
  if (header.compressed) {
    await decompress(reading, header, taker);
  } else {
    if (header.count * header.rowBytes > blob.size - header.start) throw endsEarly(name, header.count);
    await eachRow(reading, header, (view, at) => {
      taker.take(view, at);
    });
  }
  return taker.finish();
}

/** The whole file is copied into the decoder's memory, and its points come out one after another. */
async function decompress(reading: Reading, header: LasHeader, taker: RecordTaker): Promise<void> {
  const { name, blob, onProgress } = reading;
  checkFormat(name, header);
  checkByteLength(name, blob.size);
  await checkChunkTable(reading, header);
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
    throw error instanceof LoadProblem ? error : damaged(name);
  }
}

/** Finds out whether a compressed file was cut: the table of its chunks is at its end, so that is missing then. */
async function checkChunkTable({ name, blob }: Reading, { start, count }: LasHeader): Promise<void> {
  const head = await bytes(name, blob, start, start + 8);
  if (head.byteLength < 8) throw endsEarly(name, count);
  const at = Number(new DataView(head).getBigInt64(0, true));
  // A program that writes to a stream stores the table's place at the very end.
  const table = at === -1 ? await lastNumber(name, blob) : at;
  if (table < start || table + 8 > blob.size) throw endsEarly(name, count);
  const chunks = new DataView(await bytes(name, blob, table, table + 8)).getUint32(4, true);
  if (chunks > count) throw damaged(name);
}

async function lastNumber(name: string, blob: Blob): Promise<number> {
  return Number(new DataView(await bytes(name, blob, blob.size - 8, blob.size)).getBigInt64(0, true));
}
