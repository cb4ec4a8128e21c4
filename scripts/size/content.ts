import { functionNames, Reader, SECTION, sectionsOf } from "../lib/wasm-reader.js";

/** One function of a WebAssembly module, with the bytes of its code. */
export interface WasmFunction {
  name: string;
  bytes: Uint8Array;
}

export interface WasmContent {
  functions: WasmFunction[];
  /** The names of what JavaScript can call. */
  exported: Set<string>;
  /** The constants that the module copies into its memory. */
  data: Uint8Array;
}

/** Splits a module that has a name section into its functions and its data. */
export function contentOf(module: Uint8Array): WasmContent {
  let imported = 0;
  let bodies: Uint8Array[] = [];
  let names = new Map<number, string>();
  let exported = new Set<string>();
  let data: Uint8Array = new Uint8Array();
  for (const { id, bytes } of sectionsOf(module)) {
    const section = new Reader(bytes);
    // All imports are functions: the glue imports no memory and no table.
    if (id === SECTION.import) imported = section.number();
    else if (id === SECTION.export) exported = new Set(section.list(() => exportedName(section)));
    else if (id === SECTION.code) bodies = section.list(() => section.bytes());
    else if (id === SECTION.data) data = section.rest();
    else if (id === SECTION.custom && section.text() === "name") names = functionNames(section);
  }
  const functions = bodies.map((body, i) => ({ name: names.get(imported + i) ?? "", bytes: body }));
  return { functions, exported, data };
}

function exportedName(section: Reader): string {
  const name = section.text();
  section.skip(1);
  section.number();
  return name;
}
