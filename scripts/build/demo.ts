import { copyFileSync } from "node:fs";

import { inRoot } from "../lib/paths.js";
import { mustRun, say } from "../lib/run.js";
import { unlessUnchanged } from "../lib/stamp.js";

/** Builds the demo page, and the element for other pages. Both lie in www/dist and can be hosted under any path. */
export async function buildDemo(): Promise<void> {
  const work = {
    name: "demo",
    inputs: ["www", "dist", "package.json", "package-lock.json", "THIRD_PARTY.md", "docs/page.webp"],
    ignore: ["www/dist", "www/public/samples"],
    outputs: ["www/dist/index.html", "www/dist/hidden-point-cloud.js", "www/dist/hidden-point-cloud.d.ts"],
  };
  const result = await unlessUnchanged(work, async () => {
    // The page is built first, because its build empties the folder.
    for (const [what, config] of [
      ["demo page", "www/vite.config.ts"],
      ["element", "www/element/vite.config.ts"],
    ] as const) {
      say(`Building the ${what}…`);
      const options = ["--config", config, "--configLoader", "runner", "--logLevel", "warn"];
      await mustRun("vite", ["build", "www", ...options], `The ${what} could not be built`);
    }
    // The licenses of the bundled code require it.
    copyFileSync(inRoot("THIRD_PARTY.md"), inRoot("www/dist/THIRD_PARTY.md"));
    // The picture that other sites show beside a link to the page.
    copyFileSync(inRoot("docs/page.webp"), inRoot("www/dist/preview.webp"));
  });
  say(`Demo page and element: ${result}`);
}
