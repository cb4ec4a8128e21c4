// The readers of files as users of the package call them.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { gzipSync } from "node:zlib";
import { pathToFileURL } from "node:url";
import { type HprError, readCloud } from "hidden-point-removal/files";
import { describe, expect, it } from "vitest";

import { georeferencedBall } from "../browser/clouds";
import { glb, inMillimeters, las, NODE_AT } from "../browser/formats";
import { Random } from "../files/random";
import { FLAT, pcdBody, pcdHeader, plyBody, plyHeader, table } from "../files/valid";

const path = (name: string) => join(import.meta.dirname, "../browser/fixtures", name);
const fixture = (name: string) => new Uint8Array(readFileSync(path(name)));
const buffer = (content: Uint8Array | string) =>
  new Uint8Array(typeof content === "string" ? Buffer.from(content) : content).buffer;
const POINTS = inMillimeters(georeferencedBall(600));

const refused = (content: Uint8Array | string) =>
  readCloud(buffer(content)).then(
    () => "read",
    (error: unknown) => `${(error as HprError).code}: ${(error as HprError).message}`,
  );

function changed(content: Uint8Array, change: (view: DataView, bytes: Uint8Array) => void): Uint8Array {
  const copy = content.slice();
  change(new DataView(copy.buffer), copy);
  return copy;
}

/** Where a LAS header says how many points there are. */
const setCount = (count: number) => (view: DataView) => {
  if (view.getUint8(104) % 64 < 6) view.setUint32(107, count, true);
  if (view.getUint8(25) === 4) view.setBigUint64(247, BigInt(count), true);
};

describe("the formats", () => {
  it("reads bytes, also those of Node's Buffer and of a part of an array", async () => {
    const bytes = Buffer.from(table(" "));
    const part = new Uint8Array(Buffer.concat([Buffer.from("9 9 9\n"), bytes])).subarray(6);
    for (const given of [bytes, part]) expect(await readCloud(given)).toEqual(await readCloud(buffer(bytes)));
  });

  it("reads files that are packed with gzip, and refuses a damaged packing", async () => {
    const plain = await readCloud(buffer(table(" ")));
    const packed = gzipSync(table(" "));
    expect(await readCloud(buffer(packed))).toEqual(plain);
    expect(
      await readCloud(buffer(Buffer.concat([gzipSync(table(" ").slice(0, 5)), gzipSync(table(" ").slice(5))]))),
    ).toEqual(plain);
    expect(await readCloud(new File([packed], "cloud.xyz.gz"))).toEqual(plain);
    const ball = fixture("ball-14.laz");
    expect(await readCloud(buffer(gzipSync(ball)))).toEqual(await readCloud(buffer(ball)));
    for (const damaged of [
      packed.subarray(0, -9),
      packed.subarray(0, 12),
      changed(packed, (view) => {
        view.setUint8(15, 0xff);
      }),
    ]) {
      expect(await refused(damaged)).toMatch(/^load: .*it is packed with gzip, and the packing is damaged/);
    }
    // Twice packed: what is inside is no format.
    expect(await refused(gzipSync(packed))).toMatch(/^load: /);
  });

  it.each(["ball-12.laz", "ball-14.laz"])("%s, from a path, a URL, a Blob and a buffer", async (name) => {
    const content = fixture(name);
    for (const source of [path(name), pathToFileURL(path(name)), new Blob([content]), buffer(content)]) {
      const { positions, colors, columns, notes } = await readCloud(source);
      expect(positions).toEqual(POINTS);
      expect(colors).toHaveLength(1800);
      expect(Object.keys(columns)).toContain("intensity");
      expect(notes).toBeUndefined();
    }
  });

  it("LAS and COPC, with all levels", async () => {
    expect((await readCloud(buffer(las(georeferencedBall(600))))).positions).toEqual(POINTS);
    const { positions } = await readCloud(path("octree.copc.laz"));
    const sorted = (numbers: ArrayLike<number>) =>
      Array.from({ length: numbers.length / 3 }, (_, i) => Array.from(numbers).slice(3 * i, 3 * i + 3).join()).sort(); // prettier-ignore
    expect(sorted(positions)).toEqual(sorted(inMillimeters(georeferencedBall(3000))));
  });

  it("PLY, PCD, tables, OBJ and glTF", async () => {
    const files = [
      Buffer.concat([Buffer.from(plyHeader("big")), plyBody("big")]),
      Buffer.concat([Buffer.from(pcdHeader("binary_compressed")), pcdBody("binary_compressed")]),
      table(";"),
      table(" ").replace(/^/gm, "v ").replace(/v $/, ""),
    ];
    for (const file of files) expect([...(await readCloud(buffer(file))).positions]).toEqual(FLAT);
    const { positions, unit } = await readCloud(buffer(glb([0, 0, 0, 2, 3, 4])));
    expect([[...positions.subarray(0, 3)], unit]).toEqual([[...NODE_AT], { name: "m", meters: 1 }]);
  });

  it("Gaussian splats: base colors and a note, unless the file has colors", async () => {
    const splats = (more: string, colors: string) =>
      ["ply", "format ascii 1.0", "element vertex 2", ...["x", "y", "z", "f_dc_0", "f_dc_1", "f_dc_2", "opacity"].map((name) => `property float ${name}`), ...(more === "" ? [] : [more]), "end_header", `0 0 1 0 1 -1 5${colors}`, `1 2 3 9 -9 0.5 -5${colors}`, ""].join("\n"); // prettier-ignore
    const { positions, colors, columns, notes } = await readCloud(buffer(splats("", "")));
    expect([...positions]).toEqual([0, 0, 1, 1, 2, 3]);
    // 255 · (0.5 + 0.2821 · f_dc), between 0 and 255.
    expect([...colors!]).toEqual([128, 199, 56, 255, 0, 163]);
    expect([...columns["f_dc_1"]!]).toEqual([1, -9]);
    expect(notes).toEqual([expect.stringContaining("Gaussian splats")]);
    const own = await readCloud(
      buffer(splats("property uchar red\nproperty uchar green\nproperty uchar blue", " 1 2 3")),
    );
    expect([...own.colors!]).toEqual([1, 2, 3, 1, 2, 3]);
    expect(own.notes).toBeUndefined();
  });

  it("a column before x, y and z that numbers the points, before colors", async () => {
    const { positions, colors, columns, notes } = await readCloud(
      buffer("7,1,2,3,9,8,7\n8,4,5,6,9,8,7\n9,7,8,9,9,8,7\n"),
    );
    expect([...positions]).toEqual([1, 2, 3, 4, 5, 6, 7, 8, 9]);
    expect([...colors!.subarray(0, 3)]).toEqual([9, 8, 7]);
    expect(columns["column 1"]).toEqual(Float64Array.of(7, 8, 9));
    expect(notes).toEqual(["x, y and z are columns 2, 3, 4"]);
  });

  it("the columns that the caller chooses", async () => {
    const file = buffer("a;b;c;d\n1;2;3;4\n5;6;7;8\n");
    const cloud = await readCloud(file, { columns: ["d", 2, "a"] });
    expect([...cloud.positions]).toEqual([4, 2, 1, 8, 6, 5]);
    expect(cloud.columns).toEqual({ c: Float64Array.of(3, 7) });
  });

  it("numbers out of range, and sources and options that are none", async () => {
    expect(await refused("1 2 3\n4 1e400 6\n")).toMatch(/^load: .*line 2 has a number out of range in column 2/);
    await expect(readCloud("nothing.ply")).rejects.toMatchObject({ code: "load" });
    await expect(readCloud(7 as never)).rejects.toMatchObject({ code: "option" });
    await expect(readCloud(buffer(""), { colums: [] } as never)).rejects.toMatchObject({ code: "option" });
    await expect(readCloud(buffer(""), { columns: ["x", "x", "y"] })).rejects.toMatchObject({ code: "option" });
    await expect(readCloud(buffer("1 2 3"), { signal: AbortSignal.abort() })).rejects.toMatchObject({
      name: "AbortError",
    });
    const shares: number[] = [];
    await readCloud(buffer(table(" ")), { onProgress: (share) => shares.push(share) });
    expect(shares).toEqual([1]);
  });
});

describe("files that contradict themselves", () => {
  it.each(["ball-12.laz", "ball-14.laz"])("%s whose header says other numbers of points", async (name) => {
    for (const count of [50_000, 610, 601, 590, 90, 2 ** 31]) {
      const file = changed(fixture(name), setCount(count));
      expect(await refused(file), String(count)).toMatch(/^load: /);
    }
    const { positions, notes } = await readCloud(buffer(changed(fixture(name), setCount(50_000))), { damaged: true });
    expect(positions).toEqual(POINTS);
    expect(notes!.length).toBeGreaterThan(0);
  });

  /** Changes the record of LAZ, which begins with the place of its contents. */
  const laszip = (name: string, change: (view: DataView, at: number) => void) =>
    changed(fixture(name), (view, bytes) => {
      change(view, Buffer.from(bytes.buffer).indexOf("laszip encoded") - 2 + 54);
    });

  it("LAZ: chunks of any size, which some writers call 0, are read; parts of a point in version 4 are refused", async () => {
    const whole = await readCloud(path("octree.copc.laz"));
    const zero = laszip("octree.copc.laz", (view, at) => {
      expect(view.getUint32(at + 12, true)).toBe(2 ** 32 - 1);
      view.setUint32(at + 12, 0, true);
    });
    expect((await readCloud(buffer(zero))).positions).toEqual(whole.positions);
    const newer = laszip("ball-14.laz", (view, at) => {
      expect(view.getUint16(at + 38, true)).toBe(3);
      view.setUint16(at + 38, 4, true);
    });
    expect(await refused(newer)).toMatch(/compressed as LAZ item version 4, which is not read/);
  });

  it("LAZ that is cut ends with an error", async () => {
    for (const name of ["ball-12.laz", "ball-14.laz"]) {
      for (const share of [0.2, 0.5, 0.9]) {
        const cut = fixture(name).subarray(0, share * fixture(name).length);
        expect(await refused(cut)).toMatch(/^load: /);
      }
    }
  });

  it("tables with lines that are no points, below the first one", async () => {
    const content = "4\n1 2 3\n4 5\n6 7 8\n9 x 1\n";
    expect(await refused(content)).toMatch(/^load: .*line 3 is not a point, it has 2 columns/);
    const { positions, notes } = await readCloud(buffer(content), { damaged: true });
    expect([...positions]).toEqual([1, 2, 3, 6, 7, 8]);
    expect(notes!.join()).toMatch(/^2 lines are left out, the first: line 3 is not a point, .*: "4 5"$/);
    await expect(readCloud(buffer("no table\n1 2 3\n"), { damaged: true })).rejects.toMatchObject({ code: "load" });
  });

  it("LAS with too many or too few points, or with other bounds", async () => {
    const good = las(georeferencedBall(600));
    expect(await refused(changed(good, setCount(599)))).toMatch(/goes on after/);
    expect(await refused(good.subarray(0, 9000))).toMatch(/ends before the 600 points/);
    const { positions, notes } = await readCloud(buffer(good.subarray(0, 9000)), { damaged: true });
    expect(positions).toEqual(POINTS.slice(0, positions.length));
    expect(notes!.join()).toContain("ends before");
    const raise = (by: number) => changed(good, (view) => {
      view.setFloat64(187, view.getFloat64(187, true) + by, true);
    }); // prettier-ignore
    expect(await refused(raise(0.1))).toMatch(/lie outside the bounds/);
    // Real writers round the bounds, or write those of a whole tile.
    expect(await refused(raise(0.001))).toBe("read");
    const tile = changed(good, (view) => {
      view.setFloat64(187, Math.floor(view.getFloat64(187, true)) - 10, true);
    });
    expect(await refused(tile)).toBe("read");
  });

  it(
    "of 300 changes of LAZ files, none is read as other points, but for the last two",
    { timeout: 120_000 },
    async () => {
      const random = new Random(28);
      const tally = { refused: 0, same: 0, other: 0 };
      for (let i = 0; i < 300; i++) {
        const good = fixture(i % 2 === 0 ? "ball-12.laz" : "ball-14.laz");
        const file = changed(good, (_, bytes) => {
          for (let changes = 1 + random.below(3); changes > 0; changes--) {
            bytes[random.below(random.below(2) === 0 ? 500 : bytes.length)] = random.below(256);
          }
        });
        const cloud = await readCloud(buffer(file)).catch((error: unknown) => {
          expect((error as HprError).code).toBe("load");
          return undefined;
        });
        if (cloud === undefined) {
          tally.refused++;
          continue;
        }
        expect(cloud.positions, `change ${i}`).toHaveLength(POINTS.length);
        // An offset may change by less than a step.
        const isSame = cloud.positions.every((value, k) => Math.abs(value - POINTS[k]!) <= 0.001);
        tally[isSame ? "same" : "other"]++;
      }
      // Nothing contradicts the last bytes of a layer, which move its last two points only.
      expect(tally.other).toBeLessThanOrEqual(1);
      expect(Math.min(tally.refused, tally.same)).toBeGreaterThan(30);
    },
  );

  it("the decoder leaves no listeners on the process", async () => {
    const listeners = () => ["uncaughtException", "unhandledRejection"].map((name) => process.listenerCount(name));
    const before = listeners();
    const broken = changed(fixture("ball-12.laz"), (_, bytes) => bytes.fill(7, 400, 3000));
    for (let i = 0; i < 12; i++) {
      await refused(broken);
      await readCloud(path("ball-12.laz"));
    }
    expect(listeners()).toEqual(before);
  });
});
