// Random changes of valid files. Each changed file must be refused with a message, or read like a second, naive reader
// reads it. The command and the page must do the same.
import { naive } from "../files/naive";
import { type Outcome, readAsCommand, readAsPage } from "../files/read";
import { Random, validFile } from "../files/random";

interface Tally {
  valid: number;
  refused: number;
  read: number;
  wrong: number;
}

/** Tries files for this many minutes and prints the counts. Returns how many files were read wrongly. */
export async function fuzzFiles(minutes: number, seed: number): Promise<number> {
  console.log(`seed ${seed}, ${minutes} minutes`);
  const end = Date.now() + 60_000 * minutes;
  const tallies = new Map<string, Tally>();
  for (let round = 0; Date.now() < end; round++) await tryRound(seed + round, tallies, console.log);
  for (const [kind, { valid, refused, read, wrong }] of tallies) {
    console.log(`${kind}: ${refused} changes refused, ${read} read; ${valid + refused + read} cases, ${wrong} wrong`);
  }
  return [...tallies.values()].reduce((sum, { wrong }) => sum + wrong, 0);
}

const CHANGES_OF_EACH = 20;

/** Tries a valid file and changes of it. The seed determines all of them. */
export async function tryRound(seed: number, tallies: Map<string, Tally>, say: (text: string) => void): Promise<void> {
  const random = new Random(seed);
  const { kind, name, content, points, seal = (file: Buffer) => file } = validFile(random);
  const tally = tallies.get(kind) ?? { valid: 0, refused: 0, read: 0, wrong: 0 };
  tallies.set(kind, tally);
  const tell = (what: string, file: Uint8Array) => {
    tally.wrong++;
    say(`seed ${seed}, ${kind}: ${what}\n${JSON.stringify(Buffer.from(file).toString("latin1"))}`);
  };

  tally.valid++;
  const fault = await faultOf(name, content, points);
  if (fault !== undefined) tell(`valid, but ${fault}`, content);
  for (let change = 0; change < CHANGES_OF_EACH; change++) {
    const changed = seal(random.changed(content));
    const command = await attempt(name, changed);
    if (command === undefined || "points" in command) tally.read++;
    else tally.refused++;
    const wrong = await faultOf(name, changed);
    if (wrong !== undefined) tell(wrong, changed);
  }
}

async function attempt(name: string, content: Uint8Array): Promise<Outcome | undefined> {
  try {
    return await readAsCommand(name, content);
  } catch {
    return undefined;
  }
}

/** @param expected the right points; if undefined, the naive reader finds them */
async function faultOf(name: string, content: Uint8Array, expected?: readonly number[]): Promise<string | undefined> {
  let command: Outcome;
  let page: Outcome;
  try {
    command = await readAsCommand(name, content);
    // In Node, the page cannot load the wasm that reads E57.
    page = name.endsWith(".e57") ? command : await readAsPage(name, content);
  } catch (error) {
    return `no sentence: ${String(error)}`;
  }
  if ("points" in command !== "points" in page) {
    return `the command says ${shown(command)}, and the page ${shown(page)}`;
  }
  if (!("points" in command && "points" in page)) return expected === undefined ? undefined : shown(command);
  if (!equal(command.points, page.points)) return `the command reads ${shown(command)}, and the page ${shown(page)}`;
  let points = expected;
  try {
    points ??= naive(name, content);
  } catch {
    return `read as ${shown(command)}, though it cannot be`;
  }
  if (points === undefined || equal(command.points, points)) return undefined;
  return `read as ${shown(command)} instead of ${points.join(" ")}`;
}

function equal(a: readonly number[], b: readonly number[]): boolean {
  // An infinite number is not a position. It counts as missing, like NaN.
  return (
    a.length === b.length && a.every((value, i) => value === b[i] || !(Number.isFinite(value) || Number.isFinite(b[i])))
  );
}

function shown(outcome: Outcome): string {
  return "points" in outcome ? outcome.points.join(" ") : `“${outcome.refused}”`;
}
