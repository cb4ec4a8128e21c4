// Workers that are only a script: the test itself gives their messages, in any order. No thread runs, so nothing
// depends on the speed of the machine.
import { EventEmitter } from "node:events";
import type threads from "node:worker_threads";
import { expect } from "vitest";

import type { WorkerPointCloud } from "hidden-point-removal/worker";

import { OriginalWorker, replaceWorker } from "./node-workers";

type Cloud = Awaited<ReturnType<typeof WorkerPointCloud.create>>;

/** A request, without the wasm module. */
export interface Posted {
  kind: string;
  [field: string]: unknown;
}

export class ScriptedWorker extends EventEmitter {
  /** The requests as the worker gets them. */
  readonly posted: Posted[] = [];
  /** The sizes of the buffers that were moved with each request. */
  readonly moved: number[][] = [];
  isBusy = true;
  isEnded = false;

  constructor() {
    super();
    scripted.push(this);
  }

  postMessage({ content }: { content: Posted }, transfer: ArrayBuffer[]): void {
    this.moved.push(transfer.map(({ byteLength }) => byteLength));
    this.posted.push(structuredClone({ ...content, module: undefined }, { transfer }));
  }

  ref(): void {
    this.isBusy = true;
  }

  unref(): void {
    this.isBusy = false;
  }

  terminate(): Promise<number> {
    this.isEnded = true;
    return Promise.resolve(0);
  }

  /** Sends a message about the first cloud of this worker. */
  says(content: object): void {
    this.emit("message", { cloud: 0, content });
  }

  answers(value: object): void {
    this.says({ value });
  }

  refuses(code: string, message: string): void {
    this.says({ error: { code, message } });
  }

  isReady(): void {
    this.emit("message", "ready");
  }
}

/** All scripted workers of the test. */
export const scripted: ScriptedWorker[] = [];

export function useScriptedWorkers(): void {
  scripted.length = 0;
  replaceWorker(ScriptedWorker as unknown as typeof threads.Worker);
}

export function useOwnWorkers(): void {
  replaceWorker(OriginalWorker);
}

export async function until(isSo: () => boolean): Promise<void> {
  await expect.poll(isSo, { interval: 1 }).toBe(true);
}

/** The cloud, as soon as this number of workers hold it. */
export async function heldBy(size: number, creating: Promise<Cloud>, length: number): Promise<Cloud> {
  await until(() => scripted.length === size);
  for (const worker of scripted) worker.isReady();
  await until(() => scripted.every(({ posted }) => posted.length === 1));
  for (const worker of scripted) worker.answers({ length, skipped: 0, spacing: 1 });
  return creating;
}

/** The answer to a view. */
export function found(indices: number[], length: number): object {
  const settings = { radius: 1, exponent: 0, evaluations: 0, inversion: { kernel: "spherical" }, exact: true };
  return { indices: Uint32Array.from(indices), length, ...settings };
}
