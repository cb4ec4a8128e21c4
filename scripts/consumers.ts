// npm run consumers: tests the packed package in every bundler, page and runtime that is installed here.
// `npm test` runs only the most common ones.
import { build } from "./build/build.js";
import { vitest } from "./checks/vitest.js";
import { command } from "./lib/command.js";
import { setUpBrowser } from "./setup/browser.js";
import { setUpForBuild } from "./setup/setup.js";

await command(async () => {
  await setUpForBuild();
  await build();
  const env = { HPR_CHROMIUM: await setUpBrowser(), HPR_CONSUMERS: "all" };
  const { failed } = await vitest("tests/consumers", { env });
  if (failed > 0) process.exitCode = 1;
});
