import { inRoot } from "../lib/paths.js";
import { run } from "../lib/run.js";
import type { Platform } from "./platforms.js";

export interface Answers {
  /** The text `digest count radius` of each case, by the case's name. */
  cases: Map<string, string>;
  /** The digest of all cases. */
  all: string;
}

/** Builds the corpus for a platform and runs it. Returns its output, or undefined if it failed. */
export async function answersOn(platform: Platform): Promise<{ output: string; seconds: number } | undefined> {
  const { target, build, env, runner } = platform;
  const args = ["build", "--locked", "--package", "hpr-tests", "--bin", "bits_corpus", "--target", target, ...build];
  const built = await run("cargo", args, { env: { ...env, CARGO_TARGET_DIR: inRoot("target", "bits") } });
  if (!built.ok) return undefined;
  const folder = build.includes("dev") ? "debug" : "quick";
  const file = `bits_corpus${target.startsWith("wasm32") ? ".wasm" : process.platform === "win32" ? ".exe" : ""}`;
  const [program, ...rest] = [...runner, inRoot("target", "bits", target, folder, file)];
  const start = performance.now();
  const { ok, output } = await run(program, rest, { show: "nothing" });
  if (!ok) console.error(output.trimEnd().split("\n").slice(-20).join("\n"));
  return ok ? { output, seconds: (performance.now() - start) / 1000 } : undefined;
}

/**
 * Reads the lines `name digest count radius`. Returns undefined unless the last line is `all`, with the right number of
 * cases.
 */
export function answersIn(output: string): Answers | undefined {
  const lines = [...output.matchAll(/^(\S+) ([0-9a-f]{16} \d+ (?:[0-9a-f]{16}|-))\r?$/gm)];
  const [, name, last = ""] = lines.pop() ?? [];
  const [all = "", count] = last.split(" ");
  const cases = new Map(lines.map(([, name, answer]) => [name!, answer!]));
  return name === "all" && cases.size > 0 && Number(count) === cases.size ? { cases, all } : undefined;
}

/** The first case with different answers, or with an answer on one side only; undefined if all are equal. */
export function firstDifference(expected: Answers, got: Answers): string | undefined {
  const names = [...expected.cases.keys(), ...got.cases.keys()];
  const different = names.find((name) => expected.cases.get(name) !== got.cases.get(name));
  return different ?? (expected.all === got.all ? undefined : "all");
}
