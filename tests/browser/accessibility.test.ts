import { expect, test } from "vitest";
import { audit, JUDGED, VISITS } from "./accessibility.js";
import { openReady } from "./support.js";

test.for(VISITS)(
  "axe-core finds nothing wrong in either theme, and every text has enough contrast ($name)",
  async ({ query, options, steps }) => {
    const page = await openReady(query, options);
    for (const { name, act } of steps) {
      await act(page);
      for (const { theme, result, poor } of await audit(page)) {
        const where = `${name}, ${theme}`;
        const { violations, incomplete, passes } = result;
        expect(passes.length, where).toBeGreaterThan(theme === "dark" ? 10 : 0);
        const found = violations.flatMap(({ id, nodes }) =>
          nodes.map(({ target, failureSummary }) => `${id}: ${target.join(" ")}: ${failureSummary}`),
        );
        expect(found, where).toEqual([]);
        expect(poor, where).toEqual([]);
        const open = incomplete
          .filter(({ id }) => !(id in JUDGED))
          .map(({ id, nodes }) => `${id}: ${nodes.map(({ target }) => target.join(" ")).join(", ")}`);
        expect(open, where).toEqual([]);
      }
    }
  },
);
