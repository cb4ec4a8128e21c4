// The public API under arguments of any kind. `fuzzBorder` runs the same test for any time.
import { init } from "hidden-point-removal";
import { init as initLite } from "hidden-point-removal/lite";
import { WorkerPointCloud } from "hidden-point-removal/worker";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { PROPERTIES } from "../fuzz/border.js";

const SEED = 20261122;
let resident: WorkerPointCloud;

beforeAll(async () => {
  await Promise.all([init(), initLite()]);
  // Keeps the shared worker alive between cases.
  resident = await WorkerPointCloud.create([], { shared: true });
});

afterAll(async () => {
  await resident.dispose();
});

describe(`every call is answered correctly or refused as documented, with seed ${SEED}`, () => {
  it.each(PROPERTIES)("$name", async ({ check, pace }) => {
    expect((await check(SEED, Math.ceil(pace / 2))).wrong).toBeUndefined();
  });
});
