/*
 * Looks at every frame while the camera moves, as a stranger would: is there a shadow of an old viewpoint in it? For
 * larger clouds: HPR_STALE_POINTS=3000000 npx vitest run tests/browser/stale.test.ts
 */
import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { fourBalls } from "./balls.js";
import { addStyle, hideControls } from "./site.js";
import { openReady, served, upToDate } from "./support.js";

const POINTS = Number(process.env["HPR_STALE_POINTS"] ?? 100_000);
/** Each press of an arrow key turns the camera by 5°. */
const PRESSES = 5;
const SIZE = { width: 300, height: 260 };

interface Frame {
  /** How many keys had been pressed. */
  step: number;
  /** Whether an answer is still to come, and whether the sign in the picture says so. */
  isBusy: boolean;
  isMarked: boolean;
  answer: string;
  /** Pixels that are empty although the final picture of this place and all pixels around are not, and all covered ones. */
  holes: number;
  covered: number;
  /** Pixels that differ clearly from the final picture of this place. */
  different: number;
}

/** Keeps every frame that is drawn, with the number of keys pressed so far. */
async function record(page: Page): Promise<void> {
  await page.evaluate(() => {
    const canvas = document.querySelector<HTMLCanvasElement>("#view")!;
    const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d", { willReadFrequently: true })!;
    const frames: unknown[] = [];
    const record = { frames, step: 0, isOn: true, final: [] as Uint8ClampedArray[] };
    canvas.addEventListener("keydown", () => record.step++, { capture: true });
    // The page's own callback runs first. A picture can be read until the end of the frame in which it was drawn.
    const frame = () => {
      const { dataset } = document.getElementById("status")!;
      copy.drawImage(canvas, 0, 0);
      const pixels = copy.getImageData(0, 0, canvas.width, canvas.height).data;
      // Otherwise nothing was drawn in this frame.
      if (pixels[3] === 255) {
        const isMarked = !document.getElementById("sign-work")!.hidden;
        const { step } = record;
        frames.push({ step, isBusy: dataset["busy"] === "1", isMarked, answer: dataset["answer"], pixels });
      }
      if (record.isOn) requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
    Object.assign(window, { record });
  });
}

/** Keeps the final picture of a place. */
async function keepFinal(page: Page, step: number, image: Buffer): Promise<void> {
  await page.evaluate(
    async ([at, data]) => {
      const bitmap = await createImageBitmap(await (await fetch(`data:image/png;base64,${data}`)).blob());
      const copy = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d")!;
      copy.drawImage(bitmap, 0, 0);
      const { final } = (window as unknown as { record: { final: Uint8ClampedArray[] } }).record;
      final[at] = copy.getImageData(0, 0, bitmap.width, bitmap.height).data;
    },
    [step, image.toString("base64")] as const,
  );
}

/** Compares the frames with the final picture of the same place. */
async function compared(page: Page): Promise<Frame[]> {
  return page.evaluate(() => {
    type Raw = Omit<Frame, "holes" | "covered" | "different"> & { pixels: Uint8ClampedArray };
    const { frames, final } = (window as unknown as { record: { frames: Raw[]; final: Uint8ClampedArray[] } }).record;
    const { width } = document.querySelector<HTMLCanvasElement>("#view")!;
    // Plain loops: there are millions of pixels.
    const emptyOnes = (pixels: Uint8ClampedArray) => {
      const found = new Uint8Array(pixels.length / 4);
      for (let i = 0, at = 0; i < found.length; i++, at += 4) {
        const far = Math.abs(pixels[at]! - 20) + Math.abs(pixels[at + 1]! - 22) + Math.abs(pixels[at + 2]! - 26);
        if (far < 6) found[i] = 1;
      }
      return found;
    };
    const finals = final.map((pixels) => ({ pixels, empty: emptyOnes(pixels) }));
    const from = (pixels: Uint8ClampedArray, empty: Uint8Array, step: number) => {
      const last = finals[step]!;
      let [holes, covered, different] = [0, 0, 0];
      for (let i = width + 1; i < empty.length - width - 1; i++) {
        let far = 0;
        for (let at = 4 * i; at < 4 * i + 3; at++) far += Math.abs(pixels[at]! - last.pixels[at]!);
        if (far > 60) different++;
        if (last.empty[i] || last.empty[i - 1] || last.empty[i + 1]) continue;
        if (last.empty[i - width] || last.empty[i + width]) continue;
        covered++;
        if (empty[i]) holes++;
      }
      return { holes, covered, different };
    };
    return frames.map(({ pixels, ...said }) => {
      const empty = emptyOnes(pixels);
      const [here, before] = [said.step, Math.max(0, said.step - 1)].map((step) => from(pixels, empty, step));
      // The frame in which a key arrives may still show the place before it.
      return { ...said, ...(before!.different < here!.different ? before! : here!) };
    });
  });
}

test(
  `no frame of an orbit around ${POINTS.toLocaleString("en-US")} points is stale`,
  { timeout: 900_000 },
  async () => {
    served.set("clouds/four-balls.ply", fourBalls(POINTS));
    const query = "?src=clouds/four-balls.ply&up=y&view=0,1,8.5&theme=dark&color=plain&size=2";
    const page = await openReady(query, { viewport: SIZE, deviceScaleFactor: 1 }, hideControls);
    // Software drawing of millions of points takes long.
    page.setDefaultTimeout(300_000);
    await addStyle(page, "#view { outline: none !important }");
    await record(page);
    for (let i = 0; i < PRESSES; i++) {
      await page.locator("#view").press("ArrowLeft");
      // Some steps follow at once, and others when a draft may be there.
      await page.waitForTimeout(i % 2 === 0 ? 30 : 400);
    }
    await upToDate(page);
    await page.waitForTimeout(300);
    // Now back, with the final picture of each place.
    await page.evaluate(() => {
      (window as unknown as { record: { isOn: boolean } }).record.isOn = false;
    });
    for (let step = PRESSES; step >= 0; step--) {
      await upToDate(page);
      await page.waitForTimeout(300);
      await keepFinal(page, step, await page.locator("#view").screenshot());
      if (step > 0) await page.locator("#view").press("ArrowRight");
    }
    const frames = await compared(page);
    const pending = frames.filter(({ isBusy }) => isBusy);
    console.table(
      [...new Set(frames.map(({ step }) => step))].map((step) => {
        const here = frames.filter((frame) => frame.step === step);
        const share = (count: number, of: number) => `${((100 * count) / of).toFixed(2)} %`;
        return {
          step,
          frames: here.length,
          pending: here.filter(({ isBusy }) => isBusy).length,
          "most holes": share(Math.max(...here.map(({ holes }) => holes)), here[0]!.covered),
          "most different": share(Math.max(...here.map(({ different }) => different)), here[0]!.covered),
        };
      }),
    );
    expect(frames.length).toBeGreaterThan(PRESSES);
    expect(pending.length).toBeGreaterThan(0);
    for (const { step, isBusy, isMarked, answer, holes, covered, different } of frames) {
      // A pending picture says so, unless a map draws it, and shows everything that can be seen from here.
      if (answer !== "map") expect(isMarked, `step ${step}`).toBe(isBusy);
      expect(holes / covered, `step ${step}`).toBeLessThan(0.005);
      // A picture that does not say so is the final one.
      if (!isBusy) expect(different / covered, `step ${step}`).toBeLessThan(0.005);
    }
  },
);
