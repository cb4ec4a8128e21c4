import createLazPerf from "laz-perf/lib/worker/laz-perf.js";
import type { LazPerf } from "../../../src/ts/formats/las/laz-perf.js";
import { missingPart } from "../problem.ts";
import wasm from "laz-perf/lib/worker/laz-perf.wasm?url";

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
