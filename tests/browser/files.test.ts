import { readFileSync } from "node:fs";
import { join } from "node:path";
import { gzipSync } from "node:zlib";
import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { asciiPly, ball, binaryPly, georeferencedBall, meshObj, pcd, rows, text } from "./clouds.js";
import { choose, drop, dropped, openInTurn, stillAnswers } from "./files.js";
import { glb, gltf, gltfBinary, inMillimeters, las, moved } from "./formats.js";
import { answered, answerInNode, openReady, reached, served, status, upToDate } from "./support.js";

const COUNT = 600;
const near = ball(COUNT);
const far = georeferencedBall(COUNT);
const measured = inMillimeters(far);
const octree = inMillimeters(georeferencedBall(3000));
const fixture = (name: string) => new Uint8Array(readFileSync(join(import.meta.dirname, "fixtures", name)));
const tree = fixture("octree.copc.laz");
const [laz, layers] = [fixture("ball-12.laz"), fixture("ball-14.laz")];
const lines = (positions: ArrayLike<number>, separator: string) =>
  rows(positions)
    .map((row) => row.join(separator))
    .join("\n");

// tests/package/page-files.test.ts has more.
const FILES: [string, Uint8Array, Float32Array | Float64Array][] = [
  ["double.ply", binaryPly(far, "double", true), far],
  ["compressed.pcd", pcd(near, "binary_compressed"), near],
  ["utm.xyz", text(lines(far, " ")), far],
  ["table.csv", text(`id,x,y,z\n${lines(far, ",").replace(/^/gm, "7,")}`), far],
  ["mesh.obj", meshObj(far), far],
  ["colored.las", las(measured, { minor: 2, format: 2 }), measured],
  ["ball.laz", laz, measured],
  ["layers.laz", layers, measured],
  ["points.glb", glb(near), moved(near)],
  ["text.gltf", gltf(near), moved(near)],
];

test("every format opens, chosen or dropped in turn, with the file's own coordinates", async () => {
  const page = await openReady("?sample=bunny&looks=0");
  await openInTurn(page, FILES);
  const offered = (await page.locator("#file").getAttribute("accept"))!.split(",");
  expect(offered).toEqual(
    expect.arrayContaining([...FILES.map(([name]) => name.slice(name.indexOf("."))), ".pts", ".npy", ".bin"]),
  );
});

test("a glTF file's numbers may lie in a second file on the web", async () => {
  served.set("cloud.gltf", gltf(near, "cloud.bin"));
  served.set("cloud.bin", gltfBinary(near));
  const now = await status(await openReady("?src=cloud.gltf"));
  expect(now).toMatchObject({ total: COUNT, ...(await answerInNode(moved(near), now)) });
});

test("an octree (COPC) is read from a file, and from servers with ranges and without", async () => {
  served.set("whole/octree.copc.laz", tree);
  served.set("ranged/octree.copc.laz", tree);
  let page!: Page;
  for (const place of ["whole", "ranged"]) {
    page = await openReady(`?src=${place}/octree.copc.laz`);
    const now = await status(page);
    // The octree has another order of points. This changes no answer.
    expect(now, place).toMatchObject({ state: "ready", total: 3000, ...(await answerInNode(octree, now)) });
  }
  const before = await status(page);
  await drop(page, "octree.copc.laz", tree);
  const now = await answered(page, before);
  expect(now).toMatchObject({ total: 3000, ...(await answerInNode(octree, now)) });
});

test("12 million points are thinned, and are never all in memory", async () => {
  const page = await openReady("?sample=bunny&points=100000&looks=0");
  const before = await status(page);
  const start = las(measured, { format: 0, claimed: 12_000_000 });
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

test("a place stands upright by its points, under any name, and can be turned where its name stands", async () => {
  // A street on a hill: level ground along z, two walls.
  const street = Float32Array.from(
    Array.from({ length: 3000 }, (_, i) => {
      const [u, v] = [(i * 0.7548776662) % 1, (i * 0.5698402909) % 1];
      return i % 3 < 2 ? [40 * u, 12 * v, 0.05 * u] : [40 * u, i % 2 ? 0 : 12, 7 * v];
    }).flat(),
  );
  const page = await openReady("?sample=bunny", {}, async (opened) => {
    await opened.addInitScript(() => {
      localStorage.removeItem("hidden-point-removal: tools");
    });
  });
  const up = () => page.locator("#up-axis input:checked").inputValue();
  const bytes = asciiPly(street);
  for (const [name, buffer] of [
    ["scene.ply", Buffer.from(bytes)],
    ["scene.ply.gz", gzipSync(bytes)],
  ] as const) {
    await page.locator("#file").setInputFiles({ name, mimeType: "", buffer });
    await page.locator("#source .credit", { hasText: name }).waitFor();
    expect(await up(), name).toBe("z");
  }
  // An object without ground has the usual side of its format.
  await page
    .locator("#file")
    .setInputFiles({ name: "ball.ply", mimeType: "", buffer: Buffer.from(asciiPly(ball(300))) });
  await page.locator("#source .credit", { hasText: "ball.ply" }).waitFor();
  expect(await up()).toBe("y");
  await page.locator("#source").getByRole("button", { name: "Turn upright" }).click();
  expect(await up()).toBe("-y");
});

test("a depth camera's cloud is seen upright from where it was taken", async () => {
  const page = await openReady("?sample=bunny");
  const before = await status(page);
  const content = new TextDecoder()
    .decode(pcd(near, "ascii"))
    .replace("WIDTH 600\nHEIGHT 1\nVIEWPOINT 0 0 0", "WIDTH 30\nHEIGHT 20\nVIEWPOINT 1 2 -9");
  await choose(page, "kinect.pcd", text(content));
  const now = await answered(page, before);
  expect(now).toMatchObject({
    state: "ready",
    total: COUNT,
    viewpoint: [1, 2, -9],
    ...(await answerInNode(near, now)),
  });
  expect(await page.locator("#up-axis input:checked").inputValue()).toBe("-y");
});

test("a single point, and points that are all the same, can be looked at; a dropped item that is no file is named", async () => {
  const page = await openReady("?sample=bunny");
  for (const [name, content, total] of [
    ["one.xyz", "1 2 3\n", 1],
    ["same.xyz", "1 2 3\n".repeat(5), 5],
  ] as const) {
    const before = await status(page);
    await choose(page, name, text(content));
    expect(await answered(page, before)).toMatchObject({ state: "ready", total, visible: total });
  }
  await dropped(page, (data) => {
    data.setData("text/plain", "hello");
  });
  expect(await page.locator("#message p").textContent()).toBe("That is not a file; drop a file.");
});

const DAMAGED = /cannot be decompressed|is broken|may be damaged/;
/** The file with some bytes in a row changed. */
const changed = (file: Uint8Array, from: number, to: number, count: number) =>
  file.slice().fill(to, from, from + count);
const nan = `${lines(near, " ")}\nnan nan nan\n`;
const png = Uint8Array.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0, 0, 0, 13, 0x49, 0x48, 0x44, 0x52]);

// tests/package has the other files that are refused, and the same words for them.
const REFUSED: [string, Uint8Array, RegExp][] = [
  ["cut.ply", binaryPly(near, "float", true).slice(0, 3000), /cannot be read: it ends after 2\d\d of the 600 vertices/],
  ["empty.ply", new Uint8Array(), /is empty/],
  ["picture.xyz", png, /it is an image/],
  ["nan.ply", asciiPly([...near, 0, NaN, 0]), /has 1 of 601 points without a position/],
  ["beyond.xyz", text("0 0 0\n1 1 1e300\n"), /too far out/],
  ["cut.laz", layers.slice(0, 4000), /cannot be read: it ends before the 600 points/],
  ["damaged.copc.laz", changed(tree, new DataView(tree.buffer).getUint32(96, true) + 200, 0x5a, 200), DAMAGED],
];

test("a file that is no cloud is refused in a plain sentence, and the previous cloud stays", async () => {
  const page = await openReady("?sample=bunny&looks=0");
  const message = page.locator("#message");
  for (const [number, [name, content, sentence]] of REFUSED.entries()) {
    const before = await status(page);
    await choose(page, name, content);
    const after = await reached(page, "error");
    expect(after, name).toEqual({ ...before, state: "error", sentence: after.sentence });
    expect(after.sentence).toMatch(sentence);
    expect(after.sentence).toMatch(/^\S.*\.$/);
    const shown = await page.evaluate(() => ({
      message: document.querySelector("#message p")!.textContent,
      sample: document.querySelector<HTMLSelectElement>("#sample")!.value,
      isProgress: document.getElementById("progress")!.checkVisibility(),
    }));
    expect(shown, name).toEqual({ message: after.sentence, sample: "bunny", isProgress: false });

    // The message is dismissed by the button and by the keyboard, in turn.
    const dismiss = message.getByRole("button", { name: "Dismiss" });
    if (number % 2 === 0) {
      await dismiss.click();
    } else {
      await dismiss.focus();
      await page.keyboard.press("Escape");
    }
    // The focus has gone back to the cloud.
    const left = await page.evaluate(() => ({
      isMessage: document.getElementById("message")!.checkVisibility(),
      focus: document.activeElement?.id,
    }));
    expect(left, name).toEqual({ isMessage: false, focus: "view" });
    await stillAnswers(page, number, REFUSED.length);
  }
});

test("points without a position can be left out", async () => {
  const page = await openReady("?sample=bunny");
  const before = await status(page);
  await choose(page, "nan.xyz", text(nan));
  await page.getByRole("button", { name: "Load without them" }).click();
  const now = await answered(page, before);
  expect(now).toMatchObject({ state: "ready", total: COUNT, ...(await answerInNode(near, now)) });
});

test("one bad line of many: the rest is loaded without it, and a note quotes it", async () => {
  const page = await openReady("?sample=bunny");
  const lines = rows(ball(600)).map((row) => row.join(" "));
  await choose(page, "scan.xyz", text(`${lines.toSpliced(300, 0, "1 2 oops").join("\n")}\n`));
  await reached(page, "error");
  const message = page.locator("#message");
  expect(await message.locator("p").textContent()).toMatch(/^scan\.xyz cannot be read: line 301 is not a point/);
  await message.getByRole("button", { name: "Load without it" }).click();
  await page.locator('#status[data-total="600"]').waitFor();
  expect(await message.locator("p").textContent()).toMatch(/^One line is left out: line 301 is not a point.*oops/);
});

test("the columns of a table that numbers its points can be chosen on its note", async () => {
  const page = await openReady("?sample=bunny");
  const lines = rows(ball(600)).map((row, i) => [i + 1, ...row].join(" "));
  await choose(page, "numbered.xyz", text(`${lines.join("\n")}\n`));
  await page.locator('#status[data-total="600"]').waitFor();
  const message = page.locator("#message");
  expect(await message.locator("p").textContent()).toContain("x, y and z are columns 2, 3, 4");
  await message.getByRole("button", { name: "Choose columns" }).click();
  const columns = page.locator("#columns input");
  expect(await columns.evaluateAll((all) => all.map((input) => (input as HTMLInputElement).value))).toEqual([
    "2",
    "3",
    "4",
  ]);
  const before = await status(page);
  await page.getByLabel("Column of z").fill("1");
  await page.getByRole("button", { name: "Open with these" }).click();
  await answered(page, before);
  expect(await message.locator("p").textContent()).toContain("x, y and z are columns 2, 3, 1");
  expect((await upToDate(page)).viewpoint).not.toEqual(before.viewpoint);
});
