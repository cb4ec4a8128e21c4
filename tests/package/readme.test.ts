// Every snippet of the README is run: the JavaScript ones here, the Rust ones as
// documentation tests of the crate; every command is one of the project's own.
import { spawnSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

import { describe, expect, test } from "vitest";

import { blocks, printed, promised, root, scratchFor } from "./snippets";

const README = "README.md";
const scratch = scratchFor("readme");

describe("JavaScript snippets print what they say", () => {
  test.each(blocks(README, "js").map((code, i) => [i, code] as const))("snippet %i", (i, code) => {
    expect(promised(code).length).toBeGreaterThan(0);
    expect(printed(scratch, i, code)).toEqual(promised(code));
  });
});

describe("commands", () => {
  const commands = blocks(README, "sh")
    .flatMap((block) => block.split("\n"))
    .map((line) => line.replace(/#.*/, "").trim())
    .filter((line) => line !== "");
  const inline = [...readFileSync(join(root, README), "utf8").matchAll(/`(npm [^`]+)`/g)].map(([, text]) => text ?? "");

  test("npm commands are scripts of the project", () => {
    const { scripts } = JSON.parse(readFileSync(join(root, "package.json"), "utf8")) as {
      scripts: Record<string, string>;
    };
    const used = [...commands, ...inline]
      .flatMap((line) => line.split("&&"))
      .map((command) => command.trim())
      .filter((command) => command.startsWith("npm ") && !/^npm (install|pack)$/.test(command));
    expect(used.length).toBeGreaterThan(3);
    for (const command of used) {
      const [, name = ""] = /^npm (?:run )?(\w+)/.exec(command) ?? [];
      expect(scripts, command).toHaveProperty(name);
    }
  });

  test("the Rust example filters a file", { timeout: 180_000 }, () => {
    const command = commands.find((line) => line.startsWith("cargo run"));
    const [, example = "", args = ""] = /--example (\w+) -- (.*) >/.exec(command ?? "") ?? [];
    writeFileSync(join(scratch, "cloud.xyz"), "0 0 1 a\n0 0 2 b\n1 0 0 c\n");
    const { stdout, status } = spawnSync(
      "cargo",
      [
        "run",
        "--quiet",
        "--locked",
        "--release",
        "--manifest-path",
        join(root, "Cargo.toml"),
        "--example",
        example,
        "--",
        ...args.split(" "),
      ],
      { cwd: scratch, encoding: "utf8", env: { ...process.env, CARGO_TARGET_DIR: join(root, "target") } },
    );
    expect(status).toBe(0);
    expect(stdout).toBe("0 0 2 b\n1 0 0 c\n");
  });
});
