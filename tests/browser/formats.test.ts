import { readFileSync } from "node:fs";
import { join } from "node:path";
import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { asciiPly, ball, binaryPly, georeferencedBall, pcd, text } from "./clouds.js";
import { choose, drop, openInTurn, stillAnswers } from "./files.js";
import { glb, gltf, gltfBinary, inMillimeters, las, moved } from "./formats.js";
import { answered, answerInNode, openReady, reached, served, status, upToDate } from "./support.js";

const COUNT = 600;
const near = ball(COUNT);
const far = inMillimeters(georeferencedBall(COUNT));
const octree = inMillimeters(georeferencedBall(3000));
const fixture = (name: string) => new Uint8Array(readFileSync(join(import.meta.dirname, "fixtures", name)));

const FILES: [string, Uint8Array, Float32Array | Float64Array][] = [
  ["oldest.las", las(far, { minor: 0, format: 0 }), far],
  ["timed.las", las(far, { minor: 1, format: 1 }), far],
  ["colored.las", las(far, { minor: 2, format: 2 }), far],
  ["usual.las", las(far, { minor: 3, format: 3 }), far],
  ["newest.las", las(far, { minor: 4, format: 6 }), far],
  ["infrared.las", las(far, { minor: 4, format: 8, extra: "height above ground" }), far],
  ["ball.laz", fixture("ball-12.laz"), far],
  ["layers.laz", fixture("ball-14.laz"), far],
  ["points.glb", glb(near), moved(near)],
  ["colored.glb", glb(near, { colors: true }), moved(near)],
  ["mesh.glb", glb(near, { mode: 4 }), moved(near)],
  [
    "twice.glb",
    glb(near.subarray(0, 900), { twice: true }),
    Float64Array.of(...moved(near.subarray(0, 900)), ...moved(near.subarray(0, 900).map((value) => 2 * value))),
  ],
  ["text.gltf", gltf(near), moved(near)],
];

test("LAS, LAZ, glTF and GLB files open, chosen or dropped in turn, with the file's own coordinates", async () => {
  await openInTurn(await openReady("?sample=bunny&looks=0"), FILES);
});

test("a glTF file's numbers may lie in a second file on the web", async () => {
  served.set("cloud.gltf", gltf(near, "cloud.bin"));
  served.set("cloud.bin", gltfBinary(near));
  const now = await status(await openReady("?src=cloud.gltf"));
  expect(now).toMatchObject({ total: COUNT, ...(await answerInNode(moved(near), now)) });
});

test("an octree (COPC) is read from a file, in ranges from a server that supports them, and whole from other servers", async () => {
  const content = fixture("octree.copc.laz");
  served.set("whole/octree.copc.laz", content);
  served.set("ranged/octree.copc.laz", content);
  let page!: Page;
  for (const place of ["whole", "ranged"]) {
    page = await openReady(`?src=${place}/octree.copc.laz`);
    const now = await status(page);
    // The octree has another order of points. This changes no answer.
    expect(now, place).toMatchObject({ state: "ready", total: 3000, ...(await answerInNode(octree, now)) });
  }
  const before = await status(page);
  await drop(page, "octree.copc.laz", content);
  const now = await answered(page, before);
  expect(now).toMatchObject({ total: 3000, ...(await answerInNode(octree, now)) });
});

test("an octree with more points than allowed shows its coarser levels", async () => {
  served.set("ranged/octree.copc.laz", fixture("octree.copc.laz"));
  const page = await openReady("?src=ranged/octree.copc.laz&points=1100");
  const now = await status(page);
  const coarse = octree.filter((_, i) => Math.floor(i / 3) % 3 === 0);
  expect(now).toMatchObject({ total: 1000, ...(await answerInNode(coarse, now)) });
  expect(await page.locator("#message p").textContent()).toBe(
    "1,000 of its 3,000 points are shown: the points of its coarser levels.",
  );

  const least = await openReady("?src=ranged/octree.copc.laz&points=250");
  expect(await status(least)).toMatchObject({ total: 250 });
});

const every = (step: number, positions: Float32Array | Float64Array) =>
  positions.filter((_, i) => Math.floor(i / 3) % step === 0);

test("a file with more points than allowed shows every n-th point, and the page says so", async () => {
  const lines = [...near].map((value, i) => `${value}${i % 3 === 2 ? "\n" : " "}`).join("");
  const limited: [string, Uint8Array, Float32Array | Float64Array, string][] = [
    ["cloud.las", las(far), every(3, far), "Every 3rd of its 600 points is shown."],
    ["cloud.laz", fixture("ball-12.laz"), every(3, far), "Every 3rd of its 600 points is shown."],
    ["cloud.ply", binaryPly(near, "float", false), every(3, near), "Every 3rd of its 600 points is shown."],
    ["text.ply", asciiPly(near), every(3, near), "Every 3rd of its 600 points is shown."],
    ["cloud.pcd", pcd(near, "binary"), every(3, near), "Every 3rd of its 600 points is shown."],
    ["packed.pcd", pcd(near, "binary_compressed"), every(3, near), "Every 3rd of its 600 points is shown."],
    ["cloud.glb", glb(near), every(3, moved(near)), "Every 3rd of its 600 points is shown."],
    // A text does not give the number of points first. So every second point is dropped, as often as needed.
    ["cloud.xyz", text(lines), every(4, near), "Every 4th of its 600 points is shown."],
    ["cloud.obj", text(lines.replace(/^(?=.)/gm, "v ")), every(4, near), "Every 4th of its 600 points is shown."],
  ];
  // Without looks each file has one answer.
  const page = await openReady("?sample=bunny&points=200&looks=0");
  for (const [name, content, positions, sentence] of limited) {
    const before = await status(page);
    await choose(page, name, content);
    const now = await answered(page, before);
    expect(now, name).toMatchObject({ total: positions.length / 3, ...(await answerInNode(positions, now)) });
    expect(await page.locator("#message p").textContent(), name).toBe(sentence);
  }
});

test("12 million points are thinned, and are never all in memory", async () => {
  const page = await openReady("?sample=bunny&points=100000&looks=0");
  const before = await status(page);
  const start = las(far, { format: 0, claimed: 12_000_000 });
  // The file has its header once, and then the same 600 points again and again.
  await page.evaluate(
    ([bytes, count]) => {
      const header = Uint8Array.from(bytes.slice(0, 227));
      const points = Uint8Array.from(bytes.slice(227));
      const many = new Blob(Array.from({ length: 1000 }, () => points));
      const data = new DataTransfer();
      data.items.add(new File([header, ...Array.from({ length: count / 600_000 }, () => many)], "large.las"));
      document.getElementById("view")!.dispatchEvent(new DragEvent("drop", { dataTransfer: data, bubbles: true }));
    },
    [[...start], 12_000_000] as const,
  );
  const now = await answered(page, before);
  expect(now).toMatchObject({ state: "ready", total: 100_000 });
  expect(await page.locator("#message p").textContent()).toBe("Every 120th of its 12,000,000 points is shown.");
});

const edited = (content: Uint8Array, edit: (view: DataView, bytes: Uint8Array) => void): Uint8Array => {
  const copy = content.slice();
  edit(new DataView(copy.buffer), copy);
  return copy;
};
const both = (...parts: Uint8Array[]) => new Uint8Array(Buffer.concat(parts));
const laz = fixture("ball-12.laz");
const layers = fixture("ball-14.laz");
const tree = fixture("octree.copc.laz");

const REFUSED: [string, Uint8Array, RegExp][] = [
  ["cut.las", las(far).slice(0, 9000), /cannot be read: it ends before the 600 points that its header promises/],
  [
    "boast.las",
    las(far, { minor: 4, format: 6, claimed: 1e12 }),
    /cannot be read: it ends before the 1,000,000,000,000 points/,
  ],
  ["stub.las", las(far).slice(0, 100), /cannot be read: it ends within its LAS header/],
  ["none.las", las([]), /it has no points/],
  [
    "version.las",
    edited(las(far), (view) => {
      view.setUint8(25, 9);
    }),
    /its LAS version is 1\.9/,
  ],
  [
    "format.las",
    edited(las(far), (view) => {
      view.setUint8(104, 33);
    }),
    /its LAS points have an unknown format \(33\)/,
  ],
  [
    "rows.las",
    edited(las(far), (view) => {
      view.setUint16(105, 12, true);
    }),
    /points are shorter than their format/,
  ],
  [
    "header.las",
    edited(las(far), (view) => {
      view.setUint32(96, 4e9, true);
    }),
    /points would begin after its end/,
  ],
  [
    "scale.las",
    edited(las(far), (view) => {
      view.setFloat64(139, NaN, true);
    }),
    /has no usable scale and offset/,
  ],
  [
    "offset.las",
    edited(las(far), (view) => {
      view.setUint16(94, 3, true);
    }),
    /the sizes in its LAS header are impossible/,
  ],
  ["swapped.las", text("FSAL and so on"), /it does not begin like a LAS file/],
  ["cut.laz", laz.slice(0, 3000), /cannot be read: it ends before the 600 points/],
  ["cut-layers.laz", layers.slice(0, 4000), /cannot be read: it ends before the 600 points/],
  [
    "chunks.laz",
    edited(laz, (view) => {
      view.setUint32(Number(view.getBigInt64(view.getUint32(96, true), true)) + 4, 4e9, true);
    }),
    /the table of its compressed chunks contradicts/,
  ],
  ["cut.copc.laz", tree.slice(0, 30_000), /is broken: |cannot be/],
  [
    "tree.copc.laz",
    edited(tree, (view) => {
      view.setBigUint64(375 + 54 + 40, 7n, true);
    }),
    /is broken: |cannot be read: /,
  ],
  ["draco.glb", glb(near, { required: ["KHR_draco_mesh_compression"] }), /is compressed with Draco, which is not read/],
  [
    "unknown.glb",
    glb(near, { required: ["EXT_of_tomorrow"] }),
    /needs an extension that is not supported \(EXT_of_tomorrow\)/,
  ],
  ["cut.glb", glb(near).slice(0, 3000), /it is shorter than its header says/],
  [
    "version.glb",
    edited(glb(near), (view) => {
      view.setUint32(4, 1, true);
    }),
    /its glTF version is 1/,
  ],
  [
    "json.glb",
    edited(glb(near), (_, bytes) => {
      bytes.fill(0x21, 20, 60);
    }),
    /the description of its scene cannot be read/,
  ],
  ["nothing.gltf", text("{}"), /it does not give its glTF version/],
  ["empty.glb", glb([]), /has no vertices|is broken/],
  ["parts.gltf", gltf(near, "parts.bin"), /keeps its points in another file \(parts\.bin\)/],
  [
    "swapped.ply",
    both(binaryPly(near, "float", true).slice(0, -12 * COUNT), binaryPly(near, "float", false).slice(-12 * COUNT)),
    /its numbers are big-endian, but its header says the opposite/,
  ],
  [
    "swapped.pcd",
    both(pcd(near, "binary").slice(0, -12 * COUNT), binaryPly(near, "float", false).slice(-12 * COUNT)),
    /its numbers are big-endian/,
  ],
  [
    "packed.pcd",
    edited(pcd(near, "binary_compressed"), (_, bytes) => {
      bytes.fill(0xff, 1000, 1400);
    }),
    /its compressed data is damaged/,
  ],
];

test("a broken file is refused in a plain sentence, and the page stays usable", async () => {
  const page = await openReady("?sample=bunny&looks=0");
  for (const [number, [name, content, sentence]] of REFUSED.entries()) {
    const before = await status(page);
    await choose(page, name, content);
    const after = await reached(page, "error");
    expect(after.sentence, name).toMatch(sentence);
    expect(after.sentence, name).toMatch(/^\S.*\.$/);
    expect(after, name).toEqual({ ...before, state: "error", sentence: after.sentence });
    await page.keyboard.press("Escape");
    await stillAnswers(page, number, REFUSED.length);
  }
});

test("damaged points are refused", async () => {
  const page = await openReady("?sample=bunny&looks=0");
  const damaged = (content: Uint8Array, from: number) =>
    edited(content, (_, bytes) => {
      bytes.fill(0x5a, from, from + 200);
    });
  for (const [name, content] of [
    ["damaged.laz", damaged(laz, 2000)],
    ["damaged-layers.laz", damaged(layers, 1500)],
    // This place lies after the first point and the sizes of the layers. It changes positions, not colors.
    ["damaged.copc.laz", damaged(tree, new DataView(tree.buffer).getUint32(96, true) + 200)],
  ] as const) {
    await choose(page, name, content);
    await page.locator("#message").filter({ hasText: name }).waitFor();
    expect(await page.locator("#message p").textContent()).toMatch(/cannot be decompressed|is broken|may be damaged/);
    await page.keyboard.press("Escape");
    const before = await upToDate(page);
    await choose(page, "sound.laz", laz);
    expect(await answered(page, before)).toMatchObject({ state: "ready", total: COUNT });
  }
});

test("the file chooser offers every ending that the page reads", async () => {
  const page = await openReady("?sample=bunny");
  const offered = (await page.locator("#file").getAttribute("accept"))!.split(",");
  expect(offered).toEqual(
    expect.arrayContaining([
      ".las",
      ".laz",
      ".ply",
      ".pcd",
      ".xyz",
      ".txt",
      ".csv",
      ".pts",
      ".asc",
      ".obj",
      ".gltf",
      ".glb",
    ]),
  );
});
