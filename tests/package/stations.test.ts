// Files that say from where their points were measured: E57, PTX and PCD.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { init, PointCloud } from "hidden-point-removal";
import { type HprError, readCloud } from "hidden-point-removal/files";
import { beforeAll, describe, expect, it } from "vitest";

import { sealed } from "../files/random";
import { pcdBody, pcdHeader } from "../files/valid";

const fixture = (name: string) => new Uint8Array(readFileSync(join(import.meta.dirname, "../browser/fixtures", name)));
const buffer = (content: Uint8Array | string) => new Uint8Array(Buffer.from(content as Uint8Array)).buffer;
const refused = (content: Uint8Array | string) =>
  readCloud(buffer(content)).then(
    () => "read",
    (error: unknown) => `${(error as HprError).code}: ${(error as HprError).message}`,
  );

/** The file with other words in its description, of the same length. */
function described(file: Uint8Array, from: string, to: string): Uint8Array {
  const text = Buffer.from(file).toString("latin1");
  expect(text).toContain(from);
  return sealed(new Uint8Array(Buffer.from(text.replace(from, to.padEnd(from.length)), "latin1")));
}

describe("E57", () => {
  it("two scans: positions by their poses, colors, intensities, stations with their own points", async () => {
    const { positions, colors, columns, stations, unit, notes } = await readCloud(buffer(fixture("two-scans.e57")));
    expect(notes).toBeUndefined();
    expect(positions).toHaveLength(144);
    const [cos, sin] = [Math.cos(Math.PI / 3), Math.sin(Math.PI / 3)];
    for (let i = 0; i < 48; i++) {
      const k = i % 24;
      const [x, y, z] = [1 + k / 4, (k % 5) / 2 - 1, ((k * 7) % 11) / 8];
      const right =
        k % 12 === 11
          ? [NaN, NaN, NaN]
          : i < 24
            ? [500000.5 + cos * x - sin * y, 5400000.25 + sin * x + cos * y, 100 + z]
            : [500010 + x, 5400000 + y, 102.5 + z];
      for (let axis = 0; axis < 3; axis++) {
        expect(Math.abs(positions[3 * i + axis]! - right[axis]!) < 1e-8 || k % 12 === 11).toBe(true);
        expect(Number.isNaN(positions[3 * i + axis])).toBe(k % 12 === 11);
      }
      expect([...colors!.subarray(3 * i, 3 * i + 3)]).toEqual([10 * k, 255 - 10 * k, 7]);
      expect(columns["intensity"]![i]).toBe(k / 32);
    }
    expect(columns["rowIndex"]).toHaveLength(48);
    expect(unit).toEqual({ name: "m", meters: 1 });
    expect(stations!.map(({ viewpoint }) => viewpoint)).toEqual([
      [500000.5, 5400000.25, 100],
      [500010, 5400000, 101.5],
    ]);
    const own = (from: number) => Array.from({ length: 24 }, (_, k) => from + k).filter((k) => k % 12 !== 11);
    expect(stations!.map(({ indices }) => [...indices])).toEqual([own(0), own(24)]);
  });

  it("polar coordinates, scaled integers, fields without bits, and the coordinate system", async () => {
    const { positions, columns, crs, stations } = await readCloud(buffer(fixture("polar.e57")));
    for (let i = 0; i < 30; i++) {
      const [range, turn, up] = [2 + i / 10, i / 8, (i % 7) / 8 - 0.25];
      const right = [
        range * Math.cos(up) * Math.cos(turn),
        range * Math.cos(up) * Math.sin(turn),
        range * Math.sin(up),
      ];
      for (let axis = 0; axis < 3; axis++) expect(positions[3 * i + axis]).toBeCloseTo(right[axis]!, 12);
      expect([columns["intensity"]![i], columns["returnIndex"]![i]]).toEqual([60 * i, 0]);
    }
    expect(crs).toMatchObject({ name: "ETRS89 / UTM zone 32N", unit: { name: "m" } });
    expect(stations).toMatchObject([{ viewpoint: [0, 0, 0] }]);
  });

  it("damaged files are refused with the byte or the field, and read as far as possible if that is asked for", async () => {
    const good = fixture("two-scans.e57");
    const flipped = good.slice();
    flipped[500]! ^= 1;
    expect(await refused(flipped)).toMatch(/^load: .*checksum.*page 0/);
    const text = good.slice();
    text[3000]! ^= 1;
    expect(await refused(text)).toMatch(/^load: .*checksum.*page 2.*near byte 2048/);
    expect(await refused(good.subarray(0, 8000))).toMatch(/^load: .*truncated.*not a multiple of the page size/);
    expect(await refused(good.subarray(0, 30))).toMatch(/^load: /);
    expect(await refused(described(good, 'recordCount="24"', 'recordCount="9"'))).toBe("read");
    expect(await refused(described(good, 'recordCount="24"', 'recordCount="99"'))).toMatch(/^load: .*north: /);
    expect(
      await refused(described(good, '<w type="Float">8.66025403784438708e-01</w>', '<w type="Float">9</w>')),
    ).toMatch(/^load: .*pose/);
    expect(await refused(described(good, '<cartesianY type="Float"', '<cartesianQ type="Float"'))).toMatch(/^load: .*/);
    const longer = described(good, 'recordCount="24"', 'recordCount="99"');
    const { positions, stations, notes } = await readCloud(buffer(longer), { damaged: true });
    expect([positions.length, stations!.length]).toEqual([144, 2]);
    expect(notes!.join()).toContain("north: ");
  });
});

/** A scan of 2 columns and 3 rows; its last point is a direction. */
function scan(
  translation: number[],
  points = [
    [1, 2, 3],
    [2, 0, 1],
    [0, 1.5, 2],
    [1, 1, 1],
    [4, 0, -1],
    [0, 0, 0],
  ],
): string {
  // prettier-ignore
  const turned = ["0 1 0 0", "-1 0 0 0", "0 0 1 0", `${translation.join(" ")} 1`];
  const head = ["2", "3", translation.join(" "), "0 1 0", "-1 0 0", "0 0 1", ...turned];
  return [...head, ...points.map((point, i) => `${point.join(" ")} ${i / 8} ${i} 20 30`), ""].join("\n");
}

describe("PTX", () => {
  it("scans in one frame, colors, intensities and stations; 0 0 0 is no point", async () => {
    for (const text of [
      scan([10, 20, 1]) + scan([500000, 20, 1]),
      `${scan([10, 20, 1])}\r\n${scan([500000, 20, 1])}`,
    ]) {
      const { positions, colors, columns, stations } = await readCloud(buffer(text));
      expect([...positions.subarray(0, 6)]).toEqual([8, 21, 4, 10, 22, 2]);
      expect([...positions.subarray(15, 21)]).toEqual([NaN, NaN, NaN, 499998, 21, 4]);
      expect([...colors!.subarray(3, 6)]).toEqual([1, 20, 30]);
      expect([...columns["intensity"]!.subarray(0, 3)]).toEqual([0, 0.125, 0.25]);
      expect([...columns["scan"]!]).toEqual([0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1]);
      expect(stations).toEqual([
        { viewpoint: [10, 20, 1], indices: Uint32Array.of(0, 1, 2, 3, 4) },
        { viewpoint: [500000, 20, 1], indices: Uint32Array.of(6, 7, 8, 9, 10) },
      ]);
    }
  });

  it.each([
    ["a point too few", scan([0, 0, 0]).replace("4 0 -1 0.5 4 20 30\n", ""), /ends after 5 of the 6 points/],
    ["a word", scan([0, 0, 0]).replace("0 1.5 2", "0 1,5 2"), /line 13 is not a point/],
    ["a value too few", scan([0, 0, 0]).replace(" 3 20 30", " 3 20"), /line 14 has 6 values, and lines above have 7/],
    ["a color", scan([0, 0, 0]).replace(" 3 20 30", " 3 20 300"), /line 14 has a color that is not from 0 to 255/],
    ["a large number", scan([0, 0, 0]).replace("4 0 -1", "4 0 1e400"), /line 15 has a number out of range/],
    ["half a head", `${scan([0, 0, 0])}2\n3\n`, /ends after 2 of the 10 lines above a scan/],
    ["a matrix that scales away", scan([0, 0, 0]).replace("0 0 1 0\n", "0 0 1 2\n"), /line 10 ends a matrix/],
    ["a head that is none", scan([0, 0, 0]).replace("\n0 1 0\n", "\n0 1\n"), /line 4 should have 3 numbers/],
  ])("%s is refused with its line", async (_, text, says) => {
    expect(await refused(text)).toMatch(says);
  });
});

describe("PCD", () => {
  const file = (from: string, to: string) =>
    readCloud(buffer(Buffer.concat([Buffer.from(pcdHeader("binary").replace(from, to)), pcdBody("binary")])));

  it("has a station if its header tells of one, or if its points are a picture", async () => {
    expect((await file("", "")).stations).toBeUndefined();
    expect((await file("VIEWPOINT 0 0 0", "VIEWPOINT 1 2 3")).stations).toMatchObject([{ viewpoint: [1, 2, 3] }]);
    expect((await file("WIDTH 4\nHEIGHT 1", "WIDTH 2\nHEIGHT 2")).stations).toEqual([
      { viewpoint: [0, 0, 0], indices: Uint32Array.of(0, 1, 2, 3) },
    ]);
  });
});

describe("calibration", () => {
  beforeAll(() => init());

  it("goes with the stations of a file as they are", async () => {
    const lines = Array.from({ length: 400 }, (_, i) => {
      const [turn, up] = [(i % 40) / 20, Math.floor(i / 40) / 10 - 0.5];
      return `${5 * Math.cos(turn)} ${5 * Math.sin(turn)} ${5 * up} 0.5`;
    });
    const head = ["40", "10", "7 8 9", "1 0 0", "0 1 0", "0 0 1", "1 0 0 0", "0 1 0 0", "0 0 1 0", "7 8 9 1"];
    const { positions, stations } = await readCloud(buffer([...head, ...lines, ""].join("\n")));
    const cloud = new PointCloud(positions);
    expect(cloud.calibrate(stations!).recall[0]).toBeGreaterThanOrEqual(0.985);
    cloud.dispose();
  });
});
