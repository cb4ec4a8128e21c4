// What the page reads of whole files. tests/browser opens a few of them by hand.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { expect, it } from "vitest";

import { readCloud } from "../../www/loaders/read";
import {
  asciiPly,
  ball,
  binaryPly,
  georeferencedBall,
  meshObj,
  meshPly,
  pcd,
  rows,
  text,
  utf16,
} from "../browser/clouds";
import { glb, gltf, inMillimeters, las, moved } from "../browser/formats";
import { readAsPage } from "../files/read";

type Positions = Float32Array | Float64Array;

const near = ball(600);
const far = inMillimeters(georeferencedBall(600));
const lines = (positions: ArrayLike<number>, separator: string) =>
  rows(positions)
    .map((row) => row.join(separator))
    .join("\n");
const capitals = (file: Uint8Array) =>
  text(new TextDecoder().decode(file).replace(/float ([xyz])/g, (_, axis: string) => `float ${axis.toUpperCase()}`));
const table = (head: string, line: (row: number[], i: number) => string) =>
  text(`${head}\n${rows(far).map(line).join("\n")}`);

it.each<[string, Uint8Array, Positions]>([
  ["mesh.ply", meshPly(near), near],
  ["big.ply", binaryPly(near, "float", false), near],
  ["capitals.ply", capitals(asciiPly(near)), near],
  ["ascii.pcd", pcd(near, "ascii"), near],
  ["binary.pcd", pcd(near, "binary"), near],
  ["colored.txt", text(`# x y z r g b\n${lines(near, "\t").replaceAll("\n", "\t200\t100\t50\n")}\t1\t2\t3\n`), near],
  ["counted.txt", text(`600\n${lines(far, " ").replaceAll("\n", " 17 200 100 50\n")} 17 1 2 3\n`), far],
  ["table.csv", table('id,z,"Y",x', ([x, y, z], i) => `${i},${z},${y},${x}`), far],
  ["survey.csv", table("point_id,time,x_m,y_m,z_m", (row, i) => `${i},${i / 8},${row.join()}`), far],
  ["units.txt", text(`//X [m] Y [m] Z [m]\n${lines(far, " ")}`), far],
  ["wide.csv", utf16(`x,y,z\r\n${lines(near, ",")}`), near],
  ["european.csv", text(lines(far, ";").replaceAll(".", ",")), far],
  ["mesh.obj", meshObj(far), far],
  ["oldest.las", las(far, { minor: 0, format: 0 }), far],
  ["timed.las", las(far, { minor: 1, format: 1 }), far],
  ["usual.las", las(far, { minor: 3, format: 3 }), far],
  ["newest.las", las(far, { minor: 4, format: 6 }), far],
  ["infrared.las", las(far, { minor: 4, format: 8, extra: "height above ground" }), far],
  ["colored.glb", glb(near, { colors: true }), moved(near)],
  ["mesh.glb", glb(near, { mode: 4 }), moved(near)],
  [
    "twice.glb",
    glb(near.subarray(0, 900), { twice: true }),
    Float64Array.of(...moved(near.subarray(0, 900)), ...moved(near.subarray(0, 900).map((value) => 2 * value))),
  ],
])("%s is read with the file's own coordinates", async (name, content, positions) => {
  expect(await readAsPage(name, content)).toEqual({ points: [...positions] });
});

const objLines = lines(near, " ").replace(/^/gm, "v ");
it.each<[string, Uint8Array, Positions, string]>([
  ["cloud.las", las(far), far, "3rd"],
  ["cloud.ply", binaryPly(near, "float", false), near, "3rd"],
  ["text.ply", asciiPly(near), near, "3rd"],
  ["cloud.pcd", pcd(near, "binary"), near, "3rd"],
  ["packed.pcd", pcd(near, "binary_compressed"), near, "3rd"],
  ["cloud.glb", glb(near), moved(near), "3rd"],
  // A text does not give the number of points first. So every second point is dropped, as often as needed.
  ["cloud.xyz", text(lines(near, " ")), near, "4th"],
  ["cloud.obj", text(objLines), near, "4th"],
])("of %s with more points than allowed, every n-th is read, and a note says so", async (name, content, all, nth) => {
  const { positions, notes } = await readCloud({ name, blob: new Blob([new Uint8Array(content)]), limit: 200 });
  const step = Number.parseInt(nth);
  expect([...positions]).toEqual([...all].filter((_, i) => Math.floor(i / 3) % step === 0));
  expect(notes).toEqual([`Every ${nth} of its 600 points is shown.`]);
});

type Field = "setUint8" | "setUint16" | "setUint32" | "setFloat64";
/** The file with another number in it. */
const changed = (content: Uint8Array, at: number, value: number, field: Field) => {
  const copy = content.slice();
  new DataView(copy.buffer)[field](at, value, true);
  return copy;
};
const packed = pcd(near, "binary_compressed");
const swapped = (file: Uint8Array) =>
  Buffer.concat([file.slice(0, -12 * 600), binaryPly(near, "float", false).slice(-12 * 600)]);
const fixture = (name: string) => new Uint8Array(readFileSync(join(import.meta.dirname, "../browser/fixtures", name)));
const laz = fixture("ball-12.laz");

it.each<[string, Uint8Array, RegExp]>([
  ["cut.las", las(far).slice(0, 9000), /cannot be read: it ends before the 600 points that its header promises/],
  ["boast.las", las(far, { minor: 4, format: 6, claimed: 1e12 }), /it ends before the 1,000,000,000,000 points/],
  ["stub.las", las(far).slice(0, 100), /cannot be read: it ends within its LAS header/],
  ["none.las", las([]), /it has no points/],
  ["version.las", changed(las(far), 25, 9, "setUint8"), /its LAS version is 1\.9/],
  ["format.las", changed(las(far), 104, 33, "setUint8"), /its LAS points have an unknown format \(33\)/],
  ["rows.las", changed(las(far), 105, 12, "setUint16"), /points are shorter than their format/],
  ["header.las", changed(las(far), 96, 4e9, "setUint32"), /points would begin after its end/],
  ["scale.las", changed(las(far), 139, NaN, "setFloat64"), /has no usable scale and offset/],
  ["offset.las", changed(las(far), 94, 3, "setUint16"), /the sizes in its LAS header are impossible/],
  ["swapped.las", text("FSAL and so on"), /it does not begin like a LAS file/],
  ["formats.laz", changed(changed(laz, 104, 128 + 4, "setUint8"), 105, 57, "setUint16"), /describe different points/],
  ["cut.laz", laz.slice(0, 3000), /cannot be read: it ends before the 600 points/],
  ["draco.glb", glb(near, { required: ["KHR_draco_mesh_compression"] }), /is compressed with Draco, which is not read/],
  ["unknown.glb", glb(near, { required: ["EXT_of_tomorrow"] }), /needs an extension .* \(EXT_of_tomorrow\)/],
  ["cut.glb", glb(near).slice(0, 3000), /it is shorter than its header says/],
  ["version.glb", changed(glb(near), 4, 1, "setUint32"), /its glTF version is 1/],
  ["json.glb", glb(near).fill(0x21, 20, 60), /the description of its scene cannot be read/],
  ["nothing.gltf", text("{}"), /it does not give its glTF version/],
  ["empty.glb", glb([]), /its accessor 0 is missing, or has no count/],
  ["parts.gltf", gltf(near, "parts.bin"), /keeps its points in another file \(parts\.bin\)/],
  [
    "swapped.ply",
    swapped(binaryPly(near, "float", true)),
    /its numbers are big-endian, but its header says the opposi/,
  ],
  ["swapped.pcd", swapped(pcd(near, "binary")), /its numbers are big-endian/],
  ["packed.pcd", packed.slice().fill(0xff, 1000, 1400), /its compressed data is damaged/],
  ["short.obj", text("v 1 2 3\nv 4 5\n"), /line 2 has 2 values, and a vertex has 3, 4, 6 or 7: "v 4 5"/],
  ["cube.obj", text("# no vertices\nf 1 2 3\n"), /it has no vertex lines/],
])("%s is refused in a plain sentence", async (name, content, sentence) => {
  const { refused } = (await readAsPage(name, content)) as { refused: string };
  expect(refused).toMatch(sentence);
  expect(refused).toMatch(/^\S.*\.$/);
});
