import { writeFileSync } from "node:fs";
import { join } from "node:path";

import type { Consumer } from "./consumer";

/** The result of one consumer. */
export interface Row {
  consumer: Consumer;
  /** Undefined if it was not run. */
  works?: boolean;
  seconds?: number;
}

/** Writes MATRIX.md. */
export function writeMatrix(rows: Row[]): void {
  const lines = rows.map(({ consumer: { name, version, glue = [], lacking }, works, seconds }) => {
    const result = works === undefined ? `not run: ${lacking}` : works ? "yes" : "**no**";
    const title = name.replace(/<.*>/, "`$&`");
    return `| ${title} | ${version} | ${result} | ${glue.length} | ${seconds?.toFixed(1) ?? ""} |`;
  });
  writeFileSync(
    join(import.meta.dirname, "MATRIX.md"),
    `# Consumers of the packed package

Written by \`npm run consumers\` in Node ${process.versions.node} on ${process.platform}. Each consumer installs the tarball and does what
[docs/BUNDLERS.md](../../docs/BUNDLERS.md) says, nothing else. It works if it answers like the repository's own build, in its own
thread and in workers. Lines of glue are those besides the imports, \`init()\` and the questions. The seconds are those of building
and asking on a shared machine, without \`npm install\`.

| consumer | version | works first time | lines of glue | seconds |
|---|---|---|---:|---:|
${lines.join("\n")}
`,
  );
}
