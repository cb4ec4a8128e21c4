// node function.js FILE NAME --minutes M --seed N: calls the function NAME of a TypeScript file and
// prints its count as fuzzers do. Vite loads the file: the page's modules are written for it.
import { parseArgs } from "node:util";
import { runnerImport } from "vite";

import { inRoot, root } from "../lib/paths.js";
import type { Tally } from "./run.js";

const text = { type: "string" } as const;
const { positionals, values } = parseArgs({ options: { minutes: text, seed: text }, allowPositionals: true });
const [file = "", name = ""] = positionals;

/** Either the whole count, or how many were wrong after lines that end in `N cases, M wrong`. */
type Result = Tally | number;
type Module = Record<string, (minutes: number, seed: number) => Promise<Result>>;
const { module } = await runnerImport<Module>(inRoot(file), { root, configFile: false, logLevel: "warn" });
const result = await module[name]!(Number(values.minutes), Number(values.seed));
const wrong = typeof result === "number" ? result : result.wrong;
if (typeof result !== "number") console.log(`${result.tried} tried, ${wrong} wrong`);
// Workers that the function left behind must not keep the process alive.
process.exit(wrong > 0 ? 1 : 0);
