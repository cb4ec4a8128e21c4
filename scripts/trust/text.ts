import { existsSync, readFileSync } from "node:fs";
import { dirname, join, posix } from "node:path";

/** One kind of check: its title, what runs it, and the file that holds its results. */
const KINDS: [title: string, command: string, results: string][] = [
  ["Fuzzing: clouds and divided views against the definition", "`npm run fuzz`", "tests/fuzz/RESULTS.md"],
  ["Mutations of the core", "`npm run mutants`", "tests/mutations/RUST.md"],
  ["Lines of the core that its tests never reach", "hand, with cargo-llvm-cov", "tests/mutations/COVERAGE.md"],
  ["Mutations of the TypeScript", "Stryker and by hand", "tests/mutations/TYPESCRIPT.md"],
  ["The same bits on every platform", "`npm run bits`", "tests/bits/RESULTS.md"],
  ["Re-filters all day", "`npm run soak`", "tests/soak/RESULTS.md"],
  ["Large clouds from end to end", "`npm run large`", "tests/soak/LARGE.md"],
  ["Two clean builds, the same bytes", "`npm run reproduce`", "tests/release/REPRODUCED.md"],
  ["The minimum Rust", "`npm run minimum`", "tests/release/MINIMUM.md"],
  [
    "A release, up to the point where something would be sent",
    "`npm run release -- --dry-run`",
    "tests/release/REHEARSED.md",
  ],
];

export const TRUST = "tests/TRUST.md";

/** The text of tests/TRUST.md, from the results in the repository at `root`. */
export function trust(root: string): string {
  const parts = KINDS.map(([title, how, results]) => {
    const body = existsSync(join(root, results)) ? withoutTitle(root, results) : "Not run yet.";
    return `## ${title}\n\nRun by ${how}; results in [${results}](${posix.relative("tests", results)}).\n\n${body}`;
  });
  return `# Trust

Written by \`npm run trust\` from the results of the long checks. [README.md](README.md) maps the tests that every
\`npm test\` runs.

## Faults found and mended

${read(root, "tests/FAULTS.md")}

## What is left

${read(root, "tests/LEFT.md")}

${parts.join("\n\n")}
`;
}

function read(root: string, file: string): string {
  return readFileSync(join(root, file), "utf8").trim();
}

/** A result file without its title. Its headings are one level deeper, and its links are relative to tests/. */
function withoutTitle(root: string, file: string): string {
  const folder = posix.relative("tests", dirname(file));
  return read(root, file)
    .replace(/^# .*\n+/, "")
    .replace(/^(#+ )/gm, "#$1")
    .replace(/\]\((?!https?:|#)([^)]+)\)/g, (_, target: string) => `](${posix.join(folder, target)})`);
}
