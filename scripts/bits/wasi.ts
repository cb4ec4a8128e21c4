// Runs a WebAssembly program under Node: `node wasi.js FILE`.
import { readFileSync } from "node:fs";
import { WASI } from "node:wasi";

/** The types of Node lack WebAssembly. The types of the browser have it, but scripts are compiled without them. */
interface Engine {
  Module: new (bytes: Uint8Array) => object;
  Instance: new (module: object, imports: object) => object;
}

const { Module, Instance } = (globalThis as unknown as { WebAssembly: Engine }).WebAssembly;
const [, , file = ""] = process.argv;
const wasi = new WASI({ version: "preview1", returnOnExit: true });
process.exitCode = wasi.start(new Instance(new Module(readFileSync(file)), wasi.getImportObject()));
