import { expect, test } from "vitest";
import { asciiPly, ball } from "./clouds.js";
import { openReady, reached, site } from "./support.js";

/** The sections of the panel that are open. */
async function open(page: Awaited<ReturnType<typeof openReady>>): Promise<string[]> {
  return page
    .locator("#sheet details[open]")
    .evaluateAll((sections) => sections.map(({ firstElementChild }) => firstElementChild!.textContent));
}

test("the panel has a file, samples and hidden points; all other settings are folded", async () => {
  const page = await openReady("?sample=bunny", { viewport: { width: 1440, height: 900 } });
  expect(await open(page)).toEqual([]);
  const seen = await page
    .locator("#panel :is(button, select, input, summary)")
    .evaluateAll((controls) =>
      controls
        .filter((control) => control.checkVisibility())
        .map(
          (control) => control.closest("fieldset, section, details")!.querySelector("h2, legend, summary")!.textContent,
        ),
    );
  expect(new Set(seen)).toEqual(
    new Set(["Hidden points", "Cloud", "Part of the cloud", "Information", "Look", "Advanced"]),
  );
});

test("an address opens the sections that have its settings", async () => {
  const page = await openReady("?sample=bunny&hidden=dimmed");
  expect(await open(page)).toEqual([]);
  for (const [query, sections] of [
    ["radius=40", ["Advanced"]],
    ["exponent=2", ["Advanced"]],
    ["looks=2", ["Advanced"]],
    ["color=height", ["Look"]],
  ] as const) {
    await page.goto(`${site.address}?sample=bunny&${query}`);
    await reached(page, "ready");
    expect(await open(page), query).toEqual(sections);
  }
});

test("an own file is named above the samples, and is not one of them", async () => {
  const page = await openReady("?sample=bunny");
  await page.locator("#file").setInputFiles({
    name: "mine.ply",
    mimeType: "",
    buffer: Buffer.from(asciiPly(ball(600))),
  });
  await page.locator('#status[data-total="600"]').waitFor();
  expect(await page.locator("#panel .credit").textContent()).toContain("mine.ply");
  const offered = await page
    .locator("#sample option")
    .evaluateAll((options) =>
      options.filter((option) => !(option as HTMLOptionElement).hidden).map(({ textContent }) => textContent),
    );
  expect(offered.join()).not.toContain("mine");
  expect(await page.locator("#sample").inputValue()).toBe("");
});
