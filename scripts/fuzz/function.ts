// node function.js FILE NAME --minutes M --seed N: calls the function NAME of a TypeScript file and
// prints its count like the other fuzzers.
import { parseArgs } from "node:util";

import type { Tally } from "./fuzzers.js";
import { load } from "../lib/load.js";

const text = { type: "string" } as const;
const { positionals, values } = parseArgs({ options: { minutes: text, seed: text }, allowPositionals: true });
const [file = "", name = ""] = positionals;

/** The whole count, or the number of wrong cases. With a number, the function prints lines `N cases, M wrong` itself. */
type Result = Tally | number;
type Module = Record<string, (minutes: number, seed: number) => Promise<Result>>;
const module = await load<Module>(file);
const result = await module[name]!(Number(values.minutes), Number(values.seed));
const wrong = typeof result === "number" ? result : result.wrong;
if (typeof result !== "number") console.log(`${result.tried} tried, ${wrong} wrong`);
// Workers that the function started must not keep the process alive.
process.exit(wrong > 0 ? 1 : 0);
