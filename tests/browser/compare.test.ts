import { createRequire } from "node:module";
import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { grid, type Mesh } from "../../www/samples/mesh.js";
import { RayTracer } from "../fidelity/rays.js";
import { errorsOf } from "../fidelity/score.js";
import { readAddress } from "../../www/settings/read-address.js";
import { oracleFor } from "../../www/compare/oracles.js";
import { readFaces } from "../../www/loaders/faces.js";
import { make as makeRoom } from "../../www/samples/living-room.js";
import { make as makeRings, skinOfRings } from "../../www/samples/rings.js";
import { partsOf } from "../../www/view/parts.js";
import { Projected, zBuffer } from "../../www/compare/zbuffer.js";
import { DISTANCE, MIDDLE, openBall, positions as ballPositions, tool } from "./ball.js";
import { ball, binaryPly, text } from "./clouds.js";
import { choose } from "./files.js";
import {
  drag,
  dragonPositions,
  EVERY_PIXEL,
  inNode,
  middleOf,
  openReady,
  picture,
  differentPixels,
  refiltered,
  served,
  type Status,
  status,
  upToDate,
  unfold,
} from "./support.js";

const { positions: corners, cells } = createRequire(import.meta.url)("bunny") as {
  positions: number[][];
  cells: number[][];
};
const bunny: Mesh = { positions: Float32Array.from(corners.flat()), triangles: Uint32Array.from(cells.flat()) };
const TOLERANCE = 1.75;
/** Software rendering is slow. */
const SMALL = { viewport: { width: 800, height: 440 } };

interface Screen {
  width: number;
  height: number;
  /** The size in pixels of a unit length at distance 1. */
  pixels: number;
}

/**
 * Follows the definition of the z-buffer, point by point and pixel by pixel. Returns 2 for a point out of the picture,
 * 1 if no splat over the point's pixel is much nearer, else 0.
 */
function slowly(
  seen: { x: number; y: number; depth: number }[],
  { width, height, pixels }: Screen,
  splat: number,
): number[] {
  const inside = ({ x, y, depth }: (typeof seen)[number]) => depth > 0 && x >= 0 && x < width && y >= 0 && y < height;
  const covers = (other: (typeof seen)[number], column: number, row: number) => {
    const [across, down] = [column + 0.5 - other.x, row + 0.5 - other.y];
    return splat > 3 ? Math.hypot(across, down) <= splat / 2 : Math.max(Math.abs(across), Math.abs(down)) <= splat / 2;
  };
  return seen.map((own) => {
    if (!inside(own)) return 2;
    const [column, row] = [Math.floor(own.x), Math.floor(own.y)];
    const nearest = Math.min(
      ...seen.filter((other) => inside(other) && covers(other, column, row)).map(({ depth }) => depth),
    );
    return own.depth - (TOLERANCE * splat * own.depth) / pixels <= nearest ? 1 : 0;
  });
}

/** Waits until the numbers on the card differ from `before`. Returns these numbers. */
async function figures(
  page: Page,
  before = "",
): Promise<{ counts: number[]; of: number; milliseconds: number; text: string }> {
  const table = page.locator("#compare-figures");
  await expect.poll(() => table.getAttribute("data-counts")).toMatch(/\d+,\d+/);
  await expect.poll(() => table.getAttribute("data-counts")).not.toBe(before);
  return table.evaluate((element: HTMLElement) => {
    const { counts, of, milliseconds } = element.dataset;
    return {
      counts: counts!.split(",").map(Number),
      of: Number(of),
      milliseconds: Number(milliseconds),
      text: counts!,
    };
  });
}

test.for([1, 2, 3, 4, 9, 24])("the z-buffer agrees with its definition (splats of %i pixels)", (splat) => {
  // A bumpy ball in front of a wall. Some points are out of the picture or behind the camera.
  // The camera looks from the origin along −z.
  const wall = grid(12, 12, (u, v) => [20 * u - 10, 16 * v - 8, -14]).positions;
  const local = Float32Array.from([
    ...ball(400).map((value, i) => value - (i % 3 === 2 ? 5 : 0)),
    ...wall,
    0.5,
    0.5,
    3,
  ]);
  const [width, height, pixels] = [160, 120, 150];
  const matrix = [(2 * pixels) / width, 0, 0, 0, 0, (2 * pixels) / height, 0, 0, 0, 0, -1, -1, 0, 0, -0.2, 0];
  const said = zBuffer(new Projected(local, { matrix, width, height, near: 0.1, pixels }), splat);
  const seen = Array.from({ length: local.length / 3 }, (_, i) => {
    const [x, y, depth] = [local[3 * i]!, local[3 * i + 1]!, -local[3 * i + 2]!];
    return { x: width / 2 + (x * pixels) / depth, y: height / 2 - (y * pixels) / depth, depth };
  });
  expect([...said]).toEqual(slowly(seen, { width, height, pixels }, splat));
  for (const kind of [0, 1, 2]) {
    expect(said.filter((one) => one === kind).length, `points said to be ${kind}`).toBeGreaterThan(3);
  }
});

test("points are grouped by the two answers about them", () => {
  const { order, ends } = partsOf(Uint8Array.of(1, 0, 2, 1, 0, 2, 1), Uint32Array.of(0, 1, 2, 6));
  expect([...order]).toEqual([0, 6, 1, 3, 2, 4, 5]);
  expect(ends).toEqual([2, 3, 4, 5]);
});

test("the airplane's skin is closed: each edge has two triangles", () => {
  const triangles = skinOfRings();
  const edges = new Map<string, number>();
  for (let i = 0; i < triangles.length; i++) {
    const pair = [triangles[i]!, triangles[i % 3 === 2 ? i - 2 : i + 1]!].sort((a, b) => a - b).join();
    edges.set(pair, (edges.get(pair) ?? 0) + 1);
  }
  expect([...edges.values()].every((count) => count === 2)).toBe(true);
  expect(new Set(triangles).size).toBe(makeRings().positions.length / 3);
});

test("faces of the user's files are read and cut into triangles", async () => {
  const read = (content: string | Uint8Array, vertices = 5) => {
    const blob = new Blob([typeof content === "string" ? content : new Uint8Array(content)]);
    return readFaces({ name: "mesh", blob }, vertices).then((triangles) => [...triangles]);
  };
  const obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1/1/1 2//1 3\nf -4 -3 -2 -1\nv 0 0 1\nf 1 2 3 4 5\n";
  expect(await read(obj)).toEqual([0, 1, 2, 0, 1, 2, 0, 2, 3, 0, 1, 2, 0, 2, 3, 0, 3, 4]);
  const header = (format: string) =>
    `ply\nformat ${format} 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\nelement face 2\nproperty uchar flag\nproperty list uchar int vertex_indices\nend_header\n`;
  expect(await read(`${header("ascii")}${"0 0 0\n".repeat(5)}\n7 3 0 1 2\n7 4 1 2 3 4\n`)).toEqual([
    0, 1, 2, 1, 2, 3, 1, 3, 4,
  ]);
  const rows = new DataView(new ArrayBuffer(60 + 14 + 18));
  let at = 60;
  for (const face of [
    [0, 1, 2],
    [1, 2, 3, 4],
  ]) {
    rows.setUint8(at, 7);
    rows.setUint8(at + 1, face.length);
    face.forEach((corner, i) => {
      rows.setInt32(at + 2 + 4 * i, corner, true);
    });
    at += 2 + 4 * face.length;
  }
  expect(await read(Buffer.concat([text(header("binary_little_endian")), new Uint8Array(rows.buffer)]))).toEqual([
    0, 1, 2, 1, 2, 3, 1, 3, 4,
  ]);
  await expect(read(obj, 4)).rejects.toThrow("mesh cannot be read: it has faces whose points are missing");
  await expect(read(`${header("ascii")}${"0 0 0\n".repeat(5)}7 3 0 1 2\n`)).rejects.toThrow("it ends after 1 of the");
  await expect(
    read(Buffer.concat([text(header("binary_little_endian")), new Uint8Array(rows.buffer, 0, 80)])),
  ).rejects.toThrow();
});

test("the scanner of the street sees all points that its own beams met", async () => {
  const street = await oracleFor({ sample: "street" }, new Float32Array());
  const sees = street.from([-21, 1.1, 1.75]);
  // These points belong to the first of three stations. The first 60,000 points are from this station.
  const tried = Array.from({ length: 6000 }, (_, i) => 7 * i);
  expect(tried.filter((i) => !sees(i))).toEqual([]);
  // From the other end of the street, many points are hidden.
  const other = street.from([22, 0.9, 1.75]);
  const share = tried.filter(other).length / tried.length;
  expect(share).toBeGreaterThan(0.1);
  expect(share).toBeLessThan(0.8);
});

test("in the room the ceiling is seen and the floor under the rug is hidden, also with noise", async () => {
  const room = await oracleFor({ sample: "room" }, new Float32Array());
  const { positions } = makeRoom();
  expect(room.count).toBe(positions.length / 3);
  const sees = room.from([-0.2, 2.4, 0.3]);
  const share = (like: (x: number, y: number, z: number) => boolean) => {
    const chosen = Array.from({ length: room.count }, (_, i) => i).filter((i) =>
      like(positions[3 * i]!, positions[3 * i + 1]!, positions[3 * i + 2]!),
    );
    expect(chosen.length).toBeGreaterThan(1000);
    return chosen.filter(sees).length / chosen.length;
  };
  // The bookcase, the lamp and the plant hide small parts of the ceiling.
  expect(share((_x, y) => y > 2.69)).toBeGreaterThan(0.97);
  expect(share((x, y, z) => y < 0.004 && x > -1.99 && x < 0.59 && z > -1.09 && z < 0.79)).toBe(0);
});

test("compared with the z-buffer: the counts follow its definition, live, and the choice is in the address", async () => {
  const page = await openBall({ ...SMALL, ...EVERY_PIXEL });
  const before = await status(page);
  await page.locator("#view").press("c");
  await page.getByLabel("Z-buffer").check();
  await page.getByLabel("Splat width").fill("24");
  const { width, height } = (await page.locator("#view").boundingBox())!;
  const expected = async ({ viewpoint }: Status, splat: number) => {
    const pixels = height / 2 / Math.tan(Math.PI / 8);
    const middle = middleOf(ballPositions);
    const local = Float32Array.from(ballPositions, (value, i) => value - middle[i % 3]!);
    const eye = viewpoint.map((value, axis) => value - middle[axis]!);
    const seen = Array.from({ length: local.length / 3 }, (_, i) => {
      const [x, y, depth] = [local[3 * i]! - eye[0]!, local[3 * i + 1]! - eye[1]!, eye[2]! - local[3 * i + 2]!];
      return { x: width / 2 + (x * pixels) / depth, y: height / 2 - (y * pixels) / depth, depth };
    });
    const said = slowly(seen, { width, height, pixels }, splat);
    const ours = await inNode(ballPositions, (cloud) => cloud.visibleFrom(viewpoint, { looks: 3 }).mask());
    const count = (test: (i: number) => boolean) => said.filter((kind, i) => kind !== 2 && test(i)).length;
    return {
      counts: [
        count((i) => said[i] === 1),
        count((i) => ours[i] === 1),
        count((i) => said[i] === 1 && ours[i] === 0),
        count((i) => said[i] === 0 && ours[i] === 1),
      ],
      of: count(() => true),
    };
  };
  await expect.poll(async () => (await figures(page)).counts).toEqual((await expected(before, 24)).counts);
  expect(await figures(page)).toMatchObject(await expected(before, 24));
  expect(await page.locator("#compare-note span").first().textContent()).toBe(
    `Z-buffer: ${(await figures(page)).counts[0]}`,
  );
  // Comparing does not ask the picture's own questions again.
  expect(await status(page)).toEqual(before);
  await expect.poll(() => page.url()).toMatch(/compare=0\.5&against=zbuffer&splat=24/);

  // When the camera is nearer, a part of the ball is out of the picture. A z-buffer knows nothing of this part.
  await page.locator("#view").focus();
  for (let i = 0; i < 12; i++) await page.keyboard.press("+");
  const near = await upToDate(page);
  expect(near.viewpoint[2] - MIDDLE[2]).toBeLessThan(0.7 * DISTANCE);
  const there = await expected(near, 24);
  expect(there.of).toBeLessThan(600);
  await expect.poll(async () => (await figures(page)).of).toBe(there.of);
  expect(await figures(page)).toMatchObject(there);
  expect(await page.locator("#compare-result").textContent()).toContain(
    `Shares of the ${there.of} points in the picture`,
  );

  // 1.75 spacings of a ball of radius 2 with 600 points are about 0.5 units.
  await page.locator("#splat-auto").click();
  await expect.poll(async () => Number(await page.getByLabel("Splat width").inputValue())).toBeGreaterThan(30);
  await expect.poll(() => page.url()).not.toContain("splat");
});

/** Computes the counts that the page must show for this viewpoint and radius. Uses the fidelity tables' tracer. */
async function bunnyTruth({ viewpoint, radius, total }: Status) {
  const seen = new RayTracer(bunny).visibleFrom(viewpoint);
  const mask = await inNode(bunny.positions, (cloud) => cloud.visibleFrom(viewpoint, { radius }).mask());
  const { falsePositives, falseNegatives } = errorsOf(mask, seen);
  const sum = (values: Uint8Array) => values.reduce((one, other) => one + other, 0);
  return {
    counts: [
      sum(seen),
      sum(mask),
      Math.round((falsePositives * total) / 100),
      Math.round((falseNegatives * total) / 100),
    ],
    shares: [falsePositives, falseNegatives],
  };
}

test("compared with the true surface: false positives and negatives, in color, for each view and setting", async () => {
  const page = await openReady("?sample=bunny&compare=0.2&against=surface&looks=0", SMALL);
  const first = await upToDate(page);
  const truth = await bunnyTruth(first);
  const shown = await figures(page);
  expect(shown).toMatchObject({ counts: truth.counts, of: 1839 });
  expect(Math.min(...truth.counts.slice(2))).toBeGreaterThan(0);
  const rows = page.locator("#compare-figures tr");
  expect(await rows.nth(2).innerText()).toMatch(
    new RegExp(`Wrongly shown\\s+${truth.counts[2]}\\s+${truth.shares[0]!.toFixed(2)}\\s%`),
  );
  expect(await rows.nth(3).innerText()).toMatch(
    new RegExp(`Wrongly hidden\\s+${truth.counts[3]}\\s+${truth.shares[1]!.toFixed(2)}\\s%`),
  );
  const colored = await picture(page);

  // Another radius has the same truth. It is not traced again.
  await unfold(page, "Advanced");
  await page.getByLabel("Exponent", { exact: true }).fill("1.5");
  const tight = await refiltered(page, first);
  const other = await figures(page, shown.text);
  expect(other).toMatchObject({ counts: (await bunnyTruth(tight)).counts, milliseconds: shown.milliseconds });

  // Another view is traced again when the camera rests.
  await drag(page, 120, 30);
  const turned = await upToDate(page);
  const there = await bunnyTruth(turned);
  await expect.poll(async () => (await figures(page)).counts).toEqual(there.counts);

  await page.getByRole("button", { name: "Reset view" }).click();
  await page.getByRole("button", { name: "Automatic" }).first().click();
  await expect.poll(async () => (await figures(page)).counts).toEqual(truth.counts);
  await page.getByRole("radio", { name: "All points" }).check();
  expect(await page.locator("#compare-figures").isVisible()).toBe(false);
  expect(await differentPixels(page, colored, await picture(page))).toBeGreaterThan(300);
});

test("compared with the true surface, looks stand beside the one hull, with the errors of both", async () => {
  const page = await openReady("?sample=dragon_res4&compare=0.2&against=surface", SMALL);
  const now = await upToDate(page);
  expect(now).toMatchObject({ answer: "looks", radius: 0, exponent: 0, evaluations: 0 });
  const { counts } = await figures(page);
  const [looks, hull] = await inNode(dragonPositions("_res4"), (cloud) => [
    cloud.visibleFrom(now.viewpoint, { looks: 3 }).count,
    cloud.visibleFrom(now.viewpoint).count,
  ]);
  const [truth, ours, wrong, missed, hullWrong, hullMissed] = counts as [
    number,
    number,
    number,
    number,
    number,
    number,
  ];
  expect(ours).toBe(looks);
  expect(ours - wrong).toBe(truth - missed);
  expect(hull - hullWrong).toBe(truth - hullMissed);
  // The reason for looks: fewer errors.
  expect(wrong + missed).toBeLessThan(hullWrong + hullMissed);
  expect(await page.locator("#compare-figures tr").nth(1).innerText()).toMatch(/^3 looks\s/);
  expect(await page.locator("#compare-result").textContent()).toMatch(
    /Together [\d.]+\s% are wrong, with one hull [\d.]+\s%\.$/,
  );
});

test("tracing can be stopped and taken up again", async () => {
  const page = await openReady("?sample=dragon_res4", SMALL);
  let release = () => {};
  const held = new Promise<void>((resolve) => (release = resolve));
  await page.route("**/*.faces", async (route) => {
    await held;
    await route.continue();
  });
  await page.locator("#view").press("c");
  await page.getByLabel("True surface").check();
  await page.getByRole("button", { name: "Stop", exact: true }).click();
  expect(await page.locator("#compare-result").textContent()).toBe("Tracing was stopped.");
  expect(await page.locator("#compare-note span").first().textContent()).toBe("All points");
  release();
  await page.getByRole("button", { name: "Trace rays" }).click();
  expect((await figures(page)).of).toBe(5205);
});

test("if no surface is known, the choice is disabled and says why", async () => {
  served.set("clouds/ball.ply", binaryPly(ball(300), "float", true));
  const page = await openReady("?src=clouds/ball.ply&compare=0.5&against=surface&looks=0", SMALL);
  expect(await page.locator("#message p").textContent()).toBe(
    "There is no true surface to compare with, so the comparison is with all points. A true surface is known only for samples, and for PLY and OBJ meshes that are shown whole.",
  );
  expect(await page.getByLabel("True surface").isDisabled()).toBe(true);
  expect(await page.getByRole("radio", { name: "All points" }).isChecked()).toBe(true);
  expect(await page.locator("#against-note").textContent()).toBe(
    "No true surface. A true surface is known only for samples, and for PLY and OBJ meshes that are shown whole.",
  );
  await expect.poll(() => page.url()).not.toContain("against");

  // The choice stays for the next cloud if that has a surface.
  await page.locator("#sample").selectOption("bunny");
  await expect.poll(async () => (await status(page)).total).toBe(1839);
  await page.getByLabel("True surface").check();
  await figures(page);
  const samples = await figures(page);

  // The same mesh as a file gives the same result.
  const obj = [
    ...corners.map((corner) => `v ${Array.from(Float32Array.from(corner)).join(" ")}`),
    ...cells.map((cell) => `f ${cell.map((corner) => corner + 1).join(" ")}`),
  ];
  await choose(page, "own.obj", text(obj.join("\n")));
  await expect.poll(() => page.locator("#own").textContent()).toBe("own.obj");
  await expect.poll(async () => (await figures(page)).counts).toEqual((await bunnyTruth(await upToDate(page))).counts);
  expect((await figures(page)).of).toBe(samples.of);

  await choose(page, "ball.ply", binaryPly(ball(300), "float", true));
  await expect.poll(async () => (await status(page)).total).toBe(300);
  expect(await page.getByRole("radio", { name: "All points" }).isChecked()).toBe(true);
});

test("a sentence names each comparison in the address that is not possible", () => {
  for (const query of ["against=mesh", "splat=0", "splat=2.5", "splat=65"]) {
    expect(readAddress(query, ["bunny"]).notes, query).toEqual([expect.stringMatching(/in the address is not/)]);
  }
  expect(readAddress("against=surface&splat=7", ["bunny"])).toMatchObject({
    notes: [],
    settings: { against: "surface", splat: 7 },
  });
});

test("by keys alone: choose, move the divider, leave; and the card fits its place at any width", async () => {
  const page = await openReady("?sample=bunny");
  await page.locator("#view").focus();
  await page.keyboard.press("c");
  await page.locator("#against input").first().focus();
  let last = "";
  for (const choice of ["Z-buffer", "True surface"]) {
    await page.keyboard.press("ArrowRight");
    expect(await page.getByLabel(choice).isChecked()).toBe(true);
    last = (await figures(page, last)).text;
    for (const [width, height] of [
      [320, 600],
      [390, 844],
      [1280, 800],
    ] as const) {
      await page.setViewportSize({ width, height });
      expect(await flaws(page), `${choice}, ${width} px`).toEqual([]);
    }
  }
  await page.locator("#divider").focus();
  await page.keyboard.press("ArrowRight");
  // In a window of another shape the camera has another place, so rays are traced again.
  await expect.poll(() => page.locator("#divider").getAttribute("aria-valuetext")).toMatch(/on the left 52 %, 3 looks/);
  await tool(page, "Compare").click();
  expect(await page.locator("#compare-card").isVisible()).toBe(false);
});

/** Parts of the card that cannot be read or pressed. */
function flaws(page: Page): Promise<string[]> {
  return page.evaluate(() => {
    const boxOf = (element: Element) => element.getBoundingClientRect();
    const card = document.getElementById("compare-card")!;
    const [canvas, bar, box] = [
      boxOf(document.getElementById("view")!),
      boxOf(document.getElementById("tool-bar")!),
      boxOf(card),
    ];
    const found: string[] = [];
    const slider = document.getElementById("splat")!;
    if (slider.checkVisibility() && boxOf(slider).width < 100) {
      found.push(`the slider is ${boxOf(slider).width} px wide`);
    }
    const divider = document.getElementById("divider")!;
    const grip = getComputedStyle(divider, "::after");
    const [top, left] = [boxOf(divider).top + Number.parseFloat(grip.top), boxOf(divider).left];
    if (top + Number.parseFloat(grip.height) > box.top && left < box.right) {
      found.push("the card lies over the divider's grip");
    }
    if (box.left < canvas.left || box.right > canvas.right || box.top < canvas.top || box.bottom > bar.top) {
      found.push("the card leaves its place");
    }
    for (const part of card.querySelectorAll("label, button, th, td")) {
      const { left, right } = boxOf(part);
      if (part.checkVisibility() && (left < box.left || right > box.right || part.scrollWidth > part.clientWidth + 1)) {
        found.push(`${part.textContent} is cut off`);
      }
    }
    return found;
  });
}
