// One large cloud from end to end: the package stage by stage, then the command on a file. Every stage says how long
// it took and how much memory the process held. A stage that the package refuses says so.
import { spawn } from "node:child_process";
import {
  closeSync,
  existsSync,
  mkdirSync,
  openSync,
  readFileSync,
  rmSync,
  statSync,
  writeFileSync,
  writeSync,
} from "node:fs";
import { join } from "node:path";
import { HprError, init, PointCloud } from "hidden-point-removal";
import { WorkerPointCloud } from "hidden-point-removal/worker";
import { bumpySurface } from "../bench/generators.js";

const EXPONENT = 3;
const FROM: [number, number, number] = [0, 0, 5];
const MOVED: [number, number, number] = [0.02, 0, 5];
const SEED = 4;

export interface Stage {
  name: string;
  /** The result, or the message of a refusal. */
  result: string;
  seconds: number;
  /** Seconds of all cores. */
  cpu: number;
  /** Megabytes of the process after the stage, and at most during it. Undefined where the system does not say. */
  held: number | undefined;
  peak: number | undefined;
}

/** Runs all stages with a cloud of this many points. Files are written into `folder`. */
export async function large(points: number, folder: string, tell: (stage: Stage) => void): Promise<Stage[]> {
  const stages: Stage[] = [];
  const run = async (name: string, work: Work): Promise<boolean> => {
    forgetPeak();
    const [start, before] = [performance.now(), process.cpuUsage()];
    let [result, done] = ["", true];
    try {
      result = (await work()) ?? "";
    } catch (error) {
      if (!(error instanceof HprError)) throw error;
      [result, done] = [`refused, ${error.code}: ${error.message}`, false];
    }
    const { user, system } = process.cpuUsage(before);
    const seconds = (performance.now() - start) / 1000;
    const stage = { name, result, seconds, cpu: (user + system) / 1e6, held: memory("VmRSS"), peak: memory("VmHWM") };
    stages.push(stage);
    tell(stage);
    return done;
  };

  let positions = new Float32Array(0);
  await run("make the positions", () => {
    positions = bumpySurface(points, SEED);
    return `${megabytes(positions.byteLength)} MB`;
  });
  await init();
  await oneInstance(positions, run);
  await workers(positions, run);
  mkdirSync(folder, { recursive: true });
  const [input, output] = [join(folder, "large.ply"), join(folder, "visible.ply")];
  writePly(input, positions);
  positions = new Float32Array(0);
  const stage = await command(input, output);
  stages.push(stage);
  tell(stage);
  rmSync(folder, { recursive: true });
  return stages;
}

/** Returns what there is to say about the result. */
type Work = () => string | undefined | Promise<string | undefined>;
type Run = (name: string, work: Work) => Promise<boolean>;

async function oneInstance(positions: Float32Array, run: Run): Promise<void> {
  const cloud: { it?: PointCloud } = {};
  const counted = (from: [number, number, number], more = {}) => {
    const { count } = cloud.it!.visibleFrom(from, { exponent: EXPONENT, ...more });
    return `${count.toLocaleString("en")} visible`;
  };
  const built = await run("new PointCloud", () => {
    cloud.it = new PointCloud(positions);
    return `${cloud.it.length.toLocaleString("en")} points`;
  });
  if (!built) return;
  await run("visibleFrom, a draft", () => counted(FROM, { draft: true }));
  await run("visibleFrom, the same place", () => counted(FROM));
  await run("visibleFrom, 0.02 aside", () => counted(MOVED));
  await run("visibleFrom, automatic exponent", () => {
    return `${cloud.it!.visibleFrom(FROM).count.toLocaleString("en")} visible`;
  });
  await run("dispose", () => {
    cloud.it!.dispose();
    return undefined;
  });
}

async function workers(positions: Float32Array, run: Run): Promise<void> {
  const cloud: { it?: WorkerPointCloud } = {};
  const built = await run("WorkerPointCloud.create, default workers", async () => {
    cloud.it = await WorkerPointCloud.create(positions);
    return undefined;
  });
  if (!built) return;
  await run("its visibleFrom", async () => {
    const { count } = await cloud.it!.visibleFrom(FROM, { exponent: EXPONENT });
    return `${count.toLocaleString("en")} visible`;
  });
  await run("its dispose", async () => {
    await cloud.it!.dispose();
    return undefined;
  });
}

function writePly(file: string, positions: Float32Array): void {
  const fields = ["x", "y", "z"].map((name) => `property float ${name}\n`).join("");
  const header = `ply\nformat binary_little_endian 1.0\nelement vertex ${positions.length / 3}\n${fields}end_header\n`;
  writeFileSync(file, header);
  const descriptor = openSync(file, "a");
  const bytes = new Uint8Array(positions.buffer);
  for (let at = 0; at < bytes.length;) at += writeSync(descriptor, bytes, at, Math.min(1 << 26, bytes.length - at));
  closeSync(descriptor);
}

/** The command reads a file of the points and writes a file of the visible ones. */
async function command(input: string, output: string): Promise<Stage> {
  const name = `the command, PLY to PLY (${megabytes(statSync(input).size)} MB)`;
  const args = ["dist/cli/main.js", input, "--from", FROM.join(","), "--exponent", String(EXPONENT), "-o", output];
  const start = performance.now();
  const child = spawn(process.execPath, args, { stdio: ["ignore", "ignore", "pipe"] });
  let said = "";
  child.stderr.on("data", (chunk: Buffer) => (said += chunk.toString()));
  let [peak, cpu]: [number | undefined, number] = [undefined, 0];
  const watch = setInterval(() => {
    peak = memory("VmHWM", child.pid) ?? peak;
    cpu = ticks(child.pid) ?? cpu;
  }, 20);
  await new Promise((resolve) => child.on("close", resolve));
  clearInterval(watch);
  const seconds = (performance.now() - start) / 1000;
  const result =
    said
      .trim()
      .split(/[\r\n]+/)
      .at(-1) ?? "";
  return { name, result, seconds, cpu, held: undefined, peak };
}

function megabytes(bytes: number): string {
  return (bytes / 1e6).toFixed(0);
}

/** A line of /proc/PID/status in megabytes, where there is such a file. */
function memory(line: "VmRSS" | "VmHWM", pid: number | "self" = "self"): number | undefined {
  const file = `/proc/${pid}/status`;
  if (!existsSync(file)) return undefined;
  const [, kilobytes] = new RegExp(`^${line}:\\s*(\\d+) kB`, "m").exec(readFileSync(file, "utf8")) ?? [];
  return kilobytes === undefined ? undefined : (1024 * Number(kilobytes)) / 1e6;
}

/** Seconds of all cores that a process has used so far. */
function ticks(pid: number | undefined): number | undefined {
  const file = `/proc/${pid}/stat`;
  if (!existsSync(file)) return undefined;
  // The numbers follow the name, which stands in parentheses. The kernel counts 100 ticks a second.
  const fields = readFileSync(file, "utf8").split(") ").at(-1)!.split(" ");
  return (Number(fields[11]) + Number(fields[12])) / 100;
}

/** The peak starts anew with what the process holds now. */
function forgetPeak(): void {
  if (existsSync("/proc/self/clear_refs")) writeFileSync("/proc/self/clear_refs", "5");
}
