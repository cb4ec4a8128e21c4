import { mustRun, say } from "../lib/run.js";
import { unlessUnchanged } from "../lib/stamp.js";

/** The demo page, in www/dist, to be hosted under any path. */
export async function buildDemo(): Promise<void> {
  const work = {
    name: "demo",
    inputs: ["www", "dist", "package.json", "package-lock.json"],
    ignore: ["www/dist", "www/public/samples"],
    outputs: ["www/dist/index.html"],
  };
  const result = await unlessUnchanged(work, async () => {
    say("Building the demo page…");
    await mustRun("vite", ["build", "www", "--configLoader", "runner", "--logLevel", "warn"], "The demo page could not be built");
  });
  say(`Demo page: ${result}`);
}
