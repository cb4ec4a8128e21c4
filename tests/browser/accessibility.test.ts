import { expect, test } from "vitest";
import { audit, JUDGED, VISITS } from "./accessibility.js";
import { poorContrast } from "./contrast.js";
import { openReady } from "./support.js";

test.for(VISITS)("axe-core finds nothing wrong, and every text stands out ($name)", async ({ query, options, steps }) => {
  const page = await openReady(query, options);
  for (const { name, act } of steps) {
    await act(page);
    const { violations, incomplete, passes } = await audit(page);
    expect(passes.length, name).toBeGreaterThan(10);
    const found = violations.flatMap(({ id, nodes }) => nodes.map(({ target, failureSummary }) => `${id}: ${target.join(" ")}: ${failureSummary}`));
    expect(found, name).toEqual([]);
    // Where axe-core sees no background: what lies over the cloud.
    expect(await poorContrast(page), name).toEqual([]);
    const open = incomplete.filter(({ id }) => !(id in JUDGED)).map(({ id, nodes }) => `${id}: ${nodes.map(({ target }) => target.join(" ")).join(", ")}`);
    expect(open, name).toEqual([]);
  }
});
