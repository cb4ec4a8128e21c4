// Reads a file in this process: once like the command does, and once like the page does.
import type { ChosenColumns } from "../../src/ts/formats/axes";
import { FormatProblem } from "../../src/ts/formats/problem";
import { readPoints } from "../../src/ts/cli/formats";
import { LoadProblem } from "../../www/loaders/protocol";
import { readCloud } from "../../www/loaders/read";

export type Outcome = { points: number[] } | { refused: string };

export async function readAsCommand(name: string, content: Uint8Array, chosen?: ChosenColumns): Promise<Outcome> {
  try {
    const { positions } = await readPoints(name, Buffer.from(content), { chosen });
    return { points: [...positions] };
  } catch (error) {
    if (!(error instanceof FormatProblem)) throw error;
    return { refused: error.message };
  }
}

export async function readAsPage(name: string, content: Uint8Array): Promise<Outcome> {
  const blob = new Blob([new Uint8Array(content)]);
  try {
    const { positions } = await readCloud({ name, blob, limit: 1e6 });
    return { points: [...positions] };
  } catch (error) {
    if (!(error instanceof LoadProblem)) throw error;
    return { refused: error.message };
  }
}
