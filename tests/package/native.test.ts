import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { afterAll, beforeAll, describe, expect, it } from "vitest";

import { bumpySphere, bunny, readyPackage } from "./support";

const { PointCloud } = await readyPackage();

const root = fileURLToPath(new URL("../..", import.meta.url));
const folder = mkdtempSync(join(tmpdir(), "hpr-native-"));
const cargo = (...args: string[]) => execFileSync("cargo", args, { cwd: root, encoding: "utf8", stdio: "pipe" });

beforeAll(() => {
  // Uses the profile of the native tests, so that the crate is compiled once.
  cargo("build", "--locked", "--profile", "fuzz", "--example", "filter_xyz");
}, 300_000);
afterAll(() => {
  rmSync(folder, { recursive: true });
});

/** The points that the crate's example keeps, run natively. Every line ends with its index. */
function visibleNatively(positions: Float64Array, viewpoint: number[]): number[] {
  const file = join(folder, "cloud.xyz");
  const lines = Array.from({ length: positions.length / 3 }, (_, i) =>
    [...positions.subarray(3 * i, 3 * i + 3), i].join(" "),
  );
  writeFileSync(file, lines.join("\n"));
  const example = ["run", "--quiet", "--locked", "--profile", "fuzz", "--example", "filter_xyz"];
  const kept = cargo(...example, "--", file, viewpoint.join(","));
  return kept
    .trim()
    .split("\n")
    .map((line) => Number(line.split(" ")[3]));
}

/** The same cloud far from the origin, as in map coordinates. */
const georeferenced = Float64Array.from(bumpySphere(4, 3000), (x, i) => x + [4.2e6, 5.5e6, 300][i % 3]!);

describe("the wasm gives the answers of native code", () => {
  it.each([
    ["the bunny, from outside", Float64Array.from(bunny()), [0, 5, 20]],
    ["the bunny, from inside", Float64Array.from(bunny()), [-1.5, 5, 0]],
    ["a bumpy sphere", Float64Array.from(bumpySphere(3, 20_000)), [3, -2, 1]],
    ["a georeferenced cloud", georeferenced, [4.2e6 + 3, 5.5e6 - 2, 301]],
  ])("for %s", (_, positions, viewpoint) => {
    const visible = new PointCloud(positions).visibleFrom(viewpoint);
    expect([...visible.indices]).toEqual(visibleNatively(positions, viewpoint));
  });
});
