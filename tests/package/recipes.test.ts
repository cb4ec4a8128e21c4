// Every recipe is run: the scripts print what they say, the commands write what they are asked for.
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
  const properties = ["float x", "float y", "float z", "uchar intensity"].map((one) => `property ${one}\n`).join("");
  writeFileSync(
    join(scratch, "in.ply"),
    `ply\nformat ascii 1.0\nelement vertex 3000\n${properties}end_header\n${lines.join("")}`,
  );
});

it.each(blocks(RECIPES, "js").map((code, i) => [i, code] as const))("snippet %i prints what it says", (i, code) => {
  expect(promised(code).length).toBeGreaterThan(0);
  expect(printed(scratch, i, code)).toEqual(promised(code));
});

const commands = blocks(RECIPES, "sh").flatMap((block) => block.trim().split("\n"));
it.each(commands)("%s", (command) => {
  const [, args = "", redirected] = /^npx hidden-point-removal (.*?)(?: > (\S+))?$/.exec(command)!;
  const output = execFileSync(process.execPath, [join(root, "dist/cli/main.js"), ...args.split(" ")], {
    cwd: scratch,
    stdio: "pipe",
  });
  const written = redirected === undefined ? readFileSync(join(scratch, "out.ply")) : output;
  const count = Number(/element vertex (\d+)/.exec(written.toString())![1]);
  expect(count).toBeGreaterThan(500);
  expect(count).toBeLessThan(2000);
  expect(written.toString().trim().split("\n")).toHaveLength(8 + count);
});
