// Files that people have, and what readers of others make of them: digits, colors, columns, odd headers, damage.
import { spawnSync } from "node:child_process";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { gzipSync } from "node:zlib";
import { type HprError, readCameras, readCloud, type ReadOptions } from "hidden-point-removal/files";
import { describe, expect, it } from "vitest";

import { georeferencedBall } from "../browser/clouds";
import { las } from "../browser/formats";
import { eachFormat, literals, npy, packed } from "../files/valid";
import { root } from "../root";
import { commandIn } from "./command-support";

const { write, place, run } = commandIn("file-faults");
const reading = (content: Uint8Array | string, name = "file", options: ReadOptions = {}) =>
  readCloud(new File([typeof content === "string" ? content : Buffer.from(content)], name), options);
const refused = (content: Uint8Array | string, name?: string) =>
  reading(content, name).then(
    () => "read",
    (error: unknown) => `${(error as HprError).code}: ${(error as HprError).message}`,
  );

function ply(properties: string, rows: string, count = rows.trim().split("\n").length): string {
  const lines = properties.split(",").map((property) => `property ${property.trim()}\n`);
  return `ply\nformat ascii 1.0\nelement vertex ${count}\n${lines.join("")}end_header\n${rows}`;
}
const XYZ = "float x, float y, float z";

describe("digits and names", () => {
  it("a text keeps its digits, whatever its header says", async () => {
    const row = "694386.212 5155487.512 381.036 1699999999.123\n";
    const { positions, columns } = await reading(ply(`${XYZ}, float time`, row));
    expect([...positions]).toEqual([694386.212, 5155487.512, 381.036]);
    expect(columns["time"]).toEqual(Float64Array.of(1699999999.123));
    const pcd = `FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA ascii\n694386.212 5155487.512 381.036\n`;
    expect([...(await reading(pcd)).positions]).toEqual([694386.212, 5155487.512, 381.036]);
  });

  it("a column may have any name", async () => {
    const names = ["__proto__", "constructor", "toString", "hasOwnProperty"];
    const properties = [XYZ, ...names.map((name) => `float ${name}`)].join();
    const { columns } = await reading(ply(properties, "0 0 1 1 5 6 7\n"));
    expect(Object.keys(columns)).toEqual(names);
    expect(names.map((_, i) => Object.values(columns)[i]![0])).toEqual([1, 5, 6, 7]);
  });

  it("a number out of range is refused in every column", async () => {
    expect(await refused(ply(`${XYZ}, float a`, "0 0 1 1e999\n"))).toMatch(/line 9 has a a that is out of range/);
    expect(await refused("x,y,z,a\n0,0,1,1e999\n")).toMatch(/line 2 has a number out of range in column 4/);
    expect(await refused("v 0 0 0 1e999 0 0\n", "a.obj")).toMatch(/line 1 has a number out of range/);
  });
});

describe("colors and columns arrive", () => {
  const CLOUD_COMPARE = "//X;Y;Z;Rf;Gf;Bf;Intensity\n1\n0.5;2.5;1.5;1;0.976471;0;0.51\n";
  const NORMALS = "0.5 2.25 3.0 255 0 10 0 0 1\n1.5 2.25 3.0 0 128 10 0 0.6 0.8\n";
  const COLORS: [name: string, content: string, colors: number[]][] = [
    ["shares of CloudCompare, below a count", CLOUD_COMPARE, [255, 249, 0]],
    ["colors and a normal without names", NORMALS, [255, 0, 10, 0, 128, 10]],
    ["colors and a number without names", "0 0 0 255 10 3 0.5\n1 1 1 25 10 3 0.75\n", [255, 10, 3, 25, 10, 3]],
    ["a normal and colors without names", "0 0 0 0 0 1 1 2 3\n1 1 1 0 1 0 4 5 6\n", [1, 2, 3, 4, 5, 6]],
    ["bytes times 256", "x,y,z,red,green,blue\n0,0,0,65280,256,0\n", [255, 1, 0]],
    ["bytes times 257", "x,y,z,red,green,blue\n0,0,0,65535,257,0\n", [255, 1, 0]],
    ["names in capitals", ply(`${XYZ}, uchar Red, uchar Green, uchar Blue`, "0 0 0 9 8 7\n"), [9, 8, 7]],
    ["one letter", ply(`${XYZ}, uchar R, uchar G, uchar B`, "0 0 0 9 8 7\n"), [9, 8, 7]],
    ["diffuse", ply(`${XYZ}, uchar diffuse_red, uchar diffuse_green, uchar diffuse_blue`, "0 0 0 9 8 7\n"), [9, 8, 7]],
    ["scalar fields", ply(`${XYZ}, float scalar_R, float scalar_G, float scalar_B`, "0 0 0 9 8 7\n"), [9, 8, 7]],
  ];
  it.each(COLORS)("%s", async (_, content, colors) => {
    expect([...(await reading(content)).colors!]).toEqual(colors);
  });

  it("points without a color are white, with a note", async () => {
    const { colors, notes } = await reading("v 0 0 0 1 0 0\nv 1 0 0\n", "a.obj");
    expect([...colors!]).toEqual([255, 0, 0, 255, 255, 255]);
    expect(notes).toEqual(["1 of its points have no color: they are white"]);
    const table = await reading("x,y,z,red,green,blue\n0,0,0,1,2,200\n1,1,1,,,\n");
    expect([...table.colors!]).toEqual([1, 2, 200, 255, 255, 255]);
  });

  it("numbers of points are no x, with gaps and in any order of easting and northing", async () => {
    const gaps =
      "100,5155487.50,694386.20,381.0,TOPO\n101,5155487.51,694386.21,381.0,TOPO\n106,5155487.53,694386.23,381.0,TOPO\n";
    const { positions, notes } = await reading(gaps);
    expect([...positions.slice(0, 3)]).toEqual([5155487.5, 694386.2, 381]);
    expect(notes!.join()).toMatch(/not read, since they are no single numbers: column 5/);
    expect([...(await reading("E,N,Z\n1,2,3\n")).positions]).toEqual([1, 2, 3]);
    expect([...(await reading("E,N,H\n1,2,3\n")).positions]).toEqual([1, 2, 3]);
    expect([...(await reading("Point,N,E,Z\n7,2,1,3\n")).positions]).toEqual([1, 2, 3]);
    const veloview = "intensity,Points_m_XYZ:0,Points_m_XYZ:1,Points_m_XYZ:2\n9,1,2,3\n";
    expect([...(await reading(veloview)).positions]).toEqual([1, 2, 3]);
  });

  it("extra bytes of LAS after a vector", async () => {
    const file = Buffer.from(las(georeferencedBall(5), { minor: 4, format: 6, extra: "glow" }));
    const description = file.indexOf("glow") - 4;
    const type = file[description + 2]!;
    const { columns } = await reading(file);
    // The same four bytes as two numbers of two bytes.
    expect([type, columns["glow"]!.length]).toEqual([9, 5]);
    file[description + 2] = 13;
    const both = (await reading(file)).columns;
    const bytes = new Uint16Array(columns["glow"]!.buffer);
    expect([both["glow 1"]![3], both["glow 2"]![3]]).toEqual([bytes[6], bytes[7]]);
  });
});

describe("odd headers of LAS are noted", () => {
  const good = las(georeferencedBall(600), { minor: 4, format: 6 });
  const changed = (change: (view: DataView) => void) => {
    const copy = good.slice();
    change(new DataView(copy.buffer));
    return copy;
  };
  const start = new DataView(good.buffer).getUint32(96, true);

  it("a box that is wider than the points, and off their grid", async () => {
    const wide = changed((view) => {
      view.setFloat64(187, view.getFloat64(187, true) - 7.00037, true);
    });
    const { positions, notes } = await reading(wide);
    expect([positions.length / 3, notes]).toEqual([600, [expect.stringMatching(/bounds in its header are wider/)]]);
  });

  it("stale places of records after the points", async () => {
    const none = changed((view) => {
      view.setBigUint64(235, BigInt(start + 900), true);
    });
    expect((await reading(none)).notes).toBeUndefined();
    for (const stale of [
      (view: DataView) => {
        view.setBigUint64(235, BigInt(start + 900), true);
        view.setUint32(243, 1, true);
      },
      (view: DataView) => {
        view.setBigUint64(227, BigInt(start + 900), true);
      },
    ]) {
      const { positions, notes } = await reading(changed(stale));
      expect([positions.length / 3, notes]).toEqual([600, [expect.stringMatching(/records begin among its points/)]]);
    }
  });

  it("degrees are noted, and refused by the command", async () => {
    const wkt =
      'GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]]';
    const head = Buffer.alloc(54);
    head.write("LASF_Projection", 2);
    head.writeUInt16LE(2112, 18);
    head.writeUInt16LE(wkt.length + 1, 20);
    const file = Buffer.concat([good.subarray(0, start), head, Buffer.from(`${wkt}\0`), good.subarray(start)]);
    file.writeUInt32LE(start + 54 + wkt.length + 1, 96);
    file.writeUInt32LE(file.readUInt32LE(100) + 1, 100);
    expect((await reading(file)).notes!.join()).toMatch(/degrees of longitude and latitude: project them/);
    write("degrees.las", file);
    write("degrees.csv", "lon,lat,height\n11,48,500\n");
    for (const name of ["degrees.las", "degrees.csv"]) {
      const { status, stderr } = await run(name, "--from", "0,0,5", "-o", "out.ply");
      expect([status, stderr]).toEqual([1, expect.stringMatching(/longitude and latitude/)]);
    }
  });
});

describe("damaged files are read as far as they go", () => {
  const rows = Float32Array.from({ length: 30 }, (_, i) => i);
  const body = Buffer.from(rows.buffer);
  const head =
    "ply\nformat binary_little_endian 1.0\nelement vertex 10\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  const pcd =
    "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 10\nHEIGHT 1\nPOINTS 10\nDATA binary\n";
  // All x, all y, all z: without its last bytes, the last points have no z.
  const columns = Float32Array.from({ length: 30 }, (_, i) => rows[3 * (i % 10) + Math.floor(i / 10)]!);
  const packedRows = packed(literals(Buffer.from(columns.buffer)), 120);
  const lines = Array.from({ length: 10 }, (_, i) => `${i} ${i + 1} ${i + 2} 0.5\n`);
  const ptx = "2\n5\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";
  const CUT: [name: string, content: Uint8Array | string, points: number][] = [
    ["a.ply", Buffer.concat([Buffer.from(head), body.subarray(0, 109)]), 9],
    ["b.pcd", Buffer.concat([Buffer.from(pcd), body.subarray(0, 109)]), 9],
    [
      "packed.pcd",
      Buffer.concat([Buffer.from(pcd.replace("binary", "binary_compressed")), packedRows.subarray(0, -5)]),
      8,
    ],
    ["c.ply", ply(XYZ, "1 2 3\n4 5 6\n7 8\n", 10), 2],
    ["d.ptx", ptx + lines.slice(0, 9).join(""), 9],
    ["e.pts", `10\n${lines.slice(0, 9).join("")}`, 9],
  ];
  it.each(CUT)("%s", async (name, content, points) => {
    expect(await refused(content, name)).toMatch(/^load: .*\(\{ damaged: true \} reads (what is there|the others)\)$/);
    const { positions, notes } = await reading(content, name, { damaged: true });
    expect([positions.length / 3, notes!.length]).toEqual([points, expect.any(Number)]);
    expect(notes!.length).toBeGreaterThan(0);
  });
});

describe("rows of numbers with hardly a header", () => {
  const four = Float32Array.of(1, 2, 3, 0.5, 4, 5, 6, 0.25);
  const bytes = (numbers: ArrayBufferView) => new Uint8Array(numbers.buffer as ArrayBuffer);
  const colmap = Buffer.alloc(8 + 51 + 16 + 51);
  colmap.writeBigUInt64LE(2n);
  for (const [at, x, track] of [
    [8, 1, 2],
    [75, 4, 0],
  ] as const) {
    [x, x + 1, x + 2].forEach((value, axis) => colmap.writeDoubleLE(value, at + 8 + 8 * axis));
    colmap.set([x, 20, 30], at + 32);
    colmap.writeBigUInt64LE(BigInt(track), at + 43);
  }
  const text =
    "# 3D point list with one line of data per point:\n#   POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)\n";
  const doubles = Float64Array.of(1, 2, 3, 4, 5, 6);
  const FILES: [name: string, content: Uint8Array | string, column?: [name: string, values: number[]]][] = [
    ["0000.bin", bytes(four), ["intensity", [0.5, 0.25]]],
    ["gaps.bin", bytes(Float32Array.of(1, 2, 3, NaN, 4, 5, 6, 0)), ["intensity", [NaN, 0]]],
    ["top.pcd.bin", bytes(Float32Array.of(1, 2, 3, 0.5, 7, 4, 5, 6, 0.25, 8)), ["ring", [7, 8]]],
    ["a.npy", npy("'<f8'", "2, 3", doubles)],
    ["b.npy", npy("'<f4'", "1, 2, 4", four), ["column 4", [0.5, 0.25]]],
    ["c.npy", npy("'<f8'", "2, 3", Float64Array.of(1, 4, 2, 5, 3, 6), "True")],
    ["d.npy", npy("'>i2'", "2, 3", Uint8Array.of(0, 1, 0, 2, 0, 3, 0, 4, 0, 5, 0, 6))],
    [
      "e.npy",
      npy("[('i', '|u1'), ('x', '|i1'), ('y', '|i1'), ('z', '|i1')]", "2,", Uint8Array.of(9, 1, 2, 3, 8, 4, 5, 6)),
      ["i", [9, 8]],
    ],
    ["points3D.bin", colmap, ["red", [1, 4]]],
    ["points3D.txt", `${text}9 1 2 3 7 8 9 .5 1 7\n8 4 5 6 5 8 9 .5 1 7 2 9\n`, ["red", [7, 5]]],
  ];
  it.each(FILES)("%s", async (name, content, column) => {
    const { positions, columns, colors } = await reading(content, name);
    expect([...positions]).toEqual([1, 2, 3, 4, 5, 6]);
    if (column !== undefined) expect([...columns[column[0]]!]).toEqual(column[1]);
    expect(colors !== undefined).toBe(name.startsWith("points3D"));
    write(name, content);
    expect((await run(name, "--from", "9,9,9", "-o", "out.ply")).status).toBe(0);
    // Any change of a byte is read, or refused in words.
    for (let at = 0; at < Math.min(content.length, 300); at++) {
      const changed = Buffer.from(content);
      changed[at]! ^= 1 << (at % 8);
      expect(await refused(changed, name)).toMatch(/^(read|load: .* cannot be read: .*)$/);
    }
  });

  it.each<[string, Uint8Array | string, RegExp]>([
    ["a.bin", "hello world, this is a text of 32", /does not hold 4 or 5 floats/],
    ["a.bin", Uint8Array.from({ length: 64 }, (_, i) => i * 37), /does not hold 4 or 5 floats/],
    ["images.bin", bytes(four), /readCameras reads it/],
    ["a.npy", npy("'<f8'", "3, 2", doubles), /its shape is \(3, 2\)/],
    ["a.npy", npy("'<f8'", "6,", doubles), /its shape is \(6,\)/],
    ["a.npy", npy("'|O'", "2, 3", doubles), /the type "\|O", which is not read/],
    ["a.npy", npy("'<f8'", "3, 3", doubles), /ends after 2 of the 3 points/],
    ["a.npy", "\u0093NUMPY", /it is XML|header of NumPy|cannot be read/],
  ])("%s is refused: %#", async (name, content, says) => {
    expect(await refused(content, name)).toMatch(says);
  });
});

describe("what a file is", () => {
  it.each<[Uint8Array | string, RegExp]>([
    ["PK\x03\x04...", /it is a ZIP archive/],
    [Uint8Array.of(0xff, 0xd8, 0xff, 0xe0), /it is an image/],
    ["pnts\x01\0\0\0", /it is a tile of 3D Tiles/],
    [gzipSync(gzipSync("1 2 3\n")), /it is packed twice with gzip/],
    ["ncols 2\nnrows 1\nxllcorner 0\n1 2\n", /it is a grid of heights/],
    ["%PDF-1.7", /it is a PDF document/],
    ['{"asset":{"version":"1.0"}}', /it is a glTF file; its name must end with .gltf/],
    ['{"bounds":[],"dataType":"laszip","hierarchyType":"json"}', /EPT octree/],
    ["<html><body>404</body></html>", /XML or a page of the web/],
  ])("%s", async (content, says) => {
    expect(await refused(content)).toMatch(says);
  });

  it("glTF 1.0", async () => {
    expect(await refused('{"asset":{"version":"1.0"}}', "a.gltf")).toMatch(
      /version is 1\.0, and only version 2 is read/,
    );
  });
});

describe("a packing is refused before it takes memory", () => {
  const fixture = (name: string) => readFileSync(join(root, "tests/browser/fixtures", name));
  const [MANY, LARGE, FEW] = [2_000_000_000, 4_000_000, 1000];
  /** A length at the end of a packing. */
  const promising = (file: Buffer, length: number) => {
    const copy = Buffer.from(file);
    copy.writeUInt32LE(length, copy.length - 4);
    return copy;
  };
  /** Points of LAZ that promise to be many, in the header and in their chunk. */
  const laz = (name: string) => {
    const file = Buffer.from(fixture(name));
    const [points, rowBytes, isLayered] = [file.readUInt32LE(96), file.readUInt16LE(105), file[25] === 4];
    file.writeUInt32LE(MANY, 107);
    if (isLayered) {
      file.writeBigUInt64LE(BigInt(MANY), 247);
      file.writeUInt32LE(MANY, points + 8 + rowBytes);
    }
    // The number of points in each chunk.
    file.writeUInt32LE(2 ** 31, file.indexOf("laszip encoded") + 52 + 12);
    return file;
  };
  const copc = () => {
    const file = Buffer.from(fixture("octree.copc.laz"));
    const page = Number(file.readBigUInt64LE(375 + 54 + 40));
    // The entry of the root begins with four zeros.
    const entries = Array.from({ length: 17 }, (_, i) => page + 32 * i);
    const entry = entries.find((at) => file.subarray(at, at + 16).every((byte) => byte === 0))!;
    file.writeBigUInt64LE(file.readBigUInt64LE(247) + BigInt(LARGE - file.readInt32LE(entry + 28)), 247);
    file.writeInt32LE(LARGE, entry + 28);
    file.writeUInt32LE(LARGE, Number(file.readBigUInt64LE(entry + 16)) + file.readUInt16LE(105));
    return file;
  };
  /** Zeros in so many views, each of them packed with meshopt from the same bytes. The count is that of whole blocks. */
  const meshopt = (views: number, count: number) => {
    const packing = Buffer.alloc((count / 256) * 4 * 12 + 33);
    packing[0] = 0xa0;
    const packed = { buffer: 0, byteLength: packing.length, byteStride: 12, count, mode: "ATTRIBUTES" };
    return JSON.stringify({
      asset: { version: "2.0" },
      extensionsRequired: ["EXT_meshopt_compression"],
      scenes: [{ nodes: [0] }],
      nodes: [{ mesh: 0 }],
      meshes: [{ primitives: Array.from({ length: views }, (_, i) => ({ attributes: { POSITION: i } })) }],
      accessors: Array.from({ length: views }, (_, i) => ({
        bufferView: i,
        componentType: 5126,
        count: 1,
        type: "VEC3",
      })),
      bufferViews: Array.from({ length: views }, () => ({
        buffer: 1,
        byteLength: 12 * count,
        extensions: { EXT_meshopt_compression: packed },
      })),
      buffers: [{ uri: `data:;base64,${packing.toString("base64")}` }, { byteLength: 12 * count }],
    });
  };
  /** Zeros, of which one run after the first byte repeats the byte before 264 times. */
  const pcd = (points: number) => {
    const runs = Buffer.alloc(3 * Math.ceil((12 * points) / 264), Buffer.of(0xe0, 255, 0));
    const head = `FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH ${points}\nHEIGHT 1\nPOINTS ${points}\nDATA binary_compressed\n`;
    return Buffer.concat([Buffer.from(head), packed(Buffer.concat([Buffer.of(0, 0), runs]), 12 * points)]);
  };
  const zeros = gzipSync(Buffer.alloc(300_000_000));
  const lines = gzipSync(Buffer.alloc(100_000_000, "1 2 3\n"));
  const BOMBS: [name: string, content: Buffer | string, says: RegExp][] = [
    ["zeros.xyz.gz", zeros, /the packing is damaged, .*holds 300,000,000 bytes; unpack it first/],
    ["lines.xyz.gz", lines, /holds 100,000,000 bytes; unpack it first/],
    ["large.xyz.gz", promising(lines, MANY), /holds 2,000,000,000 bytes; unpack it first/],
    ["lying.xyz.gz", promising(zeros, FEW), /has several parts, or holds 67,1\d\d,\d\d\d bytes; unpack it first/],
    [
      "parts.xyz.gz",
      Buffer.concat([zeros, gzipSync("")]),
      /has several parts, or holds 67,1\d\d,\d\d\d bytes; unpack it first/,
    ],
    ["old.laz", laz("ball-12.laz"), /promises 2000000000 points in \d+ bytes/],
    ["layered.laz", laz("ball-14.laz"), /promises 2000000000 points in \d+ bytes/],
    ["octree.copc.laz", copc(), /node 0-0-0-0 promises 4000000 points in \d+ bytes/],
    ["one.gltf", meshopt(1, 256 * 40_000), /its compressed views promise 122880000 bytes in \d+/],
    ["many.gltf", meshopt(50, 256 * 20_000), /its compressed views promise 122880000 bytes in \d+/],
    ["a.pcd", pcd(1e7), /it promises 120000000 bytes in \d+; write it without compression/],
  ];
  it.each(BOMBS)("%s", (name, content, says) => {
    write(name, content);
    const entry = (file: string) => JSON.stringify(pathToFileURL(join(root, "dist", file)).href);
    const script = `
      const path = ${JSON.stringify(place(name))};
      const { init } = await import(${entry("index.js")});
      await init();
      const { openAsBlob } = await import("node:fs");
      const { openOctree } = await import(${entry("stream.js")});
      const { readCloud } = await import(${entry("files.js")});
      const octree = async () => {
        const opened = await openOctree(await openAsBlob(path));
        for await (const step of opened.visibleFrom([512345, 5403222.3, 431.6], { radius: 1e6, budget: 1e8 }));
      };
      const before = process.resourceUsage().maxRSS;
      const read = path.includes(".copc") ? octree() : readCloud(path);
      const says = await read.then(() => "read", ({ code, message }) => code + ": " + message);
      console.log(JSON.stringify([says, (process.resourceUsage().maxRSS - before) / 1000]));`;
    const { stdout, stderr } = spawnSync(process.execPath, ["--input-type=module", "-e", script], { cwd: root });
    expect(stderr.toString()).toBe("");
    const [message, megabytes] = JSON.parse(stdout.toString()) as [string, number];
    expect(message).toMatch(says);
    expect(message).toMatch(/^load: /);
    expect(megabytes).toBeLessThan(300);
    console.log(`${name}: ${Math.round(megabytes)} MB`);
  });
});

describe("glTF", () => {
  const buffer = Buffer.from(Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0).buffer);
  const scene = (uri: string | undefined, accessor: object = { bufferView: 0 }) =>
    JSON.stringify({
      asset: { version: "2.0" },
      scenes: [{ nodes: [0] }],
      nodes: [{ mesh: 0, translation: [1, 2, 3], scale: [2, 2, 2] }],
      meshes: [{ primitives: [{ mode: 0, attributes: { POSITION: 0 } }] }],
      accessors: [{ componentType: 5126, count: 3, type: "VEC3", ...accessor }],
      bufferViews: [{ buffer: 0, byteLength: 36 }],
      buffers: [{ byteLength: 36, ...(uri !== undefined && { uri }) }],
    });
  const PLACED = [1, 2, 3, 3, 2, 3, 1, 4, 3];

  it("holds its numbers, or has them beside", async () => {
    const embedded = scene(`data:application/octet-stream;base64,${buffer.toString("base64")}`);
    expect([...(await reading(embedded, "a.gltf")).positions]).toEqual(PLACED);
    write("my points.bin", buffer);
    write("beside.gltf", scene("my%20points.bin"));
    expect([...(await readCloud(place("beside.gltf"))).positions]).toEqual(PLACED);
  });

  it("reads no other files, and asks no server", async () => {
    for (const uri of [
      "https://example.org/a.bin",
      "../a.bin",
      "/etc/passwd",
      "a/../../b.bin",
      "%2e%2e/a.bin",
      "file:///etc/passwd",
    ]) {
      write("away.gltf", scene(uri));
      await expect(readCloud(place("away.gltf"))).rejects.toThrow(/only files beside it are read/);
    }
    await expect(reading(scene("a.bin"), "a.gltf")).rejects.toThrow(/export it as one GLB file/);
  });

  it("promises no more vertices than it holds", async () => {
    const uri = `data:;base64,${buffer.toString("base64")}`;
    expect(await refused(scene(uri, { count: 2e7 }), "a.gltf")).toMatch(/promises 20000000 values and holds 0/);
    expect(await refused(scene(uri, { bufferView: 0, count: 4 }), "a.gltf")).toMatch(/more than its bytes hold/);
  });
});

describe("cameras", () => {
  const OPENCV = (matrix: string) =>
    `%YAML:1.0\nimage_width: 1242\nimage_height: 375\ncamera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   data: [ ${matrix} ]\n`;
  const pose = (x: number | string) =>
    `[{"cameraToWorld":[1,0,0,0,0,1,0,0,0,0,1,0,${x},0,0,1],"fx":9,"fy":9,"cx":5,"cy":5,"width":9,"height":9}]`;
  it.each([
    ["calib.txt", "P2: 700 50 600 0 0 710 180 0 0 0 1 0\n", /skew, or a third row/],
    ["calib.txt", "P2: 700 0 600 0 0 710 180 0 0 0 2 0\n", /skew, or a third row/],
    ["calib.txt", "P2: 700 0 600 0 0 710 180 0 .1 0 1 0\n", /skew, or a third row/],
    ["c.yaml", OPENCV("700, 0, 600, 0, 710, 180, 0, 0, 2"), /third row of camera_matrix, which must be 0 0 1/],
    ["c.yaml", OPENCV("700, 0, 600, 3, 710, 180, 0, 0, 1"), /has 3 for the skew/],
    ["c.json", pose("1e999"), /not finite/],
    ["points3D.txt", "# 3D point list with one line of data per point:\n", /COLMAP's points, not its cameras/],
  ])("%s: %s", async (name, content, says) => {
    await expect(readCameras(new File([content], name))).rejects.toThrow(says);
  });

  it("an image outside of its folder is refused", async () => {
    mkdirSync(place("photos"), { recursive: true });
    write("a.xyz", "0 0 1\n1 0 0\n0 1 0\n1 1 1\n");
    writeFileSync(place("secret.png"), "");
    for (const image of ["../secret", "..\\secret", place("secret.png")]) {
      write("cam.json", JSON.stringify([{ ...(JSON.parse(pose(0)) as object[])[0], image }]));
      const { status, stderr } = await run("a.xyz", "--cameras", "cam.json", "--images", "photos", "-o", "col.csv");
      expect([status, stderr]).toEqual([1, expect.stringMatching(/lies outside of photos/)]);
    }
  });
});

describe("in a process of its own, each format is read without a request and without a word", () => {
  const RUNTIMES = [
    [process.execPath, "--input-type=module", "-e"],
    ["deno", "eval"],
  ].filter(([program]) => {
    const isThere = spawnSync(program!, ["--version"]).status === 0;
    if (!isThere) console.log(`skipped ${program}: there is none`);
    return isThere;
  });
  const files = eachFormat();
  const cases = RUNTIMES.flatMap((runtime) => Object.keys(files).map((name) => [name, runtime] as const));
  it.each(cases)("%s: %o", (name, [program, ...args]) => {
    write(name, files[name]!);
    const module = pathToFileURL(join(root, "dist/files.js")).href;
    const script = `
      globalThis.fetch = () => { console.log("a request"); return Promise.reject(new Error("no network")); };
      globalThis.addEventListener?.("unhandledrejection", () => console.log("unhandled"));
      globalThis.process?.on("unhandledRejection", () => console.log("unhandled"));
      const { readCloud } = await import(${JSON.stringify(module)});
      await readCloud(${JSON.stringify(place(name))}).then(({ positions }) => console.log(positions.length > 0), (error) => console.log(error.code));`;
    const { stdout, stderr, status } = spawnSync(program!, [...args, script], { cwd: root });
    const says = name.startsWith("broken") ? "load\n" : "true\n";
    expect([status, stdout.toString(), stderr.toString()]).toEqual([0, says, ""]);
  });
});
