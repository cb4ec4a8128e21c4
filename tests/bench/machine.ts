// The machine and the versions behind the numbers.
import { spawnSync } from "node:child_process";
import { cpus, loadavg, platform, release, totalmem } from "node:os";

import type { Peer } from "./peers.js";

const [loadBefore = 0] = loadavg();

export function describeMachine(peers: Peer[]): Record<string, string> {
  const cores = cpus();
  const memory = `${Math.round(totalmem() / 2 ** 30)} GiB`;
  const rustc = spawnSync("rustc", ["--version"], { encoding: "utf8" }).stdout.trim();
  const versions = [`Node ${process.versions.node}`, rustc, ...peers.map(({ name, version }) => `${name} ${version}`)];
  return {
    // This load is read before anything is timed. Only the build before the benchmark should add to it.
    "load before (one minute)": loadBefore.toFixed(2),
    date: new Date().toISOString().slice(0, 10),
    machine: `${cores[0]?.model.trim() ?? "unknown CPU"}, ${cores.length} cores, ${memory}, ${platform()} ${release()}`,
    versions: versions.join(", "),
  };
}
