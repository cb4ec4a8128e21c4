// Runs before each file of tests. All files of a worker share one browser and one server, which take long to start.
import { afterAll, afterEach } from "vitest";
import { browser } from "./browser.js";
import { closePages, served, site } from "./support.js";

afterEach(closePages);

afterAll(async () => {
  await Promise.all(browser.contexts().map((context) => context.close()));
  served.clear();
  site.asked.length = 0;
});
