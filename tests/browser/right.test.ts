import { createRequire } from "node:module";
import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { oracleFor } from "../../www/compare/oracles.js";
import { Projected, zBuffer } from "../../www/compare/zbuffer.js";
import { make as makeRoom } from "../../www/samples/living-room.js";
import { make as makeTile } from "../../www/samples/tile.js";
import { grid, type Mesh } from "../../www/samples/generator.js";
import { RayTracer } from "../fidelity/rays.js";
import { errorsOf } from "../fidelity/score.js";
import { asciiPly, ball } from "./clouds.js";
import { inNode, openReady, served, upToDate } from "./support.js";

const { positions: corners, cells } = createRequire(import.meta.url)("bunny") as {
  positions: number[][];
  cells: number[][];
};
const bunny: Mesh = { positions: Float32Array.from(corners.flat()), triangles: Uint32Array.from(cells.flat()) };
const TOLERANCE = 1.75;
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

test("the scanner of the street sees all points that its own beams met", async () => {
  const street = await oracleFor({ sample: "street" }, new Float32Array());
  const sees = street.from([-21, 1.1, 1.75]);
  // These points belong to the first of three stations. The first 60,000 points are from this station.
  const tried = Array.from({ length: 1500 }, (_, i) => 28 * i);
  expect(tried.filter((i) => !sees(i))).toEqual([]);
  // From the other end of the street, many points are hidden.
  const other = street.from([22, 0.9, 1.75]);
  const share = tried.filter(other).length / tried.length;
  expect(share).toBeGreaterThan(0.1);
  expect(share).toBeLessThan(0.8);
});

test("in the room the ceiling is seen, and no points lie under the rug or behind the pictures, where no scanner could tell", async () => {
  const room = await oracleFor({ sample: "room" }, new Float32Array());
  const { positions } = makeRoom();
  expect(room.count).toBe(positions.length / 3);
  const sees = room.from([-0.2, 2.4, 0.3]);
  const share = (like: (x: number, y: number, z: number) => boolean) => {
    const chosen = Array.from({ length: room.count }, (_, i) => i).filter((i) =>
      like(positions[3 * i]!, positions[3 * i + 1]!, positions[3 * i + 2]!),
    );
    expect(chosen.length).toBeGreaterThan(1000);
    const tried = chosen.filter((_, i) => i % 4 === 0);
    return tried.filter(sees).length / tried.length;
  };
  // The bookcase, the lamp and the plant hide small parts of the ceiling.
  expect(share((_x, y) => y > 2.69)).toBeGreaterThan(0.97);
  const among = (like: (x: number, y: number, z: number) => boolean) =>
    Array.from({ length: room.count }, (_, i) => i).filter((i) =>
      like(positions[3 * i]!, positions[3 * i + 1]!, positions[3 * i + 2]!),
    ).length;
  // The legs of the table on the rug have a few.
  expect(among((x, y, z) => y < 0.004 && x > -1.99 && x < 0.59 && z > -1.09 && z < 0.79)).toBeLessThan(20);
  expect(among((x, y, z) => x < -2.994 && y > 1.36 && y < 1.94 && z > -0.49 && z < 0.39)).toBe(0);
});

test("in the tile, the airplane sees what its beams met, and from the ground the houses hide what is behind them", async () => {
  const tile = await oracleFor({ sample: "tile" }, new Float32Array());
  const { positions, attributes } = makeTile();
  expect(tile.count).toBe(positions.length / 3);
  const [kinds, returns] = [attributes![1]!.values, attributes![2]!.values];
  /** The share of every 5th point of these classes that a place sees, first returns only. */
  const share = (at: readonly number[], ...like: number[]) => {
    const sees = tile.from(at);
    const tried = Array.from({ length: tile.count / 5 }, (_, i) => 5 * i).filter(
      (i) => like.includes(kinds[i]!) && returns[i] === 1 && positions[3 * i]! < 512_160,
    );
    expect(tried.length).toBeGreaterThan(100);
    return tried.filter(sees).length / tried.length;
  };
  // The flight line of the western strip.
  const airplane = [512_070, 5_403_160, 1124];
  expect(share(airplane, 2, 3, 11)).toBeGreaterThan(0.98);
  expect(share(airplane, 6)).toBeGreaterThan(0.95);
  expect(share(airplane, 5)).toBeGreaterThan(0.8);
  // A man on the road.
  expect(share([512_070, 5_403_160, 434], 2, 3)).toBeLessThan(0.8);
  expect(share([512_070, 5_403_160, 434], 6)).toBeLessThan(0.6);
});

/** Opens the judgment. Returns the shares in its table, row by row. */
async function judged(page: Page): Promise<number[][]> {
  await page.locator(".right").evaluate((button: HTMLElement) => button.click());
  const rows = page.locator("#right tbody tr");
  await rows.first().waitFor();
  return rows.evaluateAll((all) =>
    all.map((row) => [...row.querySelectorAll("td")].map((cell) => Number.parseFloat(cell.textContent))),
  );
}

test("How right is it? has the errors of one hull and of looks against rays", async () => {
  // The whole bunny is in the picture.
  const page = await openReady("?sample=bunny");
  const { viewpoint } = await upToDate(page);
  const seen = new RayTracer(bunny).visibleFrom(viewpoint);
  const shares = await inNode(bunny.positions, (cloud) =>
    [{}, { looks: 3 as const }].map((options) => {
      const { falsePositives, falseNegatives } = errorsOf(cloud.visibleFrom(viewpoint, options).mask(), seen);
      return [falsePositives, falseNegatives, falsePositives + falseNegatives].map((share) => Number(share.toFixed(2)));
    }),
  );
  const first = await judged(page);
  expect(first.slice(1)).toEqual(shares);
  expect(shares[1]![2]).toBeLessThan(shares[0]![2]!);
  expect(await page.locator("#right .best th").textContent()).toMatch(/^Three looks/);
  expect(await page.locator("#right canvas").count()).toBe(3);
});

test("the first screen says how right its picture is, as How right is it? does", async () => {
  const page = await openReady("?turn=0", { viewport: { width: 1280, height: 720 }, deviceScaleFactor: 1 }, (opened) =>
    opened.addInitScript(() => {
      localStorage.removeItem("hidden-point-removal: tools");
    }),
  );
  const [wrong, buffered] = (await page.locator("[data-verdict]").innerText()).match(/[\d.]+/g)!.map(Number);
  const [first, , looks] = await judged(page);
  // The bar moves the picture up, so a few other points are in it.
  expect(Math.abs(wrong! - looks![2]!)).toBeLessThan(0.2);
  expect(Math.abs(buffered! - first![2]!)).toBeLessThan(0.3);
});

test("a cloud without a known surface says so", async () => {
  served.set("clouds/ball.ply", asciiPly(ball(300)));
  const page = await openReady("?src=clouds/ball.ply");
  await page.locator(".right").evaluate((button: HTMLElement) => button.click());
  await expect.poll(() => page.locator("#right").textContent()).toContain("Nobody knows which points");
});
