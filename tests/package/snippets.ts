// Documents whose snippets are run: what they print is what they say they do.
import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

export const root = join(import.meta.dirname, "..", "..");

/** The blocks of one language in a document of the repository. */
export function blocks(document: string, language: string): string[] {
  const text = readFileSync(join(root, document), "utf8");
  return [...text.matchAll(/^```(\w+)\n([^]*?)^```$/gm)].flatMap(([, name, code]) =>
    name === language && code !== undefined ? [code] : [],
  );
}

/** A place for a document's scripts, inside the repository, so that the package finds itself by its name. */
export function scratchFor(name: string): string {
  const scratch = join(root, "target", name);
  mkdirSync(scratch, { recursive: true });
  return scratch;
}

/** What a snippet says it prints: its comments `// → …`. */
export function promised(code: string): string[] {
  return [...code.matchAll(/\/\/ → (.*)/g)].map(([, text]) => (text ?? "").trim());
}

/** The lines a snippet prints. */
export function printed(scratch: string, i: number, code: string): string[] {
  const file = join(scratch, `snippet-${i}.mjs`);
  writeFileSync(file, code);
  const output = execFileSync(process.execPath, [file], { cwd: scratch, encoding: "utf8" });
  return output.trim().replaceAll("[ ", "[").replaceAll(" ]", "]").split("\n");
}
