import { expect, test } from "vitest";
import { asciiPly, ball, binaryPly, georeferencedBall, meshObj, meshPly, pcd, rows, text, utf16 } from "./clouds.js";
import { choose, dropped, openInTurn, stillAnswers } from "./files.js";
import { pcdCases } from "../files/corpus-pcd.js";
import { plyCases } from "../files/corpus-ply.js";
import { tableCases } from "../files/corpus-tables.js";
import { answered, answerInNode, openReady, reached, status, unfold, upToDate } from "./support.js";

const COUNT = 600;
const near = ball(COUNT);
const far = georeferencedBall(COUNT);
const lines = (positions: ArrayLike<number>, separator: string) =>
  rows(positions)
    .map((row) => row.join(separator))
    .join("\n");

const FILES: [string, Uint8Array, Float32Array | Float64Array][] = [
  ["ascii.ply", asciiPly(near), near],
  ["mesh.ply", meshPly(near), near],
  ["little.ply", binaryPly(near, "float", true), near],
  ["big.ply", binaryPly(near, "float", false), near],
  ["double.ply", binaryPly(far, "double", true), far],
  ["ascii.pcd", pcd(near, "ascii"), near],
  ["binary.pcd", pcd(near, "binary"), near],
  ["compressed.pcd", pcd(near, "binary_compressed"), near],
  ["plain.xyz", text(lines(near, " ")), near],
  ["utm.xyz", text(lines(far, " ")), far],
  ["colored.txt", text(`# x y z r g b\n${lines(near, "\t").replaceAll("\n", "\t200\t100\t50\n")}\t1\t2\t3\n`), near],
  ["counted.txt", text(`${COUNT}\n${lines(far, " ").replaceAll("\n", " 17 200 100 50\n")} 17 1 2 3\n`), far],
  [
    "table.csv",
    text(
      `id,z,"Y",x\r\n${rows(far)
        .map(([x, y, z], i) => `${i},${z},${y},${x}`)
        .join("\r\n")}`,
    ),
    far,
  ],
  [
    "survey.csv",
    text(
      `point_id,time,x_m,y_m,z_m\n${rows(far)
        .map((row, i) => `${i},${i / 8},${row.join()}`)
        .join("\n")}`,
    ),
    far,
  ],
  ["units.txt", text(`//X [m] Y [m] Z [m]\n${lines(far, " ")}`), far],
  ["wide.csv", utf16(`x,y,z\r\n${lines(near, ",")}`), near],
  [
    "capitals.ply",
    text(
      new TextDecoder()
        .decode(asciiPly(near))
        .replace(/float ([xyz])/g, (_, axis: string) => `float ${axis.toUpperCase()}`),
    ),
    near,
  ],
  ["european.csv", text(lines(far, ";").replaceAll(".", ",")), far],
  ["mesh.obj", meshObj(far), far],
];

test("every format opens, chosen or dropped in turn, with the file's own coordinates", async () => {
  await openInTurn(await openReady("?sample=bunny&looks=0"), FILES);
});

test("up can be chosen, and the camera returns to the first view", async () => {
  const page = await openReady("?sample=bunny");
  const before = await status(page);
  await choose(page, "plain.xyz", text(lines(near, " ")));
  const scanned = await answered(page, before);
  expect(await page.locator("#up-axis input:checked").inputValue()).toBe("z");
  await unfold(page, "Look");
  await page.locator("#up-axis").getByRole("radio", { name: "Y", exact: true }).check();
  const turned = await answered(page, scanned);
  expect(turned.viewpoint).not.toEqual(scanned.viewpoint);
  expect(turned).toMatchObject(await answerInNode(near, turned));
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

test("a dropped item that is no file is named", async () => {
  const page = await openReady("?sample=bunny");
  await dropped(page, (data) => {
    data.setData("text/plain", "hello");
  });
  expect(await page.locator("#message p").textContent()).toBe("That is not a file; drop a file.");
});

test("points that are all the same, and a single point, can be looked at", async () => {
  const page = await openReady("?sample=bunny");
  for (const [name, content, total] of [
    ["one.xyz", "1 2 3\n", 1],
    ["same.xyz", "1 2 3\n".repeat(5), 5],
  ] as const) {
    const before = await status(page);
    await choose(page, name, text(content));
    expect(await answered(page, before)).toMatchObject({ state: "ready", total, visible: total });
  }
});

const nan = `${lines(near, " ")}\nnan nan nan\n`;
const png = Uint8Array.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0, 0, 0, 13, 0x49, 0x48, 0x44, 0x52]);

const REFUSED: [string, Uint8Array, RegExp][] = [
  ["broken.ply", text("ply\nformat ascii 1.0\nelement vertex 3\n"), /cannot be read: its PLY header has no end/],
  [
    "cut.ply",
    asciiPly(near).slice(0, 4000),
    /cannot be read: line \d+ has \d values|cannot be read: it ends after \d+ of the 600 vertices/,
  ],
  [
    "cut-binary.ply",
    binaryPly(near, "float", true).slice(0, 3000),
    /cannot be read: it ends after 2\d\d of the 600 vertices/,
  ],
  ["faces.ply", text("ply\nformat ascii 1.0\nelement face 0\nend_header\n"), /without vertices/],
  ["flat.ply", text("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n"), /no x, y and z/],
  ["none.ply", asciiPly([]), /holds no points/],
  ["boast.ply", asciiPly(near, 4_000_000_000), /ends after 600 of the 4000000000 vertices/],
  [
    "boast.pcd",
    text("VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 100000\nHEIGHT 100000\nDATA binary\n"),
    /ends after 0 of the 10000000000 points/,
  ],
  ["cut.pcd", pcd(near, "binary").slice(0, 3000), /cannot be read: it ends after 2\d\d of the 600 points/],
  [
    "cut-packed.pcd",
    pcd(near, "binary_compressed").slice(0, 3000),
    /cannot be read: it ends after 0 of the 600 points/,
  ],
  ["headless.pcd", text("VERSION 0.7\nFIELDS x y z\n"), /cannot be read: its PCD header has no end/],
  ["empty.ply", new Uint8Array(), /is empty/],
  ["empty.xyz", new Uint8Array(), /is empty/],
  ["blank.xyz", text("\n\n \n"), /cannot be read: it has no line of three numbers/],
  ["picture.ply", png, /it does not begin like a PLY file/],
  ["picture.xyz", png, /it is not text/],
  ["page.pcd", text("<!doctype html><title>404</title>"), /it does not begin like a PCD file/],
  [
    "letter.txt",
    text("Dear all,\n\nthank you for 3 nice days.\n\nYours, Ada\n"),
    /cannot be read: line 1 is neither three numbers nor names of columns x, y and z/,
  ],
  [
    "nameless.csv",
    text("id,time,a,b,c\n1,2,3,4,5\n2,3,4,5,6\n"),
    /line 1 is neither three numbers nor names of columns x, y and z: "id,time,a,b,c"/,
  ],
  [
    "comma.ply",
    text(new TextDecoder().decode(asciiPly([0.5, 1.5, 2.5])).replace(/(\d)\.(5)/g, "$1,$2")),
    /line 8 is not a point, its x is not a number/,
  ],
  ["first.xyz", text(`nan nan nan\n${lines(near, " ")}`), /has 1 of 601 points without a position/],
  ["short.obj", text("v 1 2 3\nv 4 5\n"), /line 2 has 2 values, and a vertex has 3, 4, 6 or 7: "v 4 5"/],
  ["stumble.csv", text("x,y,z\n1,2,3\n4,five,6\n"), /line 3 is not a point, its column 2 is not a number: "4,five,6"/],
  ["cube.obj", text("# no vertices\nf 1 2 3\n"), /it has no vertex lines/],
  ["nan.xyz", text(nan), /has 1 of 601 points without a position/],
  ["nan.ply", asciiPly([...near, 0, NaN, 0]), /has 1 of 601 points without a position/],
  ["infinite.xyz", text(`${lines(near, " ")}\n1 2 1e999\n`), /line 601 has a number out of range/],
  ["only-nan.pcd", pcd([NaN, NaN, NaN], "binary"), /none of its coordinates are numbers/],
  ["beyond.xyz", text("0 0 0\n1 1 1e300\n"), /too far out/],
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

test("one in forty broken files of the corpus is refused on the page, in the corpus's words", async () => {
  const broken = [...plyCases(), ...pcdCases(), ...tableCases()].filter(
    ({ columns, expected }) => columns === undefined && typeof expected === "string",
  );
  const page = await openReady("?sample=bunny&looks=0");
  const errors: string[] = [];
  page.on("pageerror", (error) => errors.push(error.message));
  const chosen = broken.filter((_, number) => number % 40 === 0);
  expect(chosen.length).toBeGreaterThan(10);
  for (const [number, { name, file, content, expected }] of chosen.entries()) {
    const before = await status(page);
    await choose(page, file, content);
    const after = await reached(page, "error");
    expect(after, name).toEqual({ ...before, state: "error", sentence: after.sentence });
    const said = (expected as string).split("|").some((words) => words !== "" && after.sentence.includes(words));
    expect(said, `${name}: “${after.sentence}” does not say “${String(expected)}”`).toBe(true);
    await page.locator("#message").getByRole("button", { name: "Dismiss" }).click();
    await stillAnswers(page, number, chosen.length);
  }
  expect(errors).toEqual([]);
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
