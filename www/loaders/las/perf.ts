import createLazPerf from "laz-perf/lib/worker/laz-perf.js";
import { missingPart } from "../problem.ts";
import wasm from "laz-perf/lib/worker/laz-perf.wasm?url";

/** The part of laz-perf (the LAZ decoder of hobu, Apache 2.0) that is used here. */
export interface LazPerf {
  HEAPU8: Uint8Array;
  _malloc(bytes: number): number;
  _free(pointer: number): void;
  LASZip: new () => { open(pointer: number, length: number): void; getPoint(to: number): void; delete(): void };
  ChunkDecoder: new () => {
    open(format: number, rowBytes: number, pointer: number): void;
    getPoint(to: number): void;
    delete(): void;
  };
}

/** The page itself serves its wasm. */
export async function startLazPerf(name: string): Promise<LazPerf> {
  try {
    return (await createLazPerf({
      locateFile: () => wasm,
      print: () => undefined,
      printErr: () => undefined,
    })) as LazPerf;
  } catch {
    throw missingPart(name);
  }
}
