import { copyFileSync, existsSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

import { inRoot, root } from "../lib/paths.js";
import { Problem, run, say } from "../lib/run.js";
import { listFile } from "./list.js";
import { copyTree, out, tree } from "./tree.js";

const CARGO = [
  "--quiet",
  "--message-format=json",
  "--locked",
  "--profile",
  "fuzz",
  "--target-dir",
  join(out, "target"),
];
const SWITCH = "crate::mutant::is(";
/** The beginning of the switch of an arm. */
const ARM = ` if !${SWITCH}`;

export interface Programs {
  /** The test programs, which hold all mutants. */
  paths: string[];
  /** Numbers of the mutants that are in the programs. */
  placed: Set<number>;
  /** Numbers of the mutants that do not compile. */
  unviable: Set<number>;
}

/**
 * Puts all mutants into the copy of the crate, each behind a switch, and compiles the tests. Mutants at which the
 * compiler stops are left out, and the compiler starts again.
 */
export async function buildPrograms(): Promise<Programs> {
  const unviable = new Set(remembered());
  copyTree();
  for (;;) {
    const placed = await putMutants(unviable);
    const { errors } = await cargo(["check", "--lib"]);
    if (errors.length === 0) {
      copyFileSync(listFile, LISTED);
      say(`${placed.size} mutants compile, ${unviable.size} do not. Compiling the tests…`);
      return { paths: await buildTests(), placed, unviable };
    }
    const before = unviable.size;
    for (const error of errors) unviable.add(mutantAt(error));
    if (unviable.size === before) throw new Problem(`The mutants do not compile: ${JSON.stringify(errors[0])}`);
  }
}

const SKIPPED = join(out, "unviable.txt");
const LISTED = join(out, "unviable-of.json");

/** The mutants that did not compile the last time, if the list of mutants is the same. */
function remembered(): number[] {
  if (!existsSync(LISTED) || readFileSync(LISTED, "utf8") !== readFileSync(listFile, "utf8")) return [];
  return [...readFileSync(SKIPPED, "utf8").matchAll(/\d+/g)].map(Number);
}

async function putMutants(unviable: Set<number>): Promise<Set<number>> {
  writeFileSync(SKIPPED, Array.from(unviable, (number) => `${number}\n`).join(""));
  const tool = [
    "--manifest-path",
    inRoot("tools", "mutants", "Cargo.toml"),
    "--target-dir",
    inRoot("target", "tools", "mutants"),
  ];
  const args = ["run", "--locked", "--quiet", ...tool, "--", root, tree, listFile, SKIPPED];
  const { ok, output } = await run("cargo", args, { show: "nothing" });
  if (!ok) throw new Problem(`The mutants could not be put into the sources:\n${output}`);
  return new Set(output.trim().split("\n").map(Number));
}

async function buildTests(): Promise<string[]> {
  const { messages, errors } = await cargo(["test", "--no-run", "--lib", "--test", "core"]);
  const paths = messages.flatMap(({ executable }) => executable ?? []).sort();
  if (errors.length > 0 || paths.length === 0) throw new Problem(`The tests do not compile: ${JSON.stringify(errors)}`);
  return paths;
}

interface Place {
  file_name: string;
  byte_start: number;
  is_primary: boolean;
}

interface Message {
  executable?: string | null;
  message?: { level: string; message: string; spans: Place[] };
}

/** Runs cargo on the copy. Returns all its messages, and those that are errors at a place of a source. */
async function cargo([command, ...what]: string[]) {
  const args = [command!, ...what, ...CARGO, "--manifest-path", join(tree, "Cargo.toml")];
  // Mutants may break lints.
  const { output } = await run("cargo", args, { show: "nothing", env: { RUSTFLAGS: "--cap-lints allow" } });
  const messages = output
    .split("\n")
    .filter((line) => line.startsWith("{"))
    .map((line) => JSON.parse(line) as Message);
  const errors = messages.flatMap(({ message }) =>
    message?.level === "error" && message.spans.length > 0 ? [message] : [],
  );
  return { messages, errors };
}

/**
 * The mutant at which the compiler stopped: the last one that begins before that place. Where a `match` lacks
 * patterns, the place is before its arms, and the first arm that has a switch is to blame.
 */
function mutantAt({ message, spans }: { message: string; spans: Place[] }): number {
  const { file_name, byte_start } = spans.find(({ is_primary }) => is_primary)!;
  const source = readFileSync(join(tree, file_name));
  const lacksPatterns = message.startsWith("non-exhaustive patterns");
  const text = lacksPatterns ? source.subarray(byte_start).toString() : source.subarray(0, byte_start).toString();
  const [mark, at] = lacksPatterns ? [ARM, text.indexOf(ARM)] : [SWITCH, text.lastIndexOf(SWITCH)];
  if (at < 0) throw new Problem(`${file_name} does not compile: ${message}`);
  return Number.parseInt(text.slice(at + mark.length));
}
