import createLazPerf from "laz-perf/lib/worker/laz-perf.js";
import lazPerf from "laz-perf/lib/worker/laz-perf.wasm?url";
import e57 from "../../src/ts/formats/e57/e57.wasm?url";
import type { LazPerf } from "../../src/ts/formats/las/laz-perf.js";
import { missingPart } from "./problem.ts";

/** The decoder of LAZ. The page itself serves its wasm. */
export async function startLazPerf(name: string): Promise<LazPerf> {
  try {
    return (await createLazPerf({
      locateFile: () => lazPerf,
      print: () => undefined,
      printErr: () => undefined,
    })) as LazPerf;
  } catch {
    throw missingPart(name);
  }
}

/** The reader of E57. */
export async function compileE57(name: string): Promise<WebAssembly.Module> {
  try {
    return await WebAssembly.compile(await (await fetch(e57)).arrayBuffer());
  } catch {
    throw missingPart(name);
  }
}
