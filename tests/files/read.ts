// Reads a file in this process: once like the command does, and once like the page does.
import { extname } from "node:path";
import type { ChosenColumns } from "../../src/ts/formats/axes";
import { FormatProblem } from "../../src/ts/formats/problem";
import type { PointFile } from "../../src/ts/cli/formats/point-file";
import { FORMATS } from "../../src/ts/cli/formats/formats";
import { LoadProblem } from "../../www/loaders/problem";
import { readFile } from "../../www/loaders/read";

export type Outcome = { points: number[] } | { refused: string };

export function readAsCommand(name: string, content: Uint8Array, columns?: ChosenColumns): Outcome {
  try {
    // Only LAZ, which is not among these files, is read asynchronously.
    const { positions } = FORMATS[extname(name)]!.read(Buffer.from(content), columns) as PointFile;
    return { points: [...positions] };
  } catch (error) {
    if (!(error instanceof FormatProblem)) throw error;
    return { refused: error.message };
  }
}

export async function readAsPage(name: string, content: Uint8Array): Promise<Outcome> {
  const blob = new Blob([new Uint8Array(content)]);
  try {
    const { positions } = await readFile({ name, blob, limit: 1e6, onProgress: () => undefined }, null);
    return { points: [...positions] };
  } catch (error) {
    if (!(error instanceof LoadProblem)) throw error;
    return { refused: error.message };
  }
}
