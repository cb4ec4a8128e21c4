// The address opens the page with a cloud, a view, settings, marks and stations, and has them after each change.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { expect, test } from "vitest";
import { readAddress } from "../../www/settings/address.js";
import { asciiPly, ball } from "./clouds.js";
import {
  addressWritten,
  answered,
  answerInNode,
  drag,
  openPage,
  openReady,
  PHONE,
  reached,
  refiltered,
  served,
  settled,
  site,
  status,
  type Status,
  unfold,
  upToDate,
} from "./support.js";
import { type Page } from "playwright-core";

const bunny = createRequire(import.meta.url)("bunny") as { positions: number[][] };

test("?sample=dragon_res3 shows this sample, with its license", async () => {
  const page = await openReady("?sample=dragon_res3&looks=0");
  const { total, visible } = await status(page);
  expect(total).toBe(22_998);
  expect(visible).toBeGreaterThan(0);
  expect(visible).toBeLessThan(total);
  expect(await page.locator("#sample").inputValue()).toBe("dragon_res3");
  expect(await page.locator("#panel .credit").textContent()).toMatch(
    /Stanford Computer Graphics Laboratory.*no commercial use/,
  );
});

test("?sample, ?view and ?exponent together give exactly the package's answer", async () => {
  const page = await openReady("?sample=bunny&view=1.5,8.25,-12.125&exponent=2.5");
  const now = await settled(page);
  expect(now.viewpoint).toEqual([1.5, 8.25, -12.125]);
  expect(now.exponent).toBeCloseTo(2.5, 12);
  const positions = Float32Array.from(bunny.positions.flat());
  expect(now).toMatchObject(await answerInNode(positions, now, { exponent: 2.5 }));
});

test("?src opens a file from the web", async () => {
  const positions = ball(700);
  served.set("clouds/ball.ply", asciiPly(positions));
  const page = await openReady("?src=clouds/ball.ply&view=0,0,9");
  const now = await settled(page);
  expect(now.total).toBe(700);
  expect(now.viewpoint).toEqual([0, 0, 9]);
  expect(now).toMatchObject(await answerInNode(positions, now));
  expect(await page.locator("#panel .credit").textContent()).toContain("ball.ply");
});

test("a plain sentence names each parameter of the address that cannot be met", async () => {
  const page = await openReady("?sample=unicorn&exponent=-1&view=1,2");
  expect(await page.locator("#sample").inputValue()).toBe("room");
  const message = await page.locator("#message").textContent();
  for (const part of [/no sample called “unicorn”/, /exponent .* is not a number/, /view .* is not three numbers/]) {
    expect(message).toMatch(part);
  }
});

test.for([
  [
    "exponent=400&points=1.5&src=",
    [
      /exponent in the address is not a number from 0 to 6/,
      /names no file after “src=”/,
      /number of points in the address is not an integer from 1 to 10000000, so the largest of these is used/,
    ],
  ],
  [
    "radius=-1&inversion=power&freeze=1&hidden=maybe&size=0&fov=400&up=x&target=1,2&compare=2&theme=sepia",
    [
      /radius/,
      /inversion/,
      /frozen viewpoint/,
      /hidden points/,
      /point size/,
      /field of view/,
      /side that is up/,
      /target/,
      /place of the divider/,
      /theme in the address is not system, dark or light/,
    ],
  ],
] as const)("?%s: each is refused with a note, and nothing of it is used", ([query, notes]) => {
  const asked = readAddress(query, ["bunny"]);
  for (const note of notes) expect(asked.notes.join(" ")).toMatch(note);
  expect(asked.notes).toHaveLength(notes.length);
  expect(asked).toMatchObject({ settings: {}, src: null, view: null, target: null });
});

test.for([
  [
    "exponent=abc&radius=9",
    { length: 9 },
    "The exponent in the address is not a number from 0 to 6, so the radius is used.",
  ],
  [
    "radius=40&exponent=2",
    { exponent: 2 },
    "Radius and exponent in the address exclude each other, so the exponent is used.",
  ],
] as const)("?%s: one of the two is used, and a note says which", ([query, radius, note]) => {
  expect(readAddress(query, ["bunny"])).toMatchObject({ settings: { radius }, notes: [note] });
});

test("a view and a frozen viewpoint out of reach are refused with a note, and the sample is seen as usual", async () => {
  const usual = await status(await openReady("?sample=bunny"));
  const page = await openReady("?sample=bunny&view=1e19,0,0&freeze=1e300,0,0");
  const { state, total, visible, viewpoint } = usual;
  expect(await settled(page)).toMatchObject({ state, total, visible, viewpoint });
  const message = await page.locator("#message").textContent();
  expect(message).toMatch(/view in the address is too far away.*frozen viewpoint in the address is too far away/);
});

test("a target out of reach is refused with a note, and the address keeps no invalid numbers", async () => {
  const page = await openReady("?sample=bunny&view=0,5,30&target=1e300,0,0");
  expect((await settled(page)).viewpoint).toEqual([0, 5, 30]);
  expect(await page.locator("#message").textContent()).toMatch(/target in the address is too far away/);
  await page.waitForFunction(() => !location.search.includes("target="));
  expect(page.url()).toContain("view=0,5,30");
});

test("a sample that is picked is in the address", async () => {
  const page = await openReady("?sample=bunny&view=1,2,3&exponent=2");
  const before = await status(page);
  await page.locator("#sample").selectOption("dragon_res4");
  await answered(page, before);
  expect(new URL(page.url()).search).toBe("?sample=dragon_res4&exponent=2");
});

test("?src is refused in a plain sentence if it is no address of a file", async () => {
  for (const [src, sentence] of [
    ["//", "“//” is not the address of a file."],
    ["data:text/plain,1", "“data:text/plain,1” is not the address of a file."],
  ] as const) {
    const page = await openPage(`?src=${src}&sample=bunny`);
    expect((await reached(page, "error")).sentence).toBe(sentence);
  }
});

test("?src of a page instead of a cloud is refused in a plain sentence, and the usual sample is there", async () => {
  served.set("clouds/lost.ply", readFileSync(new URL("../../www/index.html", import.meta.url)));
  const page = await openPage("?src=clouds/lost.ply&sample=bunny");
  const { sentence } = await reached(page, "error");
  expect(sentence).toMatch(/lost\.ply cannot be read: it is XML or a page of the web/);
  await page.locator('#status[data-total="1839"]').waitFor();
  const now = await settled(page);
  expect(now.state).toBe("error");
  expect(await page.locator("#status").textContent()).toBe(sentence);
  expect(await page.locator("#message p").textContent()).toBe(sentence);
  expect(await page.locator("#sample").inputValue()).toBe("bunny");
  await page.locator("#view").press("ArrowLeft");
  expect((await refiltered(page, now)).state).toBe("ready");
});

/** The query of the address, after the page has written its last change. */
async function written(page: Page): Promise<string> {
  await addressWritten(page);
  return new URL(page.url()).search;
}

function same({ visible, viewpoint, radius, inversion }: Status) {
  return { visible, viewpoint, radius, inversion };
}

test("a copied address shows the same cloud, camera and settings again", async () => {
  const page = await openReady("?sample=dragon_res4");
  await unfold(page, "Advanced");
  await page.getByRole("radio", { name: "2 looks" }).check();
  await page.getByRole("radio", { name: "Ghost" }).check();
  await unfold(page, "Look");
  await page.getByLabel("Point size").fill("2");
  await page.getByLabel("Field of view", { exact: true }).fill("30");
  await drag(page, 90, 40);
  await drag(page, 80, -50, "right");
  const query = await written(page);
  expect(query).toMatch(/^\?sample=dragon_res4&/);
  for (const part of ["looks=2", "hidden=dimmed", "size=2", "fov=30", "view=", "target="]) {
    expect(query).toContain(part);
  }
  const before = same(await upToDate(page));
  const again = await openReady(query);
  expect(same(await upToDate(again))).toEqual(before);
  expect(await again.getByLabel("Point size").inputValue()).toBe("2");
  expect(await again.getByLabel("Field of view", { exact: true }).inputValue()).toBe("30");
  expect(await again.getByRole("radio", { name: "Ghost" }).isChecked()).toBe(true);
  expect(await written(again)).toBe(query);
});

test("the address also restores the length of the radius, the frozen viewpoint and the up axis", async () => {
  const page = await openReady("?sample=bunny&radius=40");
  await unfold(page, "Look");
  await page.locator("#up-axis").getByRole("radio", { name: "Z", exact: true }).check();
  await page.locator("#view").press("v");
  await drag(page, 120, 0);
  const query = await written(page);
  for (const part of ["radius=40", "up=z", "freeze=", "view="]) {
    expect(query).toContain(part);
  }
  const again = await openReady(query);
  expect(same(await upToDate(again))).toEqual(same(await upToDate(page)));
  expect(await again.locator("#walk").getAttribute("aria-pressed")).toBe("true");
  expect(await again.locator("#up-axis").getByRole("radio", { name: "Z", exact: true }).isChecked()).toBe(true);
});

test("at the first view and with the usual settings the address is empty", async () => {
  const page = await openReady("?sample=dragon_res4");
  await unfold(page, "Advanced");
  await page.getByLabel("Exponent", { exact: true }).fill("2");
  await drag(page, 50, 0);
  expect(await written(page)).toMatch(/exponent=2.*view=/);
  await page.getByRole("button", { name: "Automatic" }).click();
  await page.getByRole("button", { name: "Reset view" }).click();
  expect(await written(page)).toBe("?sample=dragon_res4");
});

test("the settings of one cloud do not go to the next", async () => {
  const page = await openReady("?sample=bunny&view=1,8,-12&freeze=1,8,-12&size=2&radius=40&hidden=shown");
  await upToDate(page);
  await page.locator("#sample").selectOption("dragon_res4");
  await page.locator('#status[data-total="5205"]').waitFor();
  const query = await written(page);
  expect(new URLSearchParams(query).get("hidden")).toBe("shown");
  for (const gone of ["view", "freeze", "size", "radius"]) expect(query).not.toContain(`${gone}=`);
});

test("data-busy is 1 from a change until its answer is there", async () => {
  const page = await openReady("?sample=bunny");
  await upToDate(page);
  const busy = await page.evaluate(() => {
    document.querySelector<HTMLElement>('#looks [value="2"]')!.click();
    return document.getElementById("status")!.dataset["busy"];
  });
  expect(busy).toBe("1");
  expect((await upToDate(page)).inversion).toMatch(/^looks:[^,]+,[^,]+$/);
});

const tool = (page: Page, name: string) => page.locator("#tool-bar").getByRole("button", { name });

/** All marks. */
async function marks(page: Page) {
  return {
    measures: await page.locator("#marks .measure text").allTextContents(),
    labels: await page.locator("#label-list li span").allTextContents(),
    stations: await page.locator("#stations-card .list span").allTextContents(),
  };
}

/** Clicks at places around the middle of the picture. */
async function click(page: Page, ...places: [number, number][]): Promise<void> {
  const box = (await page.locator("#view").boundingBox())!;
  for (const [x, y] of places) await page.mouse.click(box.x + box.width / 2 + x, box.y + box.height / 2 + y);
}

test("a link has the distances, labels and stations, and opens with them", async () => {
  const page = await openReady("?sample=bunny&size=1.4");
  await tool(page, "Measure").click();
  await click(page, [-40, 0], [40, 10]);
  await page.locator("#marks .measure").waitFor({ state: "attached" });
  await tool(page, "Label").click();
  await click(page, [0, 20]);
  await page.locator("#label-text").fill("Ear, left & “<b>”");
  await page.locator("#label-text").press("Enter");
  await tool(page, "Stations").click();
  await page.getByRole("button", { name: "At the camera" }).click();
  await page.locator("#stations-unseen[data-count]").waitFor({ state: "attached" });
  const before = await marks(page);
  expect(before).toEqual({
    measures: [expect.stringContaining("units")],
    labels: ["Ear, left & “<b>”"],
    stations: ["S1"],
  });
  const query = await addressWritten(page);
  expect([...query.keys()]).toEqual(["sample", "size", "measure", "label", "station"]);

  const again = await openReady(`?${query.toString()}`);
  await expect.poll(() => marks(again)).toEqual(before);
  expect((await addressWritten(again)).toString()).toBe(query.toString());
  expect(await again.locator("#message").isVisible()).toBe(false);

  // What is removed is no longer in the address.
  await tool(page, "Measure").click();
  await page.locator("#measure-clear").click();
  expect([...(await addressWritten(page)).keys()]).toEqual(["sample", "size", "label", "station"]);
  // Marks do not go to the next cloud.
  await page.locator("#sample").selectOption("dragon_res4");
  await page.locator('#status[data-total="5205"]').waitFor();
  expect([...(await addressWritten(page)).keys()]).toEqual(["sample"]);
});

test("the code for another page shows the present view: the package and the element have the same answer", async () => {
  const page = await openReady("?sample=bunny&view=1,8,-12&target=0,5,0&fov=30&size=1.4&exponent=2", {
    permissions: ["clipboard-read", "clipboard-write"],
  });
  const { visible, viewpoint } = await upToDate(page);
  await tool(page, "Export").click();
  await page.locator("#export-card .use").click();
  const copied = async (name: string) => {
    await page.getByRole("button", { name: `Copy ${name}` }).click();
    await page.locator("#use output", { hasText: "Copied." }).waitFor();
    return page.evaluate(() => navigator.clipboard.readText());
  };
  const [, from, options] = /visibleFrom\((\[.*?\]), \{ (.*) \}\);$/.exec(await copied("npm package"))!;
  expect(JSON.parse(from!)).toEqual(viewpoint);
  expect(options).toBe("exponent: 2");
  const three = await copied("three.js");
  expect(three).toContain(`camera.position.set(${viewpoint.join(", ")});\ncamera.lookAt(0, 5, 0);`);
  expect(three).toContain("new HiddenPointFilter(points, { exponent: 2 });");
  const code = await copied("HTML element");
  const [script, element] = code.split("\n");
  expect(script).toBe(`<script type="module" src="${site.address}hidden-point-cloud.js"></script>`);
  served.set("other.html", new TextEncoder().encode(`<!doctype html><link rel="icon" href="data:," />${code}`));
  await page.goto(`${site.address}other.html`);
  const shown = await page.evaluate(async () => {
    const found = document.querySelector("hidden-point-cloud") as HTMLElement & {
      ready: Promise<void>;
      visibleCount: number;
      viewpoint: number[];
    };
    await customElements.whenDefined("hidden-point-cloud");
    await found.ready;
    return { visible: found.visibleCount, viewpoint: found.viewpoint };
  });
  expect(shown, element).toEqual({ visible, viewpoint });
});

test("on a phone with the tools open, the address opens exactly the same picture", async () => {
  const page = await openReady("?sample=bunny&measure=5,1000", PHONE);
  await drag(page, 40, 30);
  const end = (opened: Page) =>
    opened
      .locator("#marks .measure .dot")
      .first()
      .evaluate((dot) => {
        const { x, y } = dot.getBoundingClientRect();
        return [x, y].map(Math.round);
      });
  const query = await addressWritten(page);
  const again = await openReady(`?${query.toString()}`, PHONE);
  await again.locator("#marks .measure .dot").first().waitFor({ state: "attached" });
  await expect.poll(() => end(again)).toEqual(await end(page));
});

test("marks that do not suit the cloud are left out, and a sentence says so", async () => {
  const page = await openReady("?sample=bunny&measure=1,2&measure=1,9999&label=5,Nose&label=x,Y&station=1,2,North");
  await expect.poll(() => page.locator("#message p").textContent()).toMatch(/^Some marks or stations in the address/);
  expect(await marks(page)).toMatchObject({ measures: [expect.any(String)], labels: ["Nose"], stations: [] });
  expect((await addressWritten(page)).toString()).toBe("sample=bunny&measure=1%2C2&label=5%2CNose");
});

test("the marks of a file that cannot be opened do not go to the sample that replaces it", async () => {
  served.set("clouds/empty.xyz", new Uint8Array());
  const page = await openPage("?src=clouds/empty.xyz&measure=1,2");
  await page.locator("#tools:not([inert])").waitFor();
  await upToDate(page);
  expect((await marks(page)).measures).toEqual([]);
});
