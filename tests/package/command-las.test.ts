// The command with LAS, LAZ and COPC files. Their coordinates are as large as those of UTM.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { Las } from "copc";
import { describe, expect, it } from "vitest";

import { georeferencedBall } from "../browser/clouds";
import { inMillimeters, las } from "../browser/formats";
import { commandIn } from "./command-support";
import { readyPackage } from "./support";

const { PointCloud } = await readyPackage();
const { run, write, read, lines } = commandIn("command-las");
const fixture = (name: string) => readFileSync(join(import.meta.dirname, "../browser/fixtures", name));

const POINTS = inMillimeters(georeferencedBall(600));
const VIEWPOINT = [512_345, 5_403_209, 450];
const visible = new PointCloud(POINTS).visibleFrom(VIEWPOINT, { looks: 3 }).indices;

async function filtered(name: string, content: Uint8Array, output: string, ...options: string[]): Promise<Buffer> {
  write(name, content);
  const { stderr, status } = await run(name, "--from", VIEWPOINT.join(","), "-o", output, ...options);
  expect(status, stderr).toBe(0);
  expect(stderr).toMatch(/^\d+ of \d+ points are visible\n$/);
  return read(output);
}

/** The header and the rows of a LAS file, read by another program. */
function opened(file: Buffer) {
  const header = Las.Header.parse(file);
  const { pointCount, pointDataOffset: start, pointDataRecordLength: size } = header;
  expect(file).toHaveLength(start + pointCount * size);
  const rows = Array.from({ length: pointCount }, (_, i) => file.subarray(start + i * size, start + (i + 1) * size));
  return { header, rows };
}

describe("the visible points of a LAS file are a LAS file", () => {
  it.each([
    ["LAS 1.2", las(georeferencedBall(600)), las(georeferencedBall(600))],
    ["LAS 1.4 with a value of its own", ...twice(las(georeferencedBall(600), { minor: 4, format: 7, extra: "glow" }))],
    ["LAZ 1.2", fixture("ball-12.laz"), las(georeferencedBall(600))],
    ["LAZ 1.4", fixture("ball-14.laz"), las(georeferencedBall(600), { minor: 4, format: 7 })],
  ])("%s, with all bytes of each point", async (_, content, uncompressed) => {
    const { header, rows } = opened(await filtered("ball.laz", content, "out.las"));
    const all = opened(Buffer.from(uncompressed)).rows;
    expect(rows.map((row) => row.toString("hex"))).toEqual([...visible].map((i) => all[i]!.toString("hex")));
    const bounds = (pick: typeof Math.min) =>
      [0, 1, 2].map((axis) => pick(...[...visible].map((i) => POINTS[3 * i + axis]!)));
    expect([header.min, header.max]).toEqual([bounds(Math.min), bounds(Math.max)]);
    // The ball's points say that they are the first return of their pulse.
    expect([header.pointCount, header.pointCountByReturn[0]]).toEqual([visible.length, visible.length]);
  });

  it("and of a COPC file, in the order of the file", async () => {
    const { header, rows } = opened(await filtered("tree.copc.laz", fixture("octree.copc.laz"), "out-tree.las"));
    const everything = inMillimeters(georeferencedBall(3000));
    const expected = new PointCloud(everything).visibleFrom(VIEWPOINT, { looks: 3 }).indices;
    const place = (x: number, y: number, z: number) => [x, y, z].map((value) => value.toFixed(3)).join(" ");
    const found = rows.map((row) => {
      const at = (axis: number) => row.readInt32LE(4 * axis) * header.scale[axis]! + header.offset[axis]!;
      return place(at(0), at(1), at(2));
    });
    const wanted = [...expected].map((i) => place(everything[3 * i]!, everything[3 * i + 1]!, everything[3 * i + 2]!));
    expect(found.sort()).toEqual(wanted.sort());
    expect(header.vlrCount).toBe(0);
  });

  it("the records after the points move with them", async () => {
    const plain = las(georeferencedBall(600), { minor: 4, format: 6 });
    const record = Buffer.alloc(60 + 5);
    record.write("LASF_Projection", 2, "latin1");
    record.writeUInt16LE(2112, 18);
    record.writeBigUInt64LE(5n, 20);
    record.write("WKT…", 60, "latin1");
    const file = Buffer.concat([plain, record]);
    file.writeBigUInt64LE(BigInt(plain.length), 235);
    file.writeUInt32LE(1, 243);
    write("wkt.las", file);
    expect((await run("wkt.las", "--from", VIEWPOINT.join(","), "-o", "out-wkt.las")).status).toBe(0);
    const out = read("out-wkt.las");
    const { evlrOffset, evlrCount } = Las.Header.parse(out);
    expect([evlrCount, out.subarray(evlrOffset).equals(record)]).toEqual([1, true]);
  });

  it("a viewpoint in other coordinates is noted", async () => {
    write("far.las", las(georeferencedBall(600)));
    write("far.csv", `name,x,y,z\nnear,${VIEWPOINT.join(",")}\nfar,1,1,1\nfarther,0,0,-1000\n`);
    const said = async (...args: string[]) => (await run("far.las", ...args, "-o", "far.idx")).stderr.split("\n", 2);
    const [note, summary] = await said("--from", "1,1,1.5");
    expect(note).toMatch(/^note: the viewpoint is 5,400,000 units from the cloud, whose extent is [\d,.]+$/);
    expect(summary).toMatch(/^\d+ of 600 points are visible$/);
    const [first] = await said("--viewpoints", "far.csv");
    expect(first).toMatch(/^note: the viewpoint far is .* \(of 3 viewpoints, 2 are as far\)$/);
    const cameraToWorld = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 4, 5, 6, 1];
    write("far.json", JSON.stringify({ cameraToWorld, fx: 9, fy: 9, cx: 9, cy: 9, width: 20, height: 20 }));
    expect((await said("--cameras", "far.json"))[0]).toMatch(/^note: the camera 1 is 5,400,000 units/);
    expect((await said("--from", VIEWPOINT.join(",")))[0]).toMatch(/^\d+ of 600 points/);
  });

  it("as indices, too", async () => {
    await filtered("list.laz", fixture("ball-14.laz"), "list.idx");
    expect(lines("list.idx")).toEqual([...visible].map(String));
  });
});

// page-files.test.ts has LAS files that cannot be read.
it("LAZ is not written, and columns cannot be chosen", async () => {
  write("ball.laz", fixture("ball-12.laz"));
  const refused = async (...args: string[]) => {
    const { stderr, status } = await run(...args);
    expect(status).toBe(2);
    return stderr;
  };
  expect(await refused("ball.laz", "--from", "0,0,5", "-o", "out.laz")).toMatch(
    /out\.laz must end with \.las, \.ply: points of ball\.laz are not written to \.laz/,
  );
  expect(await refused("ball.laz", "--from", "0,0,5", "-o", "out.las", "--columns", "1,2,3")).toMatch(/no meaning/);
});

function twice(file: Uint8Array): [Uint8Array, Uint8Array] {
  return [file, file];
}
