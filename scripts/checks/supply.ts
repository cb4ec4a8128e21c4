import { existsSync, readFileSync } from "node:fs";

import { print } from "../lib/output.js";
import { findOnPath } from "../lib/paths.js";
import { notAllowed } from "../supply/allowed.js";
import { notLocked } from "../supply/locked.js";
import { THIRD_PARTY, shipped, thirdPartyText } from "../supply/third-party.js";
import { SETUP } from "./build.js";
import type { Check, Outcome } from "./check.js";
import { FAIL, PASS, checkCommand, sum } from "./check.js";

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
