import { arch, platform } from "node:os";

import { findOnPath, inRoot } from "../lib/paths.js";
import { Problem, run } from "../lib/run.js";
import { aptInstall, canInstallOnDebian } from "../setup/debian.js";
import { setUpTarget } from "../setup/rust.js";

export interface Platform {
  name: string;
  target: string;
  /** The arguments for cargo's build, without the target. */
  build: string[];
  env: Record<string, string>;
  /** The command that runs the program; empty if this machine runs it directly. */
  runner: string[];
}

interface Machine {
  target: string;
  /** The name of the processor in Node. */
  processor: string;
  /** The program of QEMU that emulates the processor. */
  qemu: string;
  /** The folder of the C library, for a target that does not bring its own. */
  root?: string;
  linker?: { program: string; package: string };
}

const OPTIMIZED = ["--profile", "quick"];
const DEBUG = ["--profile", "dev"];
// Targets with musl bring everything that linking needs. They need no C compiler.
const X64: Machine = { target: "x86_64-unknown-linux-musl", processor: "x64", qemu: "qemu-x86_64" };
const X86: Machine = { target: "i686-unknown-linux-musl", processor: "x64", qemu: "qemu-i386" };
const ARM64: Machine = { target: "aarch64-unknown-linux-musl", processor: "arm64", qemu: "qemu-aarch64" };
const ARM32: Machine = {
  target: "armv7-unknown-linux-gnueabihf",
  processor: "arm",
  qemu: "qemu-arm",
  root: "/usr/arm-linux-gnueabihf",
  linker: { program: "arm-linux-gnueabihf-gcc", package: "gcc-arm-linux-gnueabihf" },
};
const WASI = "wasm32-wasip1";
const NO_STD = ["--no-default-features"];

/** Every platform, with the function that prepares it. A `Problem` says why this machine cannot run it. */
export const PLATFORMS: [name: string, prepare: (name: string) => Promise<Platform>][] = [
  ["this machine, optimized", (name) => thisMachine(name, OPTIMIZED)],
  ["WebAssembly", (name) => wasi(name, OPTIMIZED, "")],
  ["WebAssembly, SIMD", (name) => wasi(name, OPTIMIZED, "-C target-feature=+simd128")],
  ["ARM, 64 bits", (name) => linux(name, ARM64, OPTIMIZED)],
  ["x86, 32 bits", (name) => linux(name, X86, OPTIMIZED)],
  ["x86, 64 bits, without std", (name) => linux(name, X64, [...OPTIMIZED, ...NO_STD])],
  ["ARM, 32 bits", (name) => linux(name, ARM32, OPTIMIZED)],
  ["x86, 64 bits, AVX2 and FMA", (name) => linux(name, X64, OPTIMIZED, "-C target-cpu=x86-64-v3")],
  ["x86, 32 bits, without std", (name) => linux(name, X86, [...OPTIMIZED, ...NO_STD])],
  // The slow platforms come last.
  ["this machine, debug", (name) => thisMachine(name, DEBUG)],
  ["x86, 32 bits, debug", (name) => linux(name, X86, DEBUG)],
  ["WebAssembly, SIMD, debug", (name) => wasi(name, DEBUG, "-C target-feature=+simd128")],
];

async function thisMachine(name: string, build: string[]): Promise<Platform> {
  const { output } = await run("rustc", ["-vV"], { show: "nothing" });
  const [, target] = /^host: (\S+)$/m.exec(output) ?? [];
  if (target === undefined) throw new Problem("rustc does not say what machine it runs on");
  return { name, target, build, env: {}, runner: [] };
}

async function linux(name: string, machine: Machine, build: string[], flags = ""): Promise<Platform> {
  if (platform() !== "linux") throw new Problem("it needs Linux");
  const { target, processor, qemu, root, linker } = machine;
  await setUpTarget(target);
  const runner = processor === arch() ? [] : [await program(qemu, "qemu-user")];
  if (runner.length > 0 && root !== undefined) runner.push("-L", root);
  const links = linker === undefined ? "rust-lld" : await program(linker.program, linker.package);
  const own = linker === undefined ? "-C link-self-contained=yes " : "";
  const variable = `CARGO_TARGET_${target.toUpperCase().replaceAll("-", "_")}_LINKER`;
  return { name, target, build, env: { [variable]: links, RUSTFLAGS: own + flags }, runner };
}

async function wasi(name: string, build: string[], flags: string): Promise<Platform> {
  await setUpTarget(WASI);
  const runner = [process.execPath, "--no-warnings", inRoot("target", "scripts", "bits", "wasi.js")];
  return { name, target: WASI, build, env: { RUSTFLAGS: flags }, runner };
}

/** Finds a program. If it is missing, installs its Debian package where possible. */
async function program(name: string, debian: string): Promise<string> {
  const there = findOnPath(name) !== undefined || (canInstallOnDebian() && (await aptInstall(debian)));
  if (!there) throw new Problem(`${name} is missing (Debian package ${debian})`);
  return name;
}
