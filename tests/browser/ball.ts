import type { BrowserContextOptions, Page } from "playwright-core";
import { binaryPly, georeferencedBall } from "./clouds.js";
import { inNode, openReady, served, upToDate } from "./support.js";

/*
 * The ball of 600 points has UTM coordinates. In f32 they would be wrong by half a meter. The camera looks at the ball
 * from straight ahead, so that tests can compute where its points are in the picture.
 */
const COUNT = 600;
export const positions = georeferencedBall(COUNT);
export const MIDDLE = [512_345.5, 5_403_210.25, 431.75] as const;
const [X, Y, Z] = MIDDLE;
export const DISTANCE = 9;
const FRONT = [X, Y, Z + DISTANCE];

/** Opens the page with the ball, or with a file of the ball that the test made. */
export async function openBall(
  options: BrowserContextOptions = {},
  view: readonly number[] = FRONT,
  file = binaryPly(positions, "double", true),
  prepare?: (page: Page) => Promise<void>,
  marks = "",
): Promise<Page> {
  served.set("clouds/utm.ply", file);
  return openReady(
    `?src=clouds/utm.ply&up=y&size=2&view=${view.join()}&target=${MIDDLE.join()}${marks}`,
    options,
    prepare,
  );
}

export const at = (index: number): [number, number, number] => [
  positions[3 * index]!,
  positions[3 * index + 1]!,
  positions[3 * index + 2]!,
];

interface Place {
  x: number;
  y: number;
}

/** Where a point is on the screen, seen from FRONT. */
export async function place(page: Page, index: number): Promise<Place> {
  return (await places(page))(index);
}

/** Tells where points are on the screen, as long as the picture has its size. */
async function places(page: Page): Promise<(index: number) => Place> {
  const box = (await page.locator("#view").boundingBox())!;
  return (index) => {
    const [x, y, z] = at(index);
    const ahead = DISTANCE - (z - Z);
    const pixels = box.height / 2 / Math.tan(Math.PI / 8) / ahead;
    return { x: box.x + box.width / 2 + (x - X) * pixels, y: box.y + box.height / 2 - (y - Y) * pixels };
  };
}

export async function clickPoint(page: Page, index: number): Promise<void> {
  const { x, y } = await place(page, index);
  await page.mouse.click(x, y);
}

/** The indices of the points that are visible from the page's camera, ascending. */
export async function visible(page: Page): Promise<number[]> {
  const { viewpoint } = await upToDate(page);
  return inNode(positions, (cloud) => [...cloud.visibleFrom(viewpoint, { looks: 3 }).indices]);
}

/** The points of `among` that are far from all other points of `rivals` in the picture. */
export async function lonely(page: Page, among: number[], rivals: number[]): Promise<number[]> {
  const placeOf = await places(page);
  const taken = rivals.map((i) => ({ i, ...placeOf(i) }));
  return among.filter((i) => {
    const own = placeOf(i);
    return taken.every((other) => other.i === i || Math.hypot(own.x - other.x, own.y - other.y) > 12);
  });
}

export const everything = Array.from({ length: COUNT }, (_, i) => i);
export const tool = (page: Page, name: string) => page.locator("#tool-bar").getByRole("button", { name });

/** The points of `among` within a box on the screen. */
export async function within(
  page: Page,
  among: number[],
  box: { left: number; top: number; right: number; bottom: number },
): Promise<number[]> {
  const placeOf = await places(page);
  return among.filter((i) => {
    const { x, y } = placeOf(i);
    return x > box.left && x < box.right && y > box.top && y < box.bottom;
  });
}
