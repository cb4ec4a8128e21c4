// Points that the command writes in another format than theirs.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { gzipSync } from "node:zlib";
import { readCloud } from "hidden-point-removal/files";
import { expect, it } from "vitest";

import { georeferencedBall } from "../browser/clouds";
import { las } from "../browser/formats";
import { commandIn } from "./command-support";

const { place, write, run } = commandIn("command-convert");
const fixture = (name: string) => readFileSync(join(import.meta.dirname, "../browser/fixtures", name));
/** So far away that all points are seen, but for equal ones. */
const FROM = ["--exponent", "9", "--from"];

it("LAS to PLY and back: coordinates, colors and all columns; what is lost is said", async () => {
  write("ball.las", las(georeferencedBall(600)));
  const before = await readCloud(place("ball.las"));
  const to = await run("ball.las", ...FROM, "-1e6,0,0", "-o", "ball.ply");
  expect([to.status, to.stderr]).toEqual([0, expect.stringMatching(/\d+ of 600 points are visible\n$/)]);
  const ply = await readCloud(place("ball.ply"));
  const back = await run("ball.ply", ...FROM, "-1e6,0,0", "-o", "again.las");
  expect([back.status, back.stderr]).toEqual([0, expect.not.stringMatching(/left out/)]);
  write("thirds.xyz", `0 0 ${1 / 3}\n1 0 ${2 / 3}\n0 1 0.1\n`);
  const fine = await run("thirds.xyz", ...FROM, "-1e6,0,0", "-o", "thirds.las");
  expect(fine.stderr).toMatch(/left out: digits of coordinates beyond 1e-9/);
  const after = await readCloud(place("again.las"));
  const rows = ({ positions, colors, columns }: typeof before, exact: boolean) =>
    Array.from({ length: positions.length / 3 }, (_, i) =>
      [
        ...Array.from(positions.subarray(3 * i, 3 * i + 3), (value) => (exact ? value : value.toFixed(4))),
        ...(colors?.subarray(3 * i, 3 * i + 3) ?? []),
        ...["intensity", "classification"].map((name) => columns[name]?.[i]),
      ].join(),
    ).sort();
  const known = new Set(rows(before, true));
  expect(rows(ply, true).filter((row) => !known.has(row))).toEqual([]);
  expect(rows(after, false)).toEqual(rows(ply, false).slice(0, after.positions.length / 3));
});

it("LAZ and E57 to PLY, also packed; PTX to LAS", async () => {
  write("ball.laz", fixture("ball-14.laz"));
  write("scans.e57", fixture("two-scans.e57"));
  write("scans.e57.gz", gzipSync(fixture("two-scans.e57")));
  const head = ["3", "1", "7 8 9", "1 0 0", "0 1 0", "0 0 1", "1 0 0 0", "0 1 0 0", "0 0 1 0", "7 8 9 1"];
  write("scan.ptx", [...head, "1 0 0 0.5 1 2 3", "0 0 0 0 0 0 0", "0 2 0 0.25 4 5 6", ""].join("\n"));
  for (const [input, from, output, total] of [
    ["ball.laz", "-1e6,0,0", "laz.ply", 600],
    ["scans.e57", "500005,5400003,900", "e57.ply", 48],
    ["scans.e57.gz", "500005,5400003,900", "gz.ply", 48],
    ["scan.ptx", "7,8,9", "ptx.las", 3],
  ] as const) {
    const { status, stderr } = await run(input, ...FROM, from, "-o", output);
    expect([status, stderr]).toEqual([0, expect.stringContaining(`of ${total} points are visible`)]);
  }
  const { positions, colors, columns } = await readCloud(place("e57.ply"));
  expect(positions).toHaveLength(3 * 44);
  expect([...colors!.subarray(0, 6)]).toEqual([0, 255, 7, 10, 245, 7]);
  expect(columns["scan"]).toHaveLength(44);
  expect((await readCloud(place("gz.ply"))).positions).toEqual(positions);
  expect([...(await readCloud(place("ptx.las"))).positions]).toEqual([8, 8, 9, 7, 10, 9]);
});

it("Gaussian splats to LAS, with their base colors; the summary says that they are splats", async () => {
  const names = ["x", "y", "z", "f_dc_0", "f_dc_1", "f_dc_2"];
  write(
    "splats.ply",
    ["ply", "format ascii 1.0", "element vertex 1", ...names.map((name) => `property float ${name}`), "end_header", "1 2 3 0 1 -9", ""].join("\n"), // prettier-ignore
  );
  const { status, stderr } = await run("splats.ply", "--from", "9,9,9", "-o", "splats.las");
  expect([status, stderr]).toEqual([0, expect.stringContaining("1 of 1 points are visible; it holds Gaussian splats")]);
  expect([...(await readCloud(place("splats.las"))).colors!]).toEqual([128, 199, 0]);
});
