// The command with many cameras, and with their images.
import { mkdirSync } from "node:fs";
import sharp from "sharp";
import { beforeAll, describe, expect, it } from "vitest";

import { commandIn, numpy } from "./command-support";
import { bumpySphere, readyPackage } from "./support";

const { PointCloud, cameraFromThree, transfer } = await readyPackage();
const { colmapVis, readCameras } = await import("hidden-point-removal/files");
const { PerspectiveCamera } = await import("three");

const { place, read, write, lines, run } = commandIn("command-cameras");
const positions = bumpySphere(5, 2000);
const cloud = new PointCloud(positions);
const [width, height] = [64, 48];
const cameras = [0, 1, 2].map((i) => {
  const three = new PerspectiveCamera(60, width / height, 0.1, 100);
  three.position.set(3 + i, i - 1, 0.5 * i);
  three.lookAt(0, 0, 0);
  return { ...cameraFromThree(three, width, height), image: `left/shot ${i}.png` };
});
const plain = cameras.map(({ image, ...camera }) => (image === "" ? [] : camera)).flat();
const images = [0, 1, 2].map((i) => ({
  data: Uint8Array.from({ length: 3 * width * height }, (_, at) => (37 * i + 5 * at) % 256),
  width,
  height,
}));

async function done(...args: string[]): Promise<string> {
  const { status, stderr } = await run("in.xyz", ...args);
  expect(status, stderr).toBe(0);
  return stderr;
}

async function refused(...args: string[]): Promise<[number | null, string]> {
  const { status, stderr } = await run("in.xyz", ...args);
  return [status, stderr];
}

beforeAll(async () => {
  const rows = Array.from({ length: cloud.length }, (_, i) => positions.subarray(3 * i, 3 * i + 3).join(" "));
  write("in.xyz", rows.join("\n"));
  write("cameras.json", JSON.stringify(cameras));
  mkdirSync(place("images"));
  for (const [i, { data }] of images.entries()) {
    write(
      `images/shot ${i}.png`,
      await sharp(data, { raw: { width, height, channels: 3 } })
        .png()
        .toBuffer(),
    );
  }
});

describe("--cameras", () => {
  it("takes cameras wherever it takes viewpoints", async () => {
    expect(await readCameras(place("cameras.json"))).toEqual(
      plain.map((camera, i) => ({ camera, image: cameras[i]!.image })),
    );
    const any = [...cloud.visibleFromAny(plain, { looks: 3 }).indices].map(String);
    await done("--cameras", "cameras.json", "-o", "any.idx");
    expect(lines("any.idx")).toEqual(any);
    await done("--viewpoints", "cameras.json", "-o", "any.idx");
    expect(lines("any.idx")).toEqual(any);
    await done("--cameras", "cameras.json", "--coverage", "-o", "counts.npy");
    expect(numpy(read("counts.npy")).data.equals(Buffer.from(cloud.coverage(plain, { looks: 3 }).buffer))).toBe(true);
    await done("--cameras", "cameras.json", "--exponent", "3", "--format", "pixels", "-o", "{name}.csv");
    const { indices, pixels } = cloud.visibleFromCamera(plain[1]!, { exponent: 3 });
    expect(lines("shot 1.csv").length).toBe(indices.length + 1);
    expect(lines("shot 1.csv")[1]!.split(",").map(Number).map(Math.fround).slice(0, 3)).toEqual([
      indices[0],
      pixels[0],
      pixels[1],
    ]);
  });

  it("takes the size of images that the file does not say", async () => {
    const { fx, fy, cx, cy } = plain[0]!;
    const frame = {
      file_path: "a",
      transform_matrix: [0, 1, 2, 3].map((row) =>
        [0, 1, 2, 3].map((column) => cameras[0]!.cameraToWorld[4 * column + row]),
      ),
    };
    write("transforms.json", JSON.stringify({ fl_x: fx, fl_y: fy, cx, cy, frames: [frame] }));
    const [one] = await readCameras(place("transforms.json"), { width: 30, height: 20 });
    await done("--cameras", "transforms.json", "--size", "30x20", "--format", "pixels", "-o", "a.csv");
    expect(lines("a.csv").length).toBe(1 + cloud.visibleFromCamera(one!.camera, { looks: 3 }).indices.length);
    const asked = (...size: string[]) => refused("--cameras", "transforms.json", ...size, "-o", "a.idx");
    expect(await asked()).toEqual([1, expect.stringMatching(/w must be given, or width and height \(--size WxH\)/)]);
    expect(await asked("--size", "30,20")).toEqual([2, expect.stringMatching(/--size needs two numbers, as in/)]);
    expect(await refused("--from", "0,0,9", "--size", "3x2", "-o", "a.idx")).toEqual([
      2,
      expect.stringMatching(/--size needs --cameras FILE/),
    ]);
  });

  it("writes COLMAP's file of which images see each point", async () => {
    await done("--cameras", "cameras.json", "-o", "seen.vis");
    const rows = cloud.seenBy(plain, { looks: 3 });
    const file = read("seen.vis");
    expect(file.equals(colmapVis(rows))).toBe(true);
    expect(file.readBigUInt64LE(0)).toBe(BigInt(cloud.length));
    let at = 8;
    const next = () => file.readUInt32LE((at += 4) - 4);
    for (let i = 0; i < cloud.length; i++) {
      const row = Array.from({ length: next() }, next);
      expect(row).toEqual([...rows.cameras.subarray(rows.offsets[i], rows.offsets[i + 1])]);
    }
    expect(at).toBe(file.length);
    expect(() => colmapVis({ ...rows, cameras: rows.cameras.slice(1) })).toThrow(/what seenBy of a cloud answers/);
  });

  it.each<[string, unknown, RegExp]>([
    ["no list", { frames: 5 }, /frames must be an array/],
    ["an empty list", [], /wrong.json cannot be read: it has no cameras/],
    ["a field", [cameras[0], { ...cameras[1], fx: "5" }], /camera \[1\]'s fx must be a number/],
    ["a wrong name", [{ ...cameras[0], zoom: 2 }], /camera \[0\]: unknown option "zoom"/],
    ["no name", [{ ...cameras[0], image: 5 }], /cameras\[0\]\.image must be a text/],
    ["a name twice", [cameras[0], cameras[0]], /camera 2 \(left\/shot 0\.png\) has a name a second time/],
    ["a bent pose", [{ ...cameras[0], cameraToWorld: new Array(16).fill(1) }], /pose/],
  ])("%s is refused", async (_, content, says) => {
    write("wrong.json", JSON.stringify(content));
    expect(await refused("--cameras", "wrong.json", "-o", "{name}.idx")).toEqual([1, expect.stringMatching(says)]);
  });
});

describe("--images", () => {
  const colors = transfer(cloud, plain, images);

  it("writes all points with their colors, and how many cameras see each", async () => {
    await done("--cameras", "cameras.json", "--images", "images", "-o", "colored.ply");
    const file = read("colored.ply");
    const start = file.indexOf("end_header\n") + 11;
    expect(file.toString("latin1", 0, start)).toMatch(
      /element vertex 2000\n(property double [xyz]\n){3}property uchar red/,
    );
    const width = 3 * 8 + 3 + 4;
    expect(file.length).toBe(start + width * cloud.length);
    for (let i = 0; i < cloud.length; i++) {
      const at = start + width * i;
      expect(Math.fround(file.readDoubleLE(at))).toBe(positions[3 * i]);
      const color = [0, 1, 2].map((c) => Math.round(colors.values[3 * i + c]! || 0));
      expect([...file.subarray(at + 24, at + 27)]).toEqual(color);
      expect(file.readUInt32LE(at + 27)).toBe(colors.seen[i]);
    }
  });

  it("writes tables, takes labels from gray images, and merges as it is told", async () => {
    await done(
      "--cameras",
      "cameras.json",
      "--images",
      "images",
      "--merge",
      "median",
      "--weights",
      "angle",
      "-o",
      "colors.npy",
    );
    const { header, data } = numpy(read("colors.npy"));
    expect(header).toContain("'<f4', 'fortran_order': False, 'shape': (2000, 3)");
    expect(
      data.equals(Buffer.from(transfer(cloud, plain, images, { merge: "median", weights: "angle" }).values.buffer)),
    ).toBe(true);
    mkdirSync(place("labels/left"), { recursive: true });
    const masks = images.map(({ data }) => ({
      data: Uint16Array.from(data.subarray(0, width * height), (x) => 300 * (x >> 6)),
      width,
      height,
    }));
    for (const [i, { data }] of masks.entries()) {
      const gray = sharp(data, { raw: { width, height, channels: 1 } }).toColourspace("grey16");
      write(`labels/left/shot ${i}.png`, await gray.png().toBuffer());
    }
    await done("--cameras", "cameras.json", "--images", "labels", "--merge", "vote", "-o", "labels.csv");
    const votes = transfer(cloud, plain, masks, { merge: "vote" });
    expect(lines("labels.csv").slice(1).map(Number)).toEqual([...votes.values]);
    expect(Math.max(...votes.values.filter((value) => value >= 0))).toBe(900);
  });

  it.each<[string[], number, RegExp]>([
    [["--viewpoints", "p.csv", "--images", "images", "-o", "never.ply"], 2, /--images needs --cameras FILE/],
    [["--cameras", "cameras.json", "--weights", "angle", "-o", "never.xyz"], 2, /--weights needs --images DIR/],
    [
      ["--cameras", "cameras.json", "--format", "pixels", "-o", "never.csv"],
      2,
      /needs one camera, .* cameras.json has 3/,
    ],
    [["--cameras", "cameras.json", "--merge", "mean", "-o", "never.xyz"], 2, /--merge needs --images DIR/],
    [["--cameras", "cameras.json", "--images", "images", "-o", "never.las"], 2, /must end with \.ply, .* for colors/],
    [
      ["--cameras", "cameras.json", "--images", "images", "--merge", "max", "-o", "never.ply"],
      2,
      /--merge needs one of/,
    ],
    [["--cameras", "cameras.json", "--images", "nothing", "-o", "never.ply"], 1, /nothing has no image left\/shot 0/],
    [["--cameras", "cameras.json", "--images", "images", "-o", "{name}.ply"], 2, /--format colors cannot be combined/],
    [["--cameras", "cameras.json", "--images", "images", "--coverage", "-o", "never.ply"], 2, /cannot be combined/],
    [["--viewpoints", "p.csv", "--format", "vis", "-o", "never.vis"], 2, /--format vis needs --cameras FILE/],
    [
      ["--cameras", "cameras.json", "--looks", "3", "--score-threshold", "0.5", "-o", "x.idx"],
      2,
      /combined with --cameras/,
    ],
  ])("%j is refused", async (args, status, says) => {
    expect(await refused(...args)).toEqual([status, expect.stringMatching(says)]);
  });

  it("an image of another size, or a broken one, is refused by name", async () => {
    mkdirSync(place("small"));
    for (const i of [0, 1, 2]) {
      write(
        `small/shot ${i}.png`,
        await sharp({ create: { width: 3, height: 3, channels: 3, background: "red" } })
          .png()
          .toBuffer(),
      );
    }
    const args = ["--cameras", "cameras.json", "--images", "small", "-o", "never.ply"];
    expect(await refused(...args)).toEqual([
      2,
      expect.stringMatching(/images\[0\] must have the size .* 64 × 48, got 3 × 3/),
    ]);
    write("small/shot 1.png", "no image");
    expect(await refused(...args)).toEqual([1, expect.stringMatching(/small\/shot 1\.png cannot be read/)]);
  });
});
