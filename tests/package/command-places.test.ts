// The command with pipes, devices and links as input and output, and its end when it is stopped.
import { spawn, spawnSync } from "node:child_process";
import { once } from "node:events";
import {
  closeSync,
  constants,
  existsSync,
  lstatSync,
  mkdirSync,
  openSync,
  readdirSync,
  readFileSync,
  readlinkSync,
  statSync,
  symlinkSync,
} from "node:fs";
import { setTimeout as wait } from "node:timers/promises";
import { describe, expect, it } from "vitest";

import { COMMAND, commandIn } from "./command-support";

const { place, run, write } = commandIn("command-places");
const scratch = place("");

write("in.xyz", "0 0 1\n0 0 2\n");

const toFile = (output: string, input = "in.xyz") => run(input, "--from", "0,0,5", "-o", output);
const made = (command: string, ...args: string[]) => spawnSync(command, args, { cwd: scratch }).status === 0;
const leftovers = () => readdirSync(scratch).filter((name) => name.endsWith(".part"));
const isUnix = process.platform !== "win32";

describe.runIf(isUnix)("a path that is not a regular file", () => {
  it("a FIFO is not read, and the command does not wait for it", async () => {
    expect(made("mkfifo", "pipe-in.xyz")).toBe(true);
    const { stderr, status } = await toFile("out.xyz", "pipe-in.xyz");
    expect([status, stderr]).toEqual([
      1,
      "hidden-point-removal: pipe-in.xyz cannot be read: it is not a regular file\n",
    ]);
  });

  it("a FIFO that a program reads is written to, and stays", async () => {
    expect(made("mkfifo", "pipe.xyz")).toBe(true);
    // It is open before the command asks whether a program reads.
    const reader = openSync(place("pipe.xyz"), constants.O_RDONLY | constants.O_NONBLOCK);
    const { stderr, status } = await toFile("pipe.xyz");
    expect(status, stderr).toBe(0);
    expect(readFileSync(reader, "utf8")).toBe("0 0 2\n");
    closeSync(reader);
    expect(lstatSync(place("pipe.xyz")).isFIFO()).toBe(true);
  });

  it("a FIFO that nobody reads is refused, and stays", async () => {
    expect(made("mkfifo", "lonely.xyz")).toBe(true);
    const { stderr, status } = await toFile("lonely.xyz");
    expect([status, stderr]).toEqual([
      1,
      "hidden-point-removal: lonely.xyz cannot be written: it is a FIFO that no program reads\n",
    ]);
    expect(lstatSync(place("lonely.xyz")).isFIFO()).toBe(true);
  });

  it("a device is written to, and stays", async ({ skip }) => {
    // A second null device. Only root may make it, and not on every system.
    if (!made("mknod", "null.xyz", "c", "1", "3")) skip();
    try {
      closeSync(openSync(place("null.xyz"), "r+"));
    } catch {
      skip();
    }
    symlinkSync("null.xyz", place("link-to-null.xyz"));
    for (const name of ["null.xyz", "link-to-null.xyz"]) {
      const { stderr, status } = await toFile(name);
      expect(status, stderr).toBe(0);
      expect(statSync(place(name)).isCharacterDevice()).toBe(true);
    }
    expect(lstatSync(place("link-to-null.xyz")).isSymbolicLink()).toBe(true);
    expect((await toFile("out.xyz", "null.xyz")).stderr).toMatch(/null\.xyz cannot be read: it is not a regular file/);
  });

  it("a link to standard output is followed", () => {
    symlinkSync("/dev/stdout", place("stdout.xyz"));
    const line = `"${process.execPath}" "${COMMAND}" in.xyz --from 0,0,5 -o stdout.xyz | cat`;
    expect(spawnSync("sh", ["-c", line], { cwd: scratch }).stdout.toString()).toBe("0 0 2\n");
    expect(readlinkSync(place("stdout.xyz"))).toBe("/dev/stdout");
  });

  it("a disk is not written to", async ({ skip }) => {
    // No disk has this number, so opening it would fail.
    if (!made("mknod", "disk.xyz", "b", "240", "250")) skip();
    expect((await toFile("disk.xyz")).stderr).toBe("hidden-point-removal: disk.xyz cannot be written: it is a disk\n");
    expect(lstatSync(place("disk.xyz")).isBlockDevice()).toBe(true);
  });

  it("a link to a missing file makes that file", async () => {
    mkdirSync(place("folder"));
    symlinkSync("folder/new.xyz", place("dangling.xyz"));
    symlinkSync("dangling.xyz", place("twice.xyz"));
    expect((await toFile("twice.xyz")).status).toBe(0);
    expect(readlinkSync(place("dangling.xyz"))).toBe("folder/new.xyz");
    expect(readlinkSync(place("twice.xyz"))).toBe("dangling.xyz");
    expect(readFileSync(place("folder/new.xyz"), "utf8")).toBe("0 0 2\n");
  });

  it("links that lead nowhere are refused, and stay", async () => {
    symlinkSync("round.xyz", place("round.xyz"));
    symlinkSync("missing/new.xyz", place("astray.xyz"));
    expect((await toFile("round.xyz")).stderr).toMatch(/round\.xyz cannot be written: its links lead to one another/);
    expect((await toFile("astray.xyz")).stderr).toBe(
      "hidden-point-removal: astray.xyz cannot be written: no such file or directory\n",
    );
    for (const name of ["round.xyz", "astray.xyz"]) {
      expect(lstatSync(place(name)).isSymbolicLink(), name).toBe(true);
    }
    expect(leftovers()).toEqual([]);
  });

  it("a directory is refused with a message that says so", async () => {
    mkdirSync(place("directory.xyz"));
    expect((await toFile("directory.xyz")).stderr).toBe(
      "hidden-point-removal: directory.xyz cannot be written: it is a directory\n",
    );
  });
});

it.runIf(isUnix).each(["SIGINT", "SIGTERM", "SIGHUP"] as const)(
  "a command that is stopped by %s leaves nothing behind",
  async (signal) => {
    // The unfinished file exists for some milliseconds only, so this command never ends writing.
    const waits = `import fs from "node:fs/promises";
    import { syncBuiltinESMExports } from "node:module";
    const { open } = fs;
    fs.open = async (name, ...given) => {
      const handle = await open(name, ...given);
      if (name.endsWith(".part")) handle.writeFile = () => new Promise(() => setInterval(() => undefined, 1000));
      return handle;
    };
    syncBuiltinESMExports();`;
    const preload = ["--import", `data:text/javascript,${encodeURIComponent(waits)}`];
    const child = spawn(process.execPath, [...preload, COMMAND, "in.xyz", "--from", "0,0,5", "-o", "stopped.xyz"], {
      cwd: scratch,
      stdio: "ignore",
    });
    const ended = once(child, "exit");
    while (leftovers().length === 0 && child.exitCode === null) await wait(1);
    expect(leftovers()).toHaveLength(1);
    child.kill(signal);
    await ended;
    expect([child.signalCode, leftovers(), existsSync(place("stopped.xyz"))]).toEqual([signal, [], false]);
  },
);

describe("--columns", () => {
  const header = "ply\nformat ascii 1.0\nelement vertex 2\n";
  const properties = ["a", "b", "c", "d"].map((name) => `property float ${name}\n`).join("");
  const FILES: [name: string, content: string][] = [
    ["columns.ply", `${header}${properties}end_header\n7 0 0 1\n7 0 0 2\n`],
    ["columns.pcd", "FIELDS a b c d\nSIZE 4 4 4 4\nTYPE F F F F\nWIDTH 2\nHEIGHT 1\nDATA ascii\n7 0 0 1\n7 0 0 2\n"],
    ["columns.csv", "a,b,c,d\n7,0,0,1\n7,0,0,2\n"],
  ];

  it.each(FILES)("chooses x, y and z in %s by names and by numbers, and says so", async (name, content) => {
    write(name, content);
    for (const columns of ["b,c,d", "2,3,4", "B,C,4"]) {
      const { stderr, status } = await run(name, "--from", "0,0,5", "-o", `out-${name}`, "--columns", columns);
      expect([status, stderr]).toEqual([
        0,
        name.endsWith(".csv")
          ? `1 of 2 points are visible; x, y and z are columns 2, 3, 4${columns.startsWith("2") ? "" : " (b, c, d)"}\n`
          : "1 of 2 points are visible; x, y and z are b, c, d\n",
      ]);
      expect(readFileSync(place(`out-${name}`), "utf8")).toMatch(/7[ ,]0[ ,]0[ ,]2\n$/);
    }
    const { stderr, status } = await run(name, "--from", "0,0,5", "-o", `out-${name}`, "--columns", "b,c,w");
    expect(status).toBe(1);
    expect(stderr).toContain(`${name} cannot be read: it has no column named "w", but "a b c d"`);
    expect((await run(name, "--from", "0,0,5", "-o", `out-${name}`)).status).toBe(1);
  });

  it.each(["1,2", "1,2,3,4", "1,1,2", "0,1,2", "-1,2,3", "a,,b", ""])("is refused as %j", async (columns) => {
    const { stderr, status } = await run("in.xyz", "--from", "0,0,5", "-o", "out.xyz", `--columns=${columns}`);
    expect([status, /--columns needs three different columns/.test(stderr)]).toEqual([2, true]);
  });
});
