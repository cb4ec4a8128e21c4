// Broken files, and valid files that look broken. The command and the page read them alike.
import { describe, expect, it } from "vitest";
import type { Case } from "../files/corpus";
import { pcdCases } from "../files/corpus-pcd";
import { plyCases } from "../files/corpus-ply";
import { tableCases } from "../files/corpus-tables";
import { type Outcome, readAsCommand, readAsPage } from "../files/read";

const CASES = [...plyCases(), ...pcdCases(), ...tableCases()];

function check({ name, expected }: Case, outcome: Outcome): void {
  if (typeof expected !== "string") {
    expect(outcome, name).toEqual({ points: [...expected] });
    return;
  }
  expect(outcome, name).toHaveProperty("refused");
  const { refused } = outcome as { refused: string };
  const said = expected.split("|").some((sentence) => sentence !== "" && refused.includes(sentence));
  expect(said, `${name}: “${refused}” does not say “${expected}”`).toBe(true);
  expect(refused).not.toMatch(/[\u0000-\u001f]/);
}

describe("each broken file is refused in a sentence that names the fault, and no valid file is refused", () => {
  it("there are at least 300 files, and no two have the same name", () => {
    expect(new Set(CASES.map(({ name }) => name)).size).toBe(CASES.length);
    expect(CASES.length).toBeGreaterThanOrEqual(300);
  });

  it.each(CASES.map((each) => [each.name, each] as const))("%s", async (_, each) => {
    check(each, await readAsCommand(each.file, each.content, each.columns));
    // The page has no choice of columns.
    if (each.columns === undefined) check(each, await readAsPage(each.file, each.content));
  });
});
