import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { gzipSync } from "node:zlib";
import type { Page } from "playwright-core";
import { afterAll, beforeAll, expect, test } from "vitest";
import type { HiddenPointCloudElement, PickedPoint } from "../../www/element/api.js";
import { root } from "../root.js";
import { asciiPly, ball } from "./clouds.js";
import { pixelsOf } from "./pixels.js";
import { servePage, type Site } from "./site.js";
import { element, hears, heardBy, openStranger, settledState } from "./stranger.js";
import { inNode, openPage, provoke, served } from "./support.js";

const DIST = join(root, "www/dist");
const positions = ball(900);
/** A larger cloud at another place. */
const other = ball(1300).map((value, i) => 3 * value + [10, 20, 30][i % 3]!);
const TWO =
  '<hidden-point-cloud id="a" src="clouds/a.ply" exponent="2" viewpoint="1,2,9"></hidden-point-cloud><hidden-point-cloud id="b" src="clouds/b.ply"></hidden-point-cloud>';

let elsewhere: Site;

beforeAll(async () => {
  elsewhere = await servePage(new Map(), { "access-control-allow-origin": "*" });
  served.set("clouds/a.ply", asciiPly(positions));
  served.set("clouds/b.ply", asciiPly(other));
});

afterAll(() => {
  elsewhere.close();
});

async function openTwo(): Promise<Page> {
  const page = await openStranger(elsewhere.address, TWO);
  expect(await Promise.all([settledState(page, "a"), settledState(page, "b")])).toEqual(["ready", "ready"]);
  return page;
}

function seenBy(page: Page, id: string) {
  return element(page, id, ({ count, visible, visibleCount, viewpoint }) => ({
    count,
    visible: [...visible],
    visibleCount,
    viewpoint: viewpoint!,
  }));
}

/** Sets properties of the first element. */
function set(page: Page, values: Partial<HiddenPointCloudElement>): Promise<void> {
  return element(page, "a", (cloud, given) => void Object.assign(cloud, given), values);
}

/** The numbers of workers and of WebGL contexts. */
async function kept(page: Page): Promise<{ workers: number; pictures: number }> {
  return {
    workers: page.workers().length,
    pictures: await page.evaluate(() => (globalThis as unknown as { livePictures: () => number }).livePictures()),
  };
}

test("two elements from another origin, under a strict policy, answer as the package does, in one worker", async () => {
  const page = await openTwo();
  // The final answer of the one without an exponent is that of three looks.
  await expect.poll(async () => (await heardBy(page, "b", "change")).at(-1)).toMatchObject({ answer: "looks" });
  const [a, b] = [await seenBy(page, "a"), await seenBy(page, "b")];
  expect(a.viewpoint).toEqual([1, 2, 9]);
  expect(a.visible).toEqual(
    await inNode(positions, (cloud) => [...cloud.visibleFrom([1, 2, 9], { exponent: 2 }).indices]),
  );
  expect(b.visible).toEqual(await inNode(other, (cloud) => [...cloud.visibleFrom(b.viewpoint, { looks: 3 }).indices]));
  expect([a.count, a.visibleCount, b.count]).toEqual([900, a.visible.length, 1300]);
  expect(await heardBy(page, "a", "load")).toEqual([{ total: 900, notes: [] }]);
  expect((await heardBy(page, "a", "change"))[0]).toMatchObject({ count: a.visibleCount, viewpoint: [1, 2, 9] });
  expect((await heardBy(page, "a", "progress")).length).toBeGreaterThan(0);
  expect(await heardBy(page, "a", "error")).toEqual([]);
  await expect.poll(() => kept(page)).toEqual({ workers: 1, pictures: 2 });
  expect(await page.evaluate(() => (globalThis as unknown as { forbidden: string[] }).forbidden)).toEqual([]);

  // The cloud is drawn: the picture has many colors.
  const colors = await element(page, "a", async (cloud) => {
    const bitmap = await createImageBitmap(await cloud.toBlob());
    const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d")!;
    context.drawImage(bitmap, 0, 0);
    return new Set(new Uint32Array(context.getImageData(0, 0, bitmap.width, bitmap.height).data.buffer)).size;
  });
  expect(colors).toBeGreaterThan(20);
});

test("an element that is removed stops, one that returns starts again, one that is moved goes on", async () => {
  const page = await openTwo();
  await page.evaluate(() => {
    const a = document.getElementById("a")!;
    document.body.append(a, document.createElement("section"));
    document.querySelector("section")!.append(a);
  });
  // The worker that has read the files ends a moment later.
  await expect.poll(() => kept(page)).toEqual({ workers: 1, pictures: 2 });
  expect(await heardBy(page, "a", "load")).toHaveLength(1);

  for (let round = 1; round <= 2; round++) {
    await page.evaluate(() => {
      const [a, b] = [document.getElementById("a")!, document.getElementById("b")!];
      Object.assign(globalThis, { removed: [a, b] });
      a.remove();
      b.remove();
    });
    await expect.poll(() => kept(page)).toEqual({ workers: 0, pictures: 0 });
    expect(
      await page.evaluate(() =>
        (globalThis as unknown as { removed: { count: number; state: string }[] }).removed.map(({ count, state }) => [
          count,
          state,
        ]),
      ),
    ).toEqual([
      [0, "empty"],
      [0, "empty"],
    ]);
    await page.evaluate(() => {
      document.body.append(...(globalThis as unknown as { removed: Node[] }).removed);
    });
    expect(await Promise.all([settledState(page, "a"), settledState(page, "b")])).toEqual(["ready", "ready"]);
    await expect.poll(() => kept(page)).toEqual({ workers: 1, pictures: 2 });
    expect((await seenBy(page, "a")).count).toBe(900);
    expect(await element(page, "a", (cloud) => cloud.shadowRoot!.querySelectorAll("canvas").length)).toBe(1);
  }
});

test("attributes and properties are followed, and invalid values are reported", async () => {
  const page = await openTwo();
  // Looks for the change before may still come, so not only the first event counts.
  const change = async (act: () => Promise<unknown>, expected: object) => {
    const before = (await heardBy(page, "a", "change")).length;
    await act();
    await expect
      .poll(async () => (await heardBy(page, "a", "change")).slice(before))
      .toContainEqual(expect.objectContaining(expected));
  };
  const answer = async (ask: object) => ({
    viewpoint: [1, 2, 9],
    count: await inNode(positions, (cloud) => cloud.visibleFrom([1, 2, 9], ask).count),
  });

  await change(() => set(page, { exponent: 4 }), await answer({ exponent: 4 }));
  expect(await page.locator("#a").getAttribute("exponent")).toBe("4");
  await change(() => set(page, { exponent: null, radius: 250 }), { ...(await answer({ radius: 250 })), radius: 250 });
  await change(() => set(page, { inversion: "exponential" }), await answer({ inversion: { exponential: "auto" } }));
  await change(() => set(page, { inversion: null, radius: null }), await answer({ looks: 3 }));
  await change(() => set(page, { viewpoint: [9, 0, 3], target: [0, 1, 0] }), { viewpoint: [9, 0, 3] });
  expect(await element(page, "a", ({ target }) => target)).toEqual([0, 1, 0]);

  // A frozen viewpoint stays when the camera moves.
  await element(page, "a", async (cloud) => {
    cloud.frozen = true;
    await Promise.resolve();
    cloud.viewpoint = [-9, 1, 0];
  });
  expect(await element(page, "a", ({ viewpoint }) => viewpoint)).toEqual([-9, 1, 0]);
  expect((await heardBy(page, "a", "change")).at(-1)!.viewpoint).toEqual([9, 0, 3]);
  await set(page, { frozen: false });
  await expect.poll(async () => (await heardBy(page, "a", "change")).at(-1)!.viewpoint).toEqual([-9, 1, 0]);

  // The keys of the page work, and the attributes follow them.
  await element(page, "a", (cloud) => {
    cloud.focus();
  });
  await page.keyboard.press("h");
  await page.keyboard.press("v");
  expect(await element(page, "a", ({ hiddenPoints, frozen }) => [hiddenPoints, frozen])).toEqual(["dimmed", true]);
  await page.keyboard.press("v");
  expect(await page.locator("#a").getAttribute("frozen")).toBeNull();
  const elsewhere = expect.not.arrayContaining([-9]) as number[];
  await change(() => page.keyboard.press("ArrowLeft"), { viewpoint: elsewhere });
  await change(() => page.keyboard.press("r"), { viewpoint: [-9, 1, 0] });

  const wrong = {
    exponent: "7",
    radius: "-1",
    inversion: "power",
    "hidden-points": "some",
    viewpoint: "1,2",
    "point-size": "0",
    fov: "400",
    up: "x",
    sample: "dragon",
    color: "smell",
  };
  for (const [name, value] of Object.entries(wrong)) {
    const error = await hears(page, "a", "error", () =>
      element(
        page,
        "a",
        (cloud, given) => {
          cloud.setAttribute(...given);
        },
        [name, value] as [string, string],
      ),
    );
    expect(error, name).toMatchObject({ code: "attribute", attribute: name });
    expect(error.message).toContain(value === "dragon" ? "exclude" : value);
  }
  expect((await heardBy(page, "a", "error")).map(({ attribute }) => attribute)).toEqual(Object.keys(wrong));
  expect(
    await element(page, "a", ({ state, count, exponent, hiddenPoints, up }) => [
      state,
      count,
      exponent,
      hiddenPoints,
      up,
    ]),
  ).toEqual(["ready", 900, null, "off", null]);
  const far = await hears(page, "a", "error", () => set(page, { viewpoint: [1e300, 0, 0] }));
  expect(far).toMatchObject({
    attribute: "viewpoint",
    message: expect.stringMatching(/^The view that is asked for is too far away/) as string,
  });
  // The radius is a number, but too small for this cloud.
  const small = await hears(page, "a", "error", () => set(page, { radius: 0.001 }));
  expect(small).toMatchObject({ code: "attribute" });
  expect(small.message).toMatch(/do not suit/);
});

test("a missing file, a file that is no cloud, and a file that comes too late", async () => {
  provoke(/404/);
  served.set("clouds/page.ply", Buffer.from("<!doctype html>"));
  const page = await openStranger(
    elsewhere.address,
    '<hidden-point-cloud id="a" src="clouds/none.ply"><p>Text</p></hidden-point-cloud>',
  );
  const refused = await element(page, "a", (cloud) =>
    cloud.ready.catch((error: unknown) => (error as { code: string }).code),
  );
  expect(refused).toBe("source");
  expect(await heardBy(page, "a", "error")).toEqual([
    { code: "source", attribute: undefined, message: "none.ply could not be downloaded: the server answered 404." },
  ]);
  expect(await element(page, "a", ({ state, count }) => [state, count])).toEqual(["error", 0]);
  expect(await page.locator("#a").locator('[part="error"]').textContent()).toContain("404");

  const second = await hears(page, "a", "error", () => set(page, { src: "clouds/page.ply" }));
  expect(second).toMatchObject({
    code: "source",
    message: "page.ply cannot be read: it is XML or a page of the web, and no points.",
  });

  // An empty `src` names no file.
  const none = await hears(page, "a", "error", () => set(page, { src: "" }));
  expect(none).toEqual({ code: "attribute", attribute: "src", message: "The attribute src names no file." });
  expect(await element(page, "a", ({ state }) => state)).toBe("empty");

  // The load of the first file is given up, and reports nothing.
  await element(page, "a", async (cloud) => {
    cloud.src = "clouds/b.ply";
    await Promise.resolve();
    cloud.src = "clouds/a.ply";
    await cloud.ready;
  });
  expect(await heardBy(page, "a", "load")).toEqual([{ total: 900, notes: [] }]);
  const complaint = page.locator("#a").locator('[part="error"]');
  expect(await complaint.isVisible()).toBe(false);

  // The browser takes the WebGL context away, and gives it back.
  const context = await page
    .locator("#a canvas")
    .evaluateHandle((canvas: HTMLCanvasElement) => canvas.getContext("webgl2")!.getExtension("WEBGL_lose_context")!);
  const taken = await hears(page, "a", "error", () =>
    context.evaluate((extension) => {
      extension.loseContext();
    }),
  );
  expect(taken).toMatchObject({ code: "webgl", message: expect.stringContaining("taken this picture away") as string });
  expect(await element(page, "a", (cloud) => cloud.toBlob().catch(String))).toMatch(/taken the picture away/);
  await context.evaluate((extension) => {
    extension.restoreContext();
  });
  await expect.poll(() => complaint.isVisible()).toBe(false);
  expect(await element(page, "a", async (cloud) => (await cloud.toBlob()).size)).toBeGreaterThan(1000);

  await set(page, { src: null });
  expect(await element(page, "a", ({ state, count, visible }) => [state, count, visible.length])).toEqual([
    "empty",
    0,
    0,
  ]);
  await expect.poll(() => kept(page)).toEqual({ workers: 0, pictures: 1 });
});

test("of twenty elements on a page, those in sight are drawn, and the others give up their contexts", async () => {
  const twenty = Array.from({ length: 20 }, (_, i) => {
    const style = "display: block; height: 330px";
    return `<hidden-point-cloud id="e${i}" src="clouds/a.ply" style="${style}"></hidden-point-cloud>`;
  });
  const page = await openStranger(elsewhere.address, twenty.join(""));
  const inSight = async (...ids: string[]) => {
    await expect.poll(async () => (await kept(page)).pictures).toBeLessThan(8);
    for (const id of ids) await expect.poll(() => colorsOf(page, id)).toBeGreaterThan(20);
  };
  for (let i = 0; i < 20; i++) expect(await settledState(page, `e${i}`)).toBe("ready");
  await inSight("e0", "e1");
  await page.evaluate(() => {
    scrollTo(0, document.body.scrollHeight);
  });
  await inSight("e18", "e19");
  // A picture out of sight can still be taken, and its element answers.
  expect(await element(page, "e0", async (cloud) => (await cloud.toBlob()).size)).toBeGreaterThan(1000);
  await element(page, "e0", (cloud) => void (cloud.viewpoint = [1, 2, 9]));
  await expect.poll(async () => (await heardBy(page, "e0", "change")).at(-1)).toMatchObject({ viewpoint: [1, 2, 9] });
  await page.evaluate(() => {
    scrollTo(0, 0);
  });
  await inSight("e0", "e1");
  for (let i = 0; i < 20; i++) expect(await heardBy(page, `e${i}`, "error")).toEqual([]);
});

/** How many colors are on the screen where the element is. */
async function colorsOf(page: Page, id: string): Promise<number> {
  const { data } = await pixelsOf(await page.locator(`#${id}`).screenshot());
  return new Set(new Uint32Array(new Uint8Array(data).buffer)).size;
}

test("visible points are picked and hidden ones are not, and the page around scrolls until the picture has the focus", async () => {
  const page = await openStranger(elsewhere.address, TWO, "<p>".repeat(100));
  await settledState(page, "a");
  const { visible, hits, through } = await element(page, "a", (cloud) => {
    const places: (PickedPoint | null)[] = [];
    const others: (PickedPoint | null)[] = [];
    const { left, top, width, height } = cloud.getBoundingClientRect();
    for (let i = 0; i < 400; i++) {
      const at = [left + ((i % 20) / 20) * width, top + (Math.floor(i / 20) / 20) * height] as const;
      places.push(cloud.pick(...at));
      others.push(cloud.pick(...at, { through: true, tolerance: 3 }));
    }
    return {
      visible: [...cloud.visible],
      hits: places.filter((point) => point !== null),
      through: others.filter((point) => point !== null),
    };
  });
  expect(hits.length).toBeGreaterThan(20);
  for (const { index, position, visible: seen } of hits) {
    expect(seen && visible.includes(index)).toBe(true);
    expect(position).toEqual([...positions.slice(3 * index, 3 * index + 3)]);
  }
  expect(through.some((point) => !point.visible)).toBe(true);
  for (const point of through) expect(point.visible).toBe(visible.includes(point.index));

  // `project` gives the place of a point on the screen. Picking at this place gives the same point.
  const { index, position } = hits[0]!;
  const spot = (await element(page, "a", (cloud, place) => cloud.project(place), position))!;
  expect(await element(page, "a", (cloud, { x, y }) => cloud.pick(x, y, { tolerance: 0.5 })?.index, spot)).toBe(index);
  expect((await hears(page, "a", "pick", () => page.mouse.click(spot.x, spot.y))).index).toBe(index);
  expect(
    await element(page, "a", (cloud) => {
      try {
        cloud.pick(NaN, 0);
        return "";
      } catch (error) {
        return String(error);
      }
    }),
  ).toMatch(/TypeError/);

  // The click has given the element the focus, so the wheel zooms.
  const zoomed = await hears(page, "a", "change", () => page.mouse.wheel(0, 120));
  expect(zoomed.viewpoint).not.toEqual([1, 2, 9]);
  expect(await page.evaluate(() => scrollY)).toBe(0);
  await page.evaluate(() => {
    (document.activeElement as HTMLElement).blur();
  });
  const before = await element(page, "a", ({ viewpoint }) => viewpoint);
  await page.mouse.wheel(0, 120);
  await expect.poll(() => page.evaluate(() => scrollY)).toBeGreaterThan(0);
  expect(await element(page, "a", ({ viewpoint }) => viewpoint)).toEqual(before);
  expect(await element(page, "a", (cloud) => cloud.shadowRoot!.querySelector("canvas")!.style.touchAction)).toBe(
    "pan-y",
  );
});

test("screen readers get a description of the element", async () => {
  const page = await openStranger(
    elsewhere.address,
    '<hidden-point-cloud id="a" sample="bunny" label="A rabbit"></hidden-point-cloud>',
  );
  await settledState(page, "a");
  const canvas = page.locator("#a").locator("canvas");
  const label = (await canvas.getAttribute("aria-label"))!;
  expect(label).toMatch(/^A rabbit\. Arrow keys orbit/);
  await page.keyboard.press("Tab");
  // The key that the label names freezes the viewpoint.
  const [, named] = /(\w+) freezes the viewpoint/.exec(label)!;
  const frozen = () => element(page, "a", (cloud) => cloud.frozen);
  await page.keyboard.press(named!.toLowerCase());
  expect(await frozen()).toBe(true);
  await page.keyboard.press(named!.toLowerCase());
  expect(await frozen()).toBe(false);
  expect(await element(page, "a", (cloud) => cloud.shadowRoot!.activeElement?.localName)).toBe("canvas");
});

test("until its first cloud it downloads at most 400 kB, with three.js and the WebAssembly", async () => {
  const page = await openStranger(elsewhere.address, "");
  const asked = new Set<string>();
  page.context().on("request", (request) => {
    if (request.url().startsWith(elsewhere.address)) asked.add(request.url().slice(elsewhere.address.length));
  });
  await page.reload();
  await page.evaluate((body) => {
    document.body.innerHTML = body;
  }, TWO);
  expect(await settledState(page, "a")).toBe("ready");
  const sizes = Object.fromEntries(
    [...asked].map((name) => [name, gzipSync(readFileSync(join(DIST, name)), { level: 9 }).length]),
  );
  const sum = Object.values(sizes).reduce((total, size) => total + size, 0);
  // The module, the package's worker and the wasm. Workers also request their scripts, and the loader of the format.
  expect(Object.keys(sizes)).toEqual(
    expect.arrayContaining(["hidden-point-cloud.js", expect.stringMatching(/hpr_bg.*\.wasm/) as string]),
  );
  expect(sum).toBeLessThanOrEqual(400_000);
});

test("a notebook of Python hands it a cloud", async () => {
  const [, script] = /^SCRIPT = """(.*?)"""/ms.exec(
    readFileSync(join(root, "python/hidden_point_removal/_show.py"), "utf8"),
  )!;
  served.set("widget.js", Buffer.from(script!));
  served.set(
    "notebook.html",
    Buffer.from('<!doctype html><html lang="en"><head><link rel="icon" href="data:,"></head><body></body></html>'),
  );
  const page = await openPage("notebook.html");
  const shown = await page.evaluate(`(async () => {
    const { default: widget } = await import(new URL("widget.js", location.href).href);
    const file = new DataView(Uint8Array.from(${JSON.stringify([...asciiPly(positions)])}).buffer);
    const model = new Map([["element", "${elsewhere.address}hidden-point-cloud.js"], ["file", file]]);
    await widget.render({ model, el: document.body });
    const cloud = document.querySelector("hidden-point-cloud");
    await cloud.ready;
    return [cloud.count, cloud.hiddenPoints];
  })()`);
  expect(shown).toEqual([900, "shown"]);
});

test("a server can import it, and its types are beside it", () => {
  const address = pathToFileURL(join(DIST, "hidden-point-cloud.js")).href;
  const names = execFileSync(
    process.execPath,
    ["--input-type=module", "-e", `console.log(Object.keys(await import("${address}")).join())`],
    { encoding: "utf8" },
  );
  expect(names.trim()).toBe("HiddenPointCloudElement");
  const types = readFileSync(join(DIST, "hidden-point-cloud.d.ts"), "utf8");
  for (const name of [
    "export interface HiddenPointCloudElement extends HTMLElement",
    "HTMLElementTagNameMap",
    "export declare const HiddenPointCloudElement",
  ]) {
    expect(types).toContain(name);
  }
});
