import { existsSync, readFileSync } from "node:fs";
import { dirname, join } from "node:path";

import { BUILD, FAIL, PASS, SETUP, checkCommand, sum, vitest, type Check, type Outcome } from "./check.js";
import { THIRD_PARTY, notAllowed, notLocked, shipped, thirdPartyText } from "../supply/third-party.js";
import { findOnPath, inRoot, print, run } from "../lib/run.js";
import { setUpBrowser } from "../setup/system.js";

/** All files that a user of the npm package gets. */
const WANTED =
  /^(dist\/.+\.(js|js\.map|d\.ts|wasm)|docs\/[\w-]+\.(md|png|webp)|examples\/\w+\.\w+|(README|CHANGELOG|SECURITY|THIRD_PARTY)\.md|LICENSE-MIT|LICENSE-APACHE|package\.json)$/;
const INDISPENSABLE = [
  "dist/index.js",
  "dist/index.d.ts",
  "dist/wasm/hpr_bg.wasm",
  "dist/lite/hpr_bg.wasm",
  "dist/formats/files.wasm",
  "README.md",
  "LICENSE-MIT",
  "THIRD_PARTY.md",
];

export const packagingChecks: Check[] = [
  {
    title: "Packaging: npm package",
    part: "packaging",
    needs: [BUILD],
    run: npmPackage,
  },
  {
    title: "Packaging: what package.json promises, and the types as every resolver finds them",
    part: "packaging",
    needs: [BUILD],
    run: async () =>
      sum([
        await checkCommand("publint", ["run", ".", "--strict"]),
        await checkCommand("attw", ["--pack", ".", "--profile", "esm-only", "--quiet"]),
      ]),
  },
  {
    title: "Packaging: the npm package in its users' projects",
    part: "packaging",
    needs: [BUILD],
    run: async () => vitest("tests/consumers", { env: { HPR_CHROMIUM: await setUpBrowser() } }),
  },
];

async function npmPackage(): Promise<Outcome> {
  const { ok, output } = await run("npm", ["pack", "--dry-run", "--json", "--loglevel=error"], { show: "nothing" });
  if (!ok) {
    print(output);
    return FAIL;
  }
  const files = filesIn(output);
  const unwanted = files.filter((file) => !WANTED.test(file));
  const missing = INDISPENSABLE.filter((file) => !files.includes(file));
  if (unwanted.length > 0) print(`Would be published, but should not: ${unwanted.join(", ")}\n`);
  if (missing.length > 0) print(`Would not be published, but should: ${missing.join(", ")}\n`);
  const broken = files
    .filter((file) => file.endsWith(".md"))
    .flatMap((file) => linksIn(file).map((link) => ({ file, link })))
    .filter(({ link }) => !files.includes(link));
  for (const { file, link } of broken) print(`${file} leads to ${link}, which would not be published\n`);
  print(`${files.length} files\n`);
  const found = [unwanted, missing, broken].map(({ length }) => (length === 0 ? PASS : FAIL));
  return sum([...found, await rehearsal()]);
}

/** The files that a document links to or shows. Its readers look for them in the package. */
function linksIn(document: string): string[] {
  const text = readFileSync(inRoot(document), "utf8");
  return [...text.matchAll(/(?:\]\(|<img src=")(?!\w+:|#)([^)#"]+)/g)].map(([, file]) =>
    join(dirname(document), file!),
  );
}

/** Rehearses the publication, without sending anything. npm reports everything that it would have to correct. */
async function rehearsal(): Promise<Outcome> {
  const { ok, output } = await run("npm", ["publish", "--dry-run", "--offline"], { show: "nothing" });
  const corrected = output
    .split("\n")
    .filter((line) => /auto-corrected|errors corrected|npm warn publish "/.test(line));
  if (ok && corrected.length === 0) return PASS;
  print(ok ? corrected.join("\n") : output);
  return FAIL;
}

function filesIn(output: string): string[] {
  const json = output.slice(output.indexOf("["), output.lastIndexOf("]") + 1);
  const [pack] = JSON.parse(json) as { files: { path: string }[] }[];
  return pack?.files.map((file) => file.path) ?? [];
}

export const supplyChecks: Check[] = [
  {
    title: "Supply: licenses of what ships, locked versions",
    part: "supply",
    needs: [SETUP],
    run: async () => {
      const components = await shipped();
      const all = [...components.crates, ...components.modules];
      const current = existsSync(THIRD_PARTY) && readFileSync(THIRD_PARTY, "utf8") === thirdPartyText(components);
      return sum([
        none("License not in the list of deny.toml", notAllowed(all)),
        none("Not locked to a registry by a checksum", notLocked()),
        none("Out of date", current ? [] : ["THIRD_PARTY.md: run `npm run licenses`"]),
      ]);
    },
  },
  {
    title: "Supply: cargo-deny, every crate of the lock file",
    part: "supply",
    needs: [SETUP],
    // Building it takes two minutes. That is too long for a machine that runs the tests once.
    run: async () =>
      findOnPath("cargo-deny") !== undefined
        ? checkCommand("cargo-deny", ["--offline", "check", "licenses", "bans", "sources"])
        : { passed: 0, failed: 0, skipped: "cargo-deny is not installed: `cargo install --locked cargo-deny`" },
  },
];

function none(what: string, found: string[]): Outcome {
  if (found.length === 0) return PASS;
  print(`${what}:\n${found.map((one) => `  ${one}\n`).join("")}`);
  return { ...FAIL, failures: [`${what}: ${found[0]!}`] };
}
