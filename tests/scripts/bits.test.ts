// How `npm run bits` reads and compares what the platforms print.
import { expect, it } from "vitest";

import { answersIn, firstDifference } from "../../scripts/bits/corpus.js";

const one = "ball/12 0123456789abcdef 9 400599999999999a";
const two = "ball/merge fedcba9876543210 7 -";
const all = "all 00000000000000ff 2 -";

function answers(...lines: string[]) {
  const read = answersIn(`a warning\n${lines.join("\n")}\n`);
  if (read === undefined) throw new Error("not read");
  return read;
}

it("reads every case and the digest of all", () => {
  const { cases, all: digest } = answers(one, two, all);
  expect([...cases.keys()]).toEqual(["ball/12", "ball/merge"]);
  expect(digest).toBe("00000000000000ff");
});

it.each([
  ["nothing was printed", []],
  ["the program ended early", [one, two]],
  ["a line was lost", [one, all]],
  ["a name came twice", [one, one, all]],
])("reads nothing where %s", (_, lines) => {
  expect(answersIn(lines.join("\n"))).toBeUndefined();
});

it.each([
  ["nothing is different", [one, two, all], undefined],
  ["a radius is different", [one.replace("9a", "9b"), two, all], "ball/12"],
  ["a case has another name", [one, two.replace("merge", "walk"), all], "ball/merge"],
  ["only the digest of all is different", [one, two, all.replace("ff", "fe")], "all"],
])("names the first difference where %s", (_, lines, name) => {
  expect(firstDifference(answers(one, two, all), answers(...lines))).toBe(name);
});

it("finds a case that only the second platform has", () => {
  const three = "room/12 0000000000000001 5 -";
  const more = answers(one, two, three, all.replace(" 2 ", " 3 "));
  expect(firstDifference(answers(one, two, all), more)).toBe("room/12");
});
