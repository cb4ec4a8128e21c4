import { describe, HprError, typeTag } from "../base/errors.js";
import { hasNodeModules, importNodeModule, installedFile } from "../base/node.js";

/**
 * `WebAssembly.Module`, written so that these types also compile if the platform's own types lack
 * it (Node's do).
 */
export type WasmModule = typeof globalThis extends {
  WebAssembly: { Module: { prototype: infer Module } };
}
  ? Module
  : object;

/** The bytes of the wasm, or the compiled module. */
export type SyncInitInput = ArrayBuffer | ArrayBufferView | WasmModule;

/**
 * The source of the wasm: an address (in Node also a path), a response, the bytes, or the compiled
 * module.
 */
export type InitInput = string | URL | Response | SyncInitInput;

/** A wasm file of this package. */
export interface Binary {
  /** The name by which the package exports it. */
  readonly file: string;
  /** What to do if it cannot be loaded. */
  readonly wayOut: string;
}

/** That of all entries but `lite`. */
export const FULL: Binary = {
  file: "hpr.wasm",
  wayOut:
    "Serve hpr_bg.wasm (the package exports it as hidden-point-removal/hpr.wasm) and pass its address to init() or " +
    "configure({ wasm }), or pass its bytes, or import hidden-point-removal/inline, which carries it along " +
    "(docs/BUNDLERS.md)",
};

/** The source for `init()` without an argument: the file beside the package, or the embedded wasm. */
export type OwnWasm = () => Promise<WasmModule>;

/** What a page needs whose security policy forbids WebAssembly. */
const POLICY = "The page's security policy forbids WebAssembly: add 'wasm-unsafe-eval' to its script-src";

export async function compile(input: InitInput, binary: Binary): Promise<WasmModule> {
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
    throw loadError(source, cause, binary);
  }
}

/**
 * Compiles the package's own file. On a server, a bundler may have put an address of the site in the place
 * of the file's. Then the file is taken from the installed package.
 */
export async function compileOwn(address: () => URL, binary: Binary): Promise<WasmModule> {
  let own: URL | undefined;
  try {
    own = address();
    return await compile(own, binary);
  } catch (error) {
    const file = hasNodeModules() ? await installedFile(binary.file, own?.href) : undefined;
    if (file !== undefined) {
      return compile(file, binary);
    }
    throw own === undefined ? loadError("the package's own wasm", error, binary) : error;
  }
}

async function compileAddress(address: string | URL): Promise<WebAssembly.Module> {
  const file = hasNodeModules() ? fileOf(address) : undefined;
  if (file === undefined) {
    return compileResponse(await fetch(address));
  }
  const { readFile } = await importNodeModule<typeof import("node:fs/promises")>("node:fs/promises");
  return WebAssembly.compile(await readFile(file));
}

async function compileResponse(response: Response): Promise<WebAssembly.Module> {
  if (!response.ok) {
    throw new Error(`the server answered ${response.status} ${response.statusText}`.trimEnd());
  }
  // Browsers compile while streaming only with this type.
  if (response.headers.get("Content-Type") === "application/wasm") {
    return WebAssembly.compileStreaming(response);
  }
  return WebAssembly.compile(await response.arrayBuffer());
}

/** In Node: the path of a file, if the address means a file. Undefined for an address to fetch. */
export function fileOf(address: string | URL): string | URL | undefined {
  let url: URL;
  try {
    url = new URL(address);
  } catch {
    return address;
  }
  if (url.protocol === "file:") {
    return url;
  }
  // C:\hpr.wasm also parses as a URL.
  return /^[a-z]:$/.test(url.protocol) ? address : undefined;
}

export function bytesOf(input: unknown): ArrayBuffer | Uint8Array<ArrayBuffer> {
  if (ArrayBuffer.isView(input)) {
    const bytes = new Uint8Array(input.buffer, input.byteOffset, input.byteLength);
    // Compilers refuse shared memory, since others could change it during the compilation.
    return typeTag(input.buffer) === "ArrayBuffer" ? (bytes as Uint8Array<ArrayBuffer>) : bytes.slice();
  }
  if (typeTag(input) === "ArrayBuffer") {
    return input as ArrayBuffer;
  }
  throw new TypeError(`expected a URL, a Response, the bytes or a WebAssembly.Module, got ${describe(input)}`);
}

export function isModule(input: unknown): input is WasmModule {
  return typeTag(input) === "WebAssembly.Module";
}

function isResponse(input: unknown): input is Response {
  return typeTag(input) === "Response";
}

function isAddress(input: unknown): input is string | URL {
  return typeof input === "string" || typeTag(input) === "URL";
}

export function nameOf(input: InitInput): string {
  if (isResponse(input)) {
    return input.url === "" ? "the wasm from the given Response" : `the wasm from ${input.url}`;
  }
  if (input === "") {
    return "the wasm from an empty address";
  }
  return isAddress(input) ? `the wasm from ${String(input)}` : "the given wasm";
}

export function loadError(source: string, cause: unknown, { wayOut }: Binary): HprError {
  const reason = cause instanceof Error ? cause.message : String(cause);
  const advice = /Content.Security.Policy/i.test(reason) ? POLICY : wayOut;
  return new HprError("load", `could not load ${source}: ${reason}. ${advice}.`, { cause });
}

/** Compiles once, and keeps the module for workers and for a start after a trap. A failure is not kept. */
export function compiledOnce(load: OwnWasm): OwnWasm {
  let module: Promise<WasmModule> | undefined;
  return () => {
    module ??= load().catch((error: unknown) => {
      module = undefined;
      throw error;
    });
    return module;
  };
}
