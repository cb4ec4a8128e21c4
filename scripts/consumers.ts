// npm run consumers: tests the packed package in every bundler, framework, page and runtime, and writes
// tests/consumers/MATRIX.md. npm installs the tools of most of them. `npm test` runs only those that need nothing more.
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
