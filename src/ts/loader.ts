import { describe, HprError, typeTag } from "./errors.js";
import { imports, runningInstance, startInstance } from "./instance.js";
import { hasNodeModules, importNodeModule } from "./node.js";

/**
 * `WebAssembly.Module`, written so that these types also compile where the
 * platform's own do not know it (Node's do not).
 */
export type WasmModule = typeof globalThis extends {
  WebAssembly: { Module: { prototype: infer Module } };
}
  ? Module
  : object;

/** The bytes of the wasm, or the compiled module. */
export type SyncInitInput = ArrayBuffer | ArrayBufferView | WasmModule;

/**
 * Where the wasm comes from: an address (in Node also a path), a response that
 * has arrived, its bytes, or the compiled module.
 */
export type InitInput = string | URL | Response | SyncInitInput;

const WAY_OUT =
  "Serve hpr_bg.wasm (the package exports it as hidden-point-removal/hpr.wasm) and pass its address to init(), " +
  "or pass its bytes";

let starting: { input: InitInput | undefined; done: Promise<void> } | undefined;
let ownModule: Promise<WebAssembly.Module> | undefined;

/**
 * Loads the wasm and starts it. Without an argument it is the file that comes
 * with the package. Does nothing where it is running already, and callers that
 * come with the same argument while it is starting get the same promise; with
 * another one they wait, and try theirs if the earlier one fails. After a failure
 * it may be called again; after a trap (`internal`) it starts a new instance.
 *
 * @throws HprError `load`, as a rejection, if it cannot be fetched, compiled or started.
 */
export function init(input?: InitInput): Promise<void> {
  if (runningInstance() !== undefined) {
    return Promise.resolve();
  }
  if (starting !== undefined && starting.input === input) {
    return starting.done;
  }
  const started = starting === undefined ? start(input) : starting.done.catch(() => start(input));
  const attempt = {
    input,
    done: started.finally(() => {
      if (starting === attempt) {
        starting = undefined;
      }
    }),
  };
  starting = attempt;
  return attempt.done;
}

/**
 * Starts the wasm from its bytes or its compiled module, at once. Does nothing
 * where it is running already.
 *
 * @throws HprError `load` if it cannot be compiled or started.
 */
export function initSync(input: SyncInitInput): void {
  if (runningInstance() !== undefined) {
    return;
  }
  try {
    const module = isModule(input) ? input : new WebAssembly.Module(bytesOf(input));
    startInstance(module, new WebAssembly.Instance(module, imports));
  } catch (cause) {
    throw loadError("the given wasm", cause);
  }
}

/**
 * The compiled wasm for a worker: that of the instance that is running or
 * starting, else the package's own file.
 */
export async function moduleForWorker(): Promise<WasmModule> {
  await starting?.done;
  return runningInstance()?.module ?? (await compileOwn());
}

async function start(input: InitInput | undefined): Promise<void> {
  const module = await (input === undefined ? compileOwn() : compile(input));
  try {
    const instance = await WebAssembly.instantiate(module, imports);
    // initSync() may have been called in the meantime.
    if (runningInstance() === undefined) {
      startInstance(module, instance);
    }
  } catch (cause) {
    throw loadError(input === undefined ? "the package's own wasm" : nameOf(input), cause);
  }
}

/** Compiled once, and kept for workers and for a start after a trap. */
function compileOwn(): Promise<WebAssembly.Module> {
  // One literal expression: bundlers look for exactly this form.
  const url = new URL("./wasm/hpr_bg.wasm", import.meta.url);
  ownModule ??= compile(url).catch((error: unknown) => {
    ownModule = undefined;
    throw error;
  });
  return ownModule;
}

async function compile(input: InitInput): Promise<WebAssembly.Module> {
  const source = nameOf(input);
  try {
    if (isModule(input)) {
      return input;
    }
    if (isResponse(input)) {
      return await compileResponse(input);
    }
    if (isAddress(input)) {
      return await compileAddress(input);
    }
    return await WebAssembly.compile(bytesOf(input));
  } catch (cause) {
    throw loadError(source, cause);
  }
}

async function compileAddress(address: string | URL): Promise<WebAssembly.Module> {
  const file = hasNodeModules() ? fileOf(address) : undefined;
  if (file === undefined) {
    return compileResponse(await fetch(address));
  }
  const { readFile } =
    await importNodeModule<typeof import("node:fs/promises")>("node:fs/promises");
  return WebAssembly.compile(await readFile(file));
}

async function compileResponse(response: Response): Promise<WebAssembly.Module> {
  if (!response.ok) {
    throw new Error(`the server answered ${response.status} ${response.statusText}`.trimEnd());
  }
  // Browsers refuse to compile while streaming under any other type.
  if (response.headers.get("Content-Type") === "application/wasm") {
    return WebAssembly.compileStreaming(response);
  }
  return WebAssembly.compile(await response.arrayBuffer());
}

/** The file that an address means, unless it is one to fetch. */
function fileOf(address: string | URL): string | URL | undefined {
  let url: URL;
  try {
    url = new URL(address);
  } catch {
    return address;
  }
  if (url.protocol === "file:") {
    return url;
  }
  // C:\hpr.wasm parses as a URL too.
  return /^[a-z]:$/.test(url.protocol) ? address : undefined;
}

function bytesOf(input: unknown): ArrayBuffer | Uint8Array<ArrayBuffer> {
  if (ArrayBuffer.isView(input)) {
    const bytes = new Uint8Array(input.buffer, input.byteOffset, input.byteLength);
    // Compilers refuse shared memory, which could change under them.
    return typeTag(input.buffer) === "ArrayBuffer" ? (bytes as Uint8Array<ArrayBuffer>) : bytes.slice();
  }
  if (typeTag(input) === "ArrayBuffer") {
    return input as ArrayBuffer;
  }
  throw new TypeError(
    `expected a URL, a Response, the bytes or a WebAssembly.Module, got ${describe(input)}`,
  );
}

function isModule(input: unknown): input is WebAssembly.Module {
  return typeTag(input) === "WebAssembly.Module";
}

function isResponse(input: unknown): input is Response {
  return typeTag(input) === "Response";
}

function isAddress(input: unknown): input is string | URL {
  return typeof input === "string" || typeTag(input) === "URL";
}

function nameOf(input: InitInput): string {
  if (isResponse(input)) {
    return input.url === "" ? "the wasm from the given Response" : `the wasm from ${input.url}`;
  }
  if (input === "") {
    return "the wasm from an empty address";
  }
  return isAddress(input) ? `the wasm from ${String(input)}` : "the given wasm";
}

function loadError(source: string, cause: unknown): HprError {
  const reason = cause instanceof Error ? cause.message : String(cause);
  return new HprError("load", `could not load ${source}: ${reason}. ${WAY_OUT}.`, { cause });
}
