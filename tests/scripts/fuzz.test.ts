// How `npm run fuzz` reads its arguments and the output of its fuzzers.
import { expect, it } from "vitest";

import { askedFor } from "../../scripts/fuzz/fuzzers.js";
import { runFuzzer, tallyIn } from "../../scripts/fuzz/fuzzers.js";

it("takes minutes, a seed and one fuzzer", () => {
  const args = ["--minutes", "0.5", "--seed", "7", "--only", "drafts"];
  expect(askedFor(args, ["drafts"])).toEqual({ minutes: 0.5, seed: 7, only: "drafts" });
});

it.each([
  [["--minutes", "0"], /--minutes is 0, which is no number above 0/],
  [["--minutes", "ten"], /--minutes is ten/],
  [["--seed", "1.5"], /--seed is 1.5, which is no whole number/],
  [["--seed", "9007199254740993"], /--seed is 9007199254740993/],
  [["--only", "nothing"], /There is no fuzzer "nothing"\. There are: drafts\./],
  [["--hours", "1"], /hours/],
])("refuses %j", (args, says) => {
  expect(() => askedFor(args, ["drafts"])).toThrow(says);
});

it("reads the last line, or adds up the lines of a fuzzer that prints several", () => {
  expect(tallyIn("seed 1\n12 tried, 0 wrong\n")).toEqual({ tried: 12, wrong: 0 });
  expect(tallyIn("one: 5 cases, 0 wrong\ntwo: 6 cases, 2 wrong\n")).toEqual({ tried: 11, wrong: 2 });
  expect(tallyIn("Killed\n")).toEqual({ tried: 0, wrong: 1 });
});

it.each([
  ["all is right", 'console.log("3 tried, 0 wrong")', { tried: 3, wrong: 0 }],
  ["it crashes after its count", 'console.log("3 tried, 0 wrong"); process.exit(1)', { tried: 3, wrong: 1 }],
  ["it says nothing", "", { tried: 0, wrong: 1 }],
])("counts a fuzzer where %s", async (_, program, tally) => {
  expect(await runFuzzer({ title: "made", command: [process.execPath, "-e", program, "--"] }, 1, 1)).toEqual(tally);
});
