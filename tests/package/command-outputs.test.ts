// Outputs that are inputs, or each other; and names that would command a terminal.
import { spawnSync } from "node:child_process";
import { linkSync, lstatSync, mkdirSync, readdirSync, statSync, symlinkSync } from "node:fs";
import { beforeEach, describe, expect, it } from "vitest";

import { COMMAND, commandIn } from "./command-support";

const { run, write, lines, place } = commandIn("command-outputs");
const POINTS = "0 0 1\n0 0 2\n";
const ONE = ["0 0 2"];
const FROM = ["--from", "0,0,5"];
/** The part of the message that all refusals share. */
const SAME = /^hidden-point-removal: .* same file/;

beforeEach(() => {
  write("in.xyz", POINTS);
});

function link(kind: typeof linkSync | typeof symlinkSync, to: string, name: string): void {
  kind(kind === linkSync ? place(to) : to, place(name));
}

async function refused(...args: string[]): Promise<string> {
  const { stderr, status } = await run(...args);
  expect([status, stderr]).toEqual([2, expect.stringMatching(SAME)]);
  return stderr;
}

describe("an output that is an input", () => {
  it("is refused, by whatever name", async () => {
    mkdirSync(place("folder"));
    link(linkSync, "in.xyz", "hard.xyz");
    link(symlinkSync, "in.xyz", "soft.xyz");
    link(symlinkSync, "soft.xyz", "soft-twice.xyz");
    link(symlinkSync, "..", "folder/up");
    for (const output of ["in.xyz", "./in.xyz", "hard.xyz", "soft.xyz", "soft-twice.xyz", "folder/up/in.xyz"]) {
      expect(await refused("in.xyz", ...FROM, "-o", output)).toContain(
        `${output} is the same file as the input in.xyz`,
      );
    }
    expect(await refused("soft.xyz", ...FROM, "-o", "in.xyz")).toContain("the input soft.xyz");
    expect(lines("in.xyz")).toEqual(POINTS.trim().split("\n"));
  });

  it("is replaced with --overwrite. A link stays, and the file stays as private as it was", async () => {
    const { mode } = statSync(place("in.xyz"));
    link(symlinkSync, "in.xyz", "link.xyz");
    const { stderr, status } = await run("link.xyz", ...FROM, "-o", "link.xyz", "--overwrite");
    expect(status, stderr).toBe(0);
    expect(lstatSync(place("link.xyz")).isSymbolicLink()).toBe(true);
    expect([lines("in.xyz"), statSync(place("in.xyz")).mode]).toEqual([ONE, mode]);
  });

  it("is refused for the files of viewpoints and cameras, too", async () => {
    write("places.csv", "0,0,5\n");
    write("each.csv", "name,x,y,z\neach,0,0,5\n");
    await refused("in.xyz", "--viewpoints", "places.csv", "-o", "places.csv");
    await refused("in.xyz", "--viewpoints", "each.csv", "-o", "{name}.csv");
    const cameraToWorld = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -5, 1];
    const camera = { cameraToWorld, fx: 9, fy: 9, cx: 9, cy: 9, width: 20, height: 20 };
    write("camera.csv", JSON.stringify(camera));
    await refused("in.xyz", "--cameras", "camera.csv", "-o", "camera.csv");
    expect([lines("places.csv"), lines("each.csv").length]).toEqual([["0,0,5"], 2]);
    expect((await run("in.xyz", "--viewpoints", "places.csv", "-o", "places.csv", "--overwrite")).status).toBe(0);
    expect(lines("places.csv")).toEqual(ONE);
  });

  it.runIf(process.platform !== "win32")("is refused as standard output, by either name", () => {
    link(symlinkSync, "/dev/stdout", "out.xyz");
    for (const output of ["-", "out.xyz"]) {
      const line = `"${process.execPath}" "${COMMAND}" in.xyz --from 0,0,5 -o ${output} >> in.xyz`;
      const { stderr, status } = spawnSync("sh", ["-c", line], { cwd: place(".") });
      expect([status, stderr.toString()]).toEqual([2, expect.stringMatching(SAME)]);
    }
    expect(lines("in.xyz")).toHaveLength(2);
    // Another file is written where its writing stands.
    const line = `(echo 9 9 9; "${process.execPath}" "${COMMAND}" in.xyz --from 0,0,5 -o out.xyz; echo 7 7 7) > all.txt`;
    spawnSync("sh", ["-c", line], { cwd: place(".") });
    expect(lines("all.txt")).toEqual(["9 9 9", ...ONE, "7 7 7"]);
    expect(lstatSync(place("out.xyz")).isSymbolicLink()).toBe(true);
  });
});

describe("several outputs", () => {
  const each = (names: readonly string[]) => {
    write("each.csv", `name,x,y,z\n${names.map((name) => `"${name}",0,0,5\n`).join("")}`);
  };

  it("that are one file are refused before anything is written", async () => {
    each(["a", "b", "c"]);
    write("seen-b.xyz", "old\n");
    link(symlinkSync, "seen-b.xyz", "seen-c.xyz");
    for (const more of [[], ["--overwrite"]]) {
      const said = await refused("in.xyz", "--viewpoints", "each.csv", "-o", "seen-{name}.xyz", ...more);
      expect(said).toContain("seen-c.xyz and seen-b.xyz are the same file");
    }
    link(symlinkSync, "not-yet.xyz", "new-a.xyz");
    link(symlinkSync, "./not-yet.xyz", "new-b.xyz");
    await refused("in.xyz", "--viewpoints", "each.csv", "-o", "new-{name}.xyz");
    expect(lines("seen-b.xyz")).toEqual(["old"]);
    expect(readdirSync(place(".")).filter((name) => /seen-a|not-yet/.test(name))).toEqual([]);
  });

  it.each([
    [["Hall", "hall"], /line 3 has a name a second time/],
    [["\u00e9", "e\u0301"], /line 3 has a name a second time/],
    [["..", "a"], /line 2 has a name that no file can have/],
    [["a", "c:d"], /line 3 has a name that no file can have/],
    [["a", "bell\u0007"], /line 3 has a name that no file can have/],
  ])("with the names %j are refused", async (names, says) => {
    each(names);
    const { stderr, status } = await run("in.xyz", "--viewpoints", "each.csv", "-o", "file-{name}.xyz");
    expect([status, stderr]).toEqual([1, expect.stringMatching(says)]);
    expect(readdirSync(place(".")).filter((name) => name.startsWith("file-"))).toEqual([]);
  });
});

describe("words of files and arguments", () => {
  const EVIL = "\u001b[2J\u009b31m\u202egnp\u2028\u0007\r";
  it("are one line of text on the terminal", async () => {
    write("odd.csv", `name,x,y,z\n"a${EVIL}",0,0,1e9\n`);
    write(`odd${EVIL}.xyz`, "0 0 1\n0 0\n");
    write("odd.json", `{"${EVIL}"`);
    write("odd.pts", `x y ${EVIL}z\n0 0 1\n`);
    write("odd.ply", `ply\nformat ascii 1.0\nelement vertex 1\nproperty ${EVIL} x\nend_header\n1\n`);
    const cases = [
      ["in.xyz", "--viewpoints", "odd.csv", "-o", "out.idx"],
      [`odd${EVIL}.xyz`, ...FROM, "-o", "out.idx"],
      [`missing${EVIL}.xyz`, ...FROM, "-o", "out.idx"],
      ["in.xyz", "--cameras", "odd.json", "-o", "out.xyz"],
      ["odd.pts", ...FROM, "-o", "out.idx"],
      ["odd.ply", ...FROM, "-o", "out.idx"],
      ["in.xyz", "--from", EVIL, "-o", "out.idx"],
      ["in.xyz", ...FROM, "-o", `folder${EVIL}/out.idx`],
      ["in.xyz", ...FROM, "-o", "out.idx", `--${EVIL}`],
      ["in.xyz", EVIL, ...FROM, "-o", "out.idx"],
    ];
    for (const args of cases) {
      const { stderr } = await run(...args);
      expect(stderr, JSON.stringify(args)).toMatch(/^([^\p{Cc}\p{Zl}\p{Zp}\p{Bidi_Control}]+\n)+$/u);
    }
  });
});
