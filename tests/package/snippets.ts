// Runs the snippets of documents. They must print the lines in their comments.
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

/** A folder for a document's scripts. It is inside the repository, so that imports by the package's name work. */
export function scratchFor(name: string): string {
  const scratch = join(root, "target", name);
  mkdirSync(scratch, { recursive: true });
  return scratch;
}

/** The lines that a snippet must print: its comments `// → …`. */
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
