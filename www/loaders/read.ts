import type { LoadedCloud } from "../cloud/cloud.ts";
import { FormatProblem } from "../../src/ts/formats/problem.js";
import { readFile } from "../../src/ts/formats/read.js";
import { blobSource } from "../../src/ts/formats/source.js";
import { compileFiles } from "./download.ts";
import { loaded, type Loading } from "./loaded.ts";
import { LoadProblem, missingPart, problemOf } from "./protocol.ts";

/** Reads a file of points. Each reader is downloaded when it is needed. */
export async function readCloud(loading: Loading): Promise<LoadedCloud> {
  const { name } = loading;
  try {
    return await readBy(loading);
  } catch (error) {
    if (error instanceof LoadProblem) throw error;
    if (error instanceof FormatProblem) throw problemOf(name, error);
    if (error instanceof TypeError && error.message.includes("import")) throw missingPart(name);
    // An unexpected error in a loader means that the file is broken: a size, an offset or a number is impossible.
    throw new LoadProblem(`${name} is broken and could not be read.`);
  }
}

async function readBy(loading: Loading): Promise<LoadedCloud> {
  const { name, blob } = loading;
  const wasm = () => compileFiles(name);
  return loaded(name, await readFile({ ...loading, source: blobSource(blob), single: true, wasm }));
}
