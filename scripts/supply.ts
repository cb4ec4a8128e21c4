// npm run supply: installs cargo-deny if it is missing, then checks licenses, duplicates, sources and
// known weaknesses of every crate and every npm package. The check for weaknesses needs the network.
import { command } from "./lib/command.js";
import { run } from "./lib/run.js";
import { setUpLinker } from "./setup/linker.js";
import { setUpRust } from "./setup/rust.js";
import { setUpCargoDeny } from "./supply/deny.js";

/** The checks. `unreachable` matches the message that the list of weaknesses cannot be reached. */
const CHECKS: { name: string; command: string[]; unreachable?: RegExp }[] = [
  { name: "crates: licenses, duplicates, sources", command: ["cargo-deny", "check", "licenses", "bans", "sources"] },
  {
    name: "crates: known weaknesses",
    command: ["cargo-deny", "check", "advisories"],
    unreachable: /failed to fetch advisory database/,
  },
  {
    name: "npm packages: known weaknesses",
    command: ["npm", "audit", "--audit-level=high"],
    unreachable: /audit endpoint returned an error|ENOTFOUND|ECONNREFUSED|EAI_AGAIN|ETIMEDOUT/,
  },
];

await command(async () => {
  await setUpRust();
  await setUpLinker();
  await setUpCargoDeny();
  const rows: string[] = [];
  for (const {
    name,
    command: [program = "", ...args],
    unreachable,
  } of CHECKS) {
    const { ok, output } = await run(program, args, { show: "results" });
    const closed = !ok && unreachable?.test(output) === true;
    if (!ok && !closed) process.exitCode = 1;
    rows.push(
      `${name}: ${ok ? "nothing found" : closed ? "not checked: the list cannot be reached from here" : "FAILED"}`,
    );
  }
  console.log(`\n${rows.join("\n")}`);
});
