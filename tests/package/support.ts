import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { expect, vi } from "vitest";
import { seeded as randomNumbers } from "../bench/generators";
import "./same-bytes";

export { randomNumbers };

const require = createRequire(import.meta.url);

export const wasmPath = require.resolve("hidden-point-removal/hpr.wasm");
export const wasmBytes = (): Uint8Array<ArrayBuffer> => new Uint8Array(readFileSync(wasmPath));
/** The wasm of the entry `lite`. */
export const liteBytes = (): Uint8Array<ArrayBuffer> =>
  new Uint8Array(readFileSync(require.resolve("hidden-point-removal/lite/hpr.wasm")));

/** The package as on a fresh page, not initialized. */
export async function freshPackage() {
  vi.resetModules();
  return { ...(await import("hidden-point-removal")), ...(await import("hidden-point-removal/worker")) };
}

/** The package, initialized. */
export async function readyPackage() {
  const hpr = await freshPackage();
  await hpr.init();
  return hpr;
}

/** Points on a bumpy sphere of radius about 1: some hide others from any viewpoint. */
export function bumpySphere(seed: number, count: number): Float32Array {
  const random = randomNumbers(seed);
  const positions = new Float32Array(3 * count);
  for (let i = 0; i < count; i++) {
    const z = 2 * random() - 1;
    const angle = 2 * Math.PI * random();
    const radius = 1 + 0.05 * Math.sin(7 * angle) * Math.sin(9 * z) + 0.01 * random();
    const ring = Math.sqrt(1 - z * z);
    positions.set([radius * ring * Math.cos(angle), radius * ring * Math.sin(angle), radius * z], 3 * i);
  }
  return positions;
}

/** The Stanford bunny, 1,839 points. */
export function bunny(): Float32Array {
  const { positions } = require("bunny") as { positions: number[][] };
  return Float32Array.from(positions.flat());
}

/** The points with the given indices, one after another. */
export function pointsAt(positions: Float32Array, indices: number[]): Float32Array {
  return Float32Array.from(indices.flatMap((i) => [...positions.subarray(3 * i, 3 * i + 3)]));
}

export interface Problem {
  name: string;
  code?: string;
  message: string;
  cause?: unknown;
}

/** The error that a call throws, or that rejects a promise. */
export async function problemOf(call: () => unknown): Promise<Problem> {
  try {
    await call();
  } catch (error) {
    return error as Problem;
  }
  throw new Error("nothing was thrown");
}

export type Refusal = [code: string, names: RegExp, call: () => unknown];

/** A call must be refused with this code, in words that match. */
export async function expectRefusal(code: string, names: RegExp, call: () => unknown): Promise<void> {
  const message = expect.stringMatching(names) as string;
  expect(await problemOf(call)).toMatchObject({ name: "HprError", code, message });
}
