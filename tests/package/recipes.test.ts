// Every recipe is run. The scripts print the lines in their comments, and the commands write their files.
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { beforeAll, expect, it } from "vitest";

import { blocks, printed, promised, root, scratchFor } from "./snippets";
import { bumpySphere } from "./support";

const RECIPES = "docs/RECIPES.md";
const scratch = scratchFor("recipes");

beforeAll(() => {
  const points = bumpySphere(5, 3000);
  const lines = Array.from(
    { length: 3000 },
    (_, i) => `${[...points.subarray(3 * i, 3 * i + 3)].join(" ")} ${i % 256}\n`,
  );
  const table = lines.map((line, i) => `${i},${line.replaceAll(" ", ",")}`);
  writeFileSync(join(scratch, "in.csv"), `id,x,y,z,intensity\n${table.join("")}`);
  const properties = ["float x", "float y", "float z", "uchar intensity"].map((one) => `property ${one}\n`).join("");
  writeFileSync(
    join(scratch, "in.ply"),
    `ply\nformat ascii 1.0\nelement vertex 3000\n${properties}end_header\n${lines.join("")}`,
  );
});

it.each(blocks(RECIPES, "js").map((code, i) => [i, code] as const))(
  "snippet %i prints the lines in its comments",
  (i, code) => {
    expect(promised(code).length).toBeGreaterThan(0);
    expect(printed(scratch, i, code)).toEqual(promised(code));
  },
);

/** The number of points of a written file: the count in its header, or the lines of a table. */
function pointsIn(written: string): number {
  const lines = written.trim().split("\n").length;
  const count = /element vertex (\d+)/.exec(written)?.[1];
  if (count === undefined) return lines - 1;
  expect(lines).toBe(8 + Number(count));
  return Number(count);
}

const commands = blocks(RECIPES, "sh").flatMap((block) => block.trim().split("\n"));
it.each(commands)("%s", (command) => {
  const [, args = "", redirected] = /^npx hidden-point-removal (.*?)(?: > (\S+))?$/.exec(command)!;
  const output = execFileSync(process.execPath, [join(root, "dist/cli/main.js"), ...args.split(" ")], {
    cwd: scratch,
    stdio: "pipe",
  });
  const file = /-o (\S+)/.exec(args)?.[1] ?? "out.ply";
  const written = redirected === undefined ? readFileSync(join(scratch, file)) : output;
  const count = pointsIn(written.toString());
  expect(count).toBeGreaterThan(500);
  expect(count).toBeLessThan(2000);
});
