// Filters a file of points, as the arguments of the command say.
import { readFileSync } from "node:fs";

import { HprError } from "../base/errors.js";
import { init } from "../index.js";
import { printable } from "../formats/problem.js";
import { type Answer, ask, type Question } from "./ask.js";
import { HELP, NAME, readArguments, type Settings } from "./arguments.js";
import { coloredPly, converted, lost, type PointFile, pointsCopied, readPoints, writtenAs } from "./formats.js";
import { readAs, writeWhole } from "./files.js";
import { colmapVis } from "../files/cameras/colmap.js";
import { checkOutputs, isNumpy, numbersWritten } from "./outputs.js";
import { camerasIn, farNote, holdsCameras, viewpointsIn } from "./places.js";
import { Progress, type Screen } from "./progress.js";
import { UsageProblem } from "./values.js";

/** Runs the command and returns its exit code. Tests call it without a process of its own. */
export async function command(args: string[], screen: Screen): Promise<number> {
  /** Says one line on standard error. Names and words of files in it cannot command the terminal. */
  const say = (line: string) => {
    screen.write(`${printable(line)}\n`);
  };
  let settings: Settings | "help" | "version";
  try {
    await init();
    settings = readArguments(args);
  } catch (error) {
    if (!(error instanceof UsageProblem)) throw error;
    say(`hidden-point-removal: ${error.message} (--help shows how)`);
    return 2;
  }
  if (settings === "help" || settings === "version") {
    process.stdout.write(settings === "help" ? HELP : `${version()}\n`);
    return 0;
  }
  const progress = new Progress(screen, settings.progress);
  try {
    const summary = await filter(settings, progress, say);
    progress.done();
    say(summary);
    return 0;
  } catch (error) {
    progress.done();
    say(`hidden-point-removal: ${reason(error)}`);
    // The numbers of an option may be wrong for this cloud only.
    return error instanceof UsageProblem || (error instanceof HprError && error.code === "option") ? 2 : 1;
  }
}

async function filter(settings: Settings, progress: Progress, say: (line: string) => void): Promise<string> {
  const { input, columns, overwrite, damaged } = settings;
  const question = await questionOf(settings);
  await checkOutputs({ inputs: [input, ...placeFiles(settings)], outputs: outputsOf(settings, question), overwrite });
  const onRead = (share: number) => {
    progress.show(0.2 * share, "reading");
  };
  const file = await readAs(input, onRead, (bytes) => {
    progress.show(0.2, "understanding");
    return readPoints(input, bytes, { chosen: columns, damaged });
  });
  const note = farNote(file.positions, question.seats);
  if (note !== undefined) {
    progress.done();
    say(note);
  }
  const seen: string[] = [];
  let skipped = 0;
  const onAsked = (share: number, doing: string) => {
    progress.show(0.3 + 0.6 * share, doing);
  };
  const written = settings.format === "points" ? writtenAs(input, settings.output) : undefined;
  const isConverted = written?.isCopy === false;
  // The workers take the positions away. Points in another format are made of them.
  const asked = isConverted ? { ...file, positions: file.positions.slice() } : file;
  for await (const answer of ask(asked, question, settings.workers, onAsked)) {
    await write(settings, file, answer);
    const from = answer.name === undefined ? "" : ` from ${answer.name}`;
    seen.push(`${answer.indices.length} of ${answer.length} points are visible${from}`);
    ({ skipped } = answer);
    if (answer.note !== undefined) say(`note: ${answer.note}`);
  }
  const leftOut = isConverted ? lost(file, written.ending) : written ? (file.leftOut ?? []) : [];
  return [
    ...seen,
    ...file.notes,
    ...(file.axes === undefined ? [] : [file.axes]),
    ...(skipped > 0 ? [`${skipped} without a position`] : []),
    ...(leftOut.length > 0 ? [`left out: ${leftOut.join(", ")}`] : []),
  ].join("; ");
}

/** Reads the small files first: a mistake in them is told at once. */
async function questionOf({ place, images, size, options, threshold, format }: Settings): Promise<Question> {
  const asked = { options, threshold };
  const quietly = () => undefined;
  if ("viewpoint" in place) return { ...asked, kind: "view", seats: [{ name: "", seat: place.viewpoint }] };
  const kind = place.each ? "each" : format === "counts" ? "coverage" : "any";
  const file = "cameras" in place ? place.cameras : place.viewpoints;
  if ("viewpoints" in place && !(await holdsCameras(file))) {
    return { ...asked, kind, seats: await readAs(file, quietly, (bytes) => viewpointsIn(bytes, place.each)) };
  }
  const seats = await camerasIn(file, place.each, size);
  if (images !== undefined) return { ...asked, kind: "colors", seats, ...images };
  const [first, ...others] = seats;
  if (kind === "any" && format !== "vis" && first !== undefined && others.length === 0) {
    return { ...asked, kind: "view", seats: [first] };
  }
  if (format === "pixels" && !place.each) {
    throw new UsageProblem(
      `--format pixels needs one camera, or ${NAME} in the name of OUT; ${file} has ${seats.length}`,
    );
  }
  return { ...asked, kind: format === "vis" ? "rows" : kind, seats };
}

function placeFiles({ place }: Settings): string[] {
  if ("cameras" in place) return [place.cameras];
  return "viewpoints" in place ? [place.viewpoints] : [];
}

function outputsOf({ output }: Settings, question: Question): string[] {
  return question.kind === "each" ? question.seats.map(({ name }) => named(output, name)) : [output];
}

function named(output: string, name: string | undefined): string {
  return name === undefined ? output : output.replaceAll(NAME, () => name);
}

async function write(settings: Settings, file: PointFile, answer: Answer): Promise<void> {
  await writeWhole(named(settings.output, answer.name), partsOf(settings, file, answer));
}

function partsOf({ input, output, format }: Settings, file: PointFile, answer: Answer): Iterable<Uint8Array> {
  if (format === "points") {
    const { ending, isCopy } = writtenAs(input, output)!;
    if (isCopy) return pointsCopied(file, answer.indices);
    const { parts, notes } = converted(file, answer.indices, ending);
    for (const note of notes) if (!file.notes.includes(note)) file.notes.push(note);
    return parts;
  }
  if (format === "vis") return [colmapVis(answer.rows!)];
  const isTable = /\.(npy|csv|txt|idx|mask)$/i.test(output);
  if (format === "colors" && !isTable) return coloredPly(file.positions, answer.colors!);
  return numbersWritten(format, answer, isNumpy(output));
}

function reason(error: unknown): string {
  if (error instanceof HprError) return `${error.message} (${error.code})`;
  // A message of the system contains the file's name already, and so do those of this command.
  return error instanceof Error ? error.message : String(error);
}

function version(): string {
  const text = readFileSync(new URL("../package.json", import.meta.url), "utf8");
  return (JSON.parse(text) as { version: string }).version;
}
