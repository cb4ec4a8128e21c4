import { expect, test } from "vitest";
import { audit, JUDGED, VISITS } from "./accessibility.js";
import { openReady } from "./support.js";

test.for(VISITS)(
  "axe-core finds nothing wrong, and every text has enough contrast in either theme ($name)",
  async ({ query, options, steps }) => {
    const page = await openReady(query, options);
    for (const { name, act } of steps) {
      await act(page);
      const { result, poor } = await audit(page);
      const { violations, incomplete, passes } = result;
      expect(passes.length, name).toBeGreaterThan(10);
      const found = violations.flatMap(({ id, nodes }) =>
        nodes.map(({ target, failureSummary }) => `${id}: ${target.join(" ")}: ${failureSummary}`),
      );
      expect(found, name).toEqual([]);
      expect(poor, name).toEqual({ dark: [], light: [] });
      const open = incomplete
        .filter(({ id }) => !(id in JUDGED))
        .map(({ id, nodes }) => `${id}: ${nodes.map(({ target }) => target.join(" ")).join(", ")}`);
      expect(open, name).toEqual([]);
    }
  },
);
