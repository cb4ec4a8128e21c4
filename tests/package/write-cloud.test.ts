// writeCloud: what it writes, others read. tests/fuzz/foreign.ts has it read by laspy and plyfile.
import { Las } from "copc";
import { readCloud, writeCloud } from "hidden-point-removal/files";
import { PLYLoader } from "three/addons/loaders/PLYLoader.js";
import { describe, expect, it } from "vitest";

const positions = Float64Array.of(500000.5, 5400000.25, 400, 500001.5, 5400001.25, 401, 500002.5, 5400002.25, 402);
const colors = Uint8Array.of(255, 0, 10, 1, 2, 3, 128, 64, 32);
const shares = Float32Array.of(0, 0.5, 1);
const notesOf = (cloud: Parameters<typeof writeCloud>[0], format: "ply" | "las") => {
  const notes: string[] = [];
  const file = writeCloud(cloud, format, { onNote: (note) => notes.push(note) });
  return { file, notes };
};
const read = (file: Uint8Array<ArrayBuffer>) => readCloud(file.buffer);

describe("PLY", () => {
  it("three's PLYLoader reads points and colors", () => {
    const file = writeCloud({ positions: Float32Array.from(positions), colors, columns: { intensity: shares } }, "ply");
    const { attributes } = new PLYLoader().parse(file.buffer);
    expect([...attributes["position"]!.array]).toEqual([...Float32Array.from(positions)]);
    // The loader makes linear light of them.
    expect(attributes["color"]!.count).toBe(3);
    expect(attributes["color"]!.getX(0)).toBeCloseTo(1);
    expect(attributes["color"]!.getY(0)).toBe(0);
  });

  it("colors are bytes, whatever the cloud has, and other columns keep their type", async () => {
    const deep = (values: number[]) => Uint16Array.from(values);
    for (const [factor, Kind] of [
      [257, Uint16Array],
      [256, Uint16Array],
      [1 / 255, Float64Array],
      [1, Uint8Array],
    ] as const) {
      const channel = (c: number) => Kind.from([0, 1, 2].map((i) => colors[3 * i + c]! * factor));
      const columns = {
        red: channel(0),
        green: channel(1),
        blue: channel(2),
        time: positions.slice(0, 3),
        ring: deep([1, 2, 3]),
      };
      const cloud = await read(writeCloud({ positions, columns }, "ply"));
      expect(cloud.positions).toEqual(positions);
      expect([factor, ...cloud.colors!]).toEqual([factor, ...colors]);
      expect(cloud.columns["red"]).toBeInstanceOf(Uint8Array);
      expect([cloud.columns["time"], cloud.columns["ring"]]).toEqual([columns.time, columns.ring]);
    }
  });
});

describe("LAS", () => {
  it("scales an intensity to its field, and says so", async () => {
    const { file, notes } = notesOf({ positions, colors, columns: { intensity: shares } }, "las");
    expect(notes).toEqual(["the intensity of 0 to 1 is scaled to 0 to 65535"]);
    const { positions: found, colors: white, columns } = await read(file);
    expect([...found].map((value, i) => Math.abs(value - positions[i]!) < 1e-6)).not.toContain(false);
    expect(columns["intensity"]).toEqual(Uint16Array.of(0, 32768, 65535));
    expect(columns["red"]).toEqual(Uint16Array.of(65535, 257, 128 * 257));
    expect(white).toEqual(colors);
    const whole = notesOf({ positions, columns: { intensity: Uint16Array.of(1, 2, 3) } }, "las");
    expect([whole.notes, (await read(whole.file)).columns["intensity"]]).toEqual([[], Uint16Array.of(1, 2, 3)]);
    const negative = notesOf({ positions, columns: { Intensity: Float32Array.of(-2048, 0, 2047) } }, "las");
    expect((await read(negative.file)).columns["intensity"]).toEqual(Uint16Array.of(0, 32776, 65535));
    expect(negative.notes).toEqual(["the intensity of -2048 to 2047 is scaled to 0 to 65535"]);
  });

  it("no extra column has the name of a standard one, or of another", () => {
    const column = Float64Array.of(0.5, 1.5, 2.5);
    const long = "a name that is longer than LAS has room for";
    const names = ["classification", "return_number", "X", "gps_time", `${long} 1`, `${long} 2`];
    const file = writeCloud({ positions, columns: Object.fromEntries(names.map((name) => [name, column])) }, "las");
    const text = Buffer.from(file).toString("latin1");
    const described = [
      ...text.slice(375, new DataView(file.buffer).getUint32(96, true)).matchAll(/\0\0\x0a\0([ -~]{1,31})/g),
    ];
    const found = described.map(([, name]) => name!.toLowerCase().replace(/[_ ]/g, ""));
    expect(new Set(found).size).toBe(found.length);
    for (const standard of ["classification", "returnnumber", "x", "gpstime"]) expect(found).not.toContain(standard);
    expect(Las.Header.parse(file).pointCount).toBe(3);
  });

  it("leaves out points without a position, and holds any range", async () => {
    const { file, notes } = notesOf({ positions: Float64Array.of(1, 2, 3, NaN, 0, 0) }, "las");
    expect([(await read(file)).positions.length, notes]).toEqual([3, ["1 points without a position are left out"]]);
    const far = await read(writeCloud({ positions: Float64Array.of(0, 0, 0, 1e15, 0, 0) }, "las"));
    expect(far.positions[3]! / 1e15).toBeCloseTo(1, 6);
  });
});

it("takes no scale from points without a position", async () => {
  const kept = [500000.123456, 5400000.25, 7];
  for (const lost of [[], [NaN, 0, 0], [Infinity, -Infinity, 0], [0, 0, NaN]]) {
    for (const whole of [[], kept]) {
      const cloud = { positions: Float64Array.from([...whole, ...lost]) };
      expect((await read(writeCloud(cloud, "ply"))).positions).toEqual(cloud.positions);
      const las = read(writeCloud(cloud, "las"));
      if (whole.length === 0) {
        await expect(las).rejects.toThrow("it has no points");
        continue;
      }
      const { positions: found } = await las;
      expect(found).toHaveLength(3);
      expect([...found].filter((value, i) => Math.abs(value - whole[i]!) > 1e-9)).toEqual([]);
    }
  }
});

it("takes some of the points, and refuses what is no cloud", async () => {
  const some = await read(writeCloud({ positions, colors }, "ply", { indices: Uint32Array.of(2, 0) }));
  expect([...some.colors!]).toEqual([128, 64, 32, 255, 0, 10]);
  const refused = (...given: unknown[]) => {
    try {
      (writeCloud as (...args: unknown[]) => void)(...given);
    } catch (error) {
      return (error as { code?: string }).code;
    }
    return "written";
  };
  for (const given of [
    [],
    [{}, "ply"],
    [{ positions: [1, 2, 3] }, "ply"],
    [{ positions, colors: colors.subarray(3) }, "ply"],
    [{ positions, colors: Float32Array.from(colors, (byte) => byte / 255) }, "ply"],
    [{ positions, colors: Uint16Array.from(colors, (byte) => 257 * byte) }, "las"],
    [{ positions, columns: { a: shares.subarray(1) } }, "las"],
    [{ positions }, "xyz"],
    [{ positions }, "ply", { indices: Uint32Array.of(3) }],
    [{ positions }, "ply", { index: 1 }],
  ]) {
    expect(refused(...given)).toBe("option");
  }
});
