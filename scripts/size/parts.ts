import { gzipSync } from "node:zlib";

import type { WasmFunction, WasmContent } from "./content.js";

/**
 * A part of the wasm: its bytes, and by how much the gzipped wasm would shrink without it. Small functions count for
 * their callers. Parts resemble each other, so the gzipped numbers add up to less than the whole.
 */
interface Part {
  name: string;
  bytes: number;
  gzipped: number;
}

const BINDINGS = "bindings";
const OUTSIDE: [part: string, names: RegExp][] = [
  [BINDINGS, /(externref|multivalue) shim|wasm_bindgen|js_sys|web_sys|serde|externref|wbg|wbindgen/],
  ["libm: pow, exp, logarithms, sine, cosine", /libm::/],
  ["allocator", /dlmalloc|__rdl_|__rust_|__rustc/i],
];

/** The parts of a module, the largest first. */
export function partsOf({ functions, exported, data }: WasmContent): Part[] {
  const groups = new Map<string, Uint8Array[]>([["constants", [data]]]);
  for (const { name, bytes } of functions) {
    const part = exported.has(name) ? BINDINGS : partOf(name);
    groups.set(part, [...(groups.get(part) ?? []), bytes]);
  }
  const whole = gzipped([...groups.values()].flat());
  const parts = [...groups].map(([name, pieces]) => {
    const others = [...groups].filter(([other]) => other !== name).flatMap(([, bytes]) => bytes);
    return { name, bytes: total(pieces), gzipped: whole - gzipped(others) };
  });
  return parts.sort((a, b) => b.bytes - a.bytes);
}

/** The room of a function. For `answers`, also the file. */
function partOf(name: string): string {
  const [, room, file] = /hidden_point_removal::(\w+)(?:::(\w+))?/.exec(name) ?? [];
  if (room === "wasm") return BINDINGS;
  if (room === "answers") return `answers/${file}`;
  return room ?? OUTSIDE.find(([, names]) => names.test(name))?.[0] ?? "standard library";
}

/** The functions with the most bytes. */
export function largest(functions: WasmFunction[], count: number): WasmFunction[] {
  return [...functions].sort((a, b) => b.bytes.length - a.bytes.length).slice(0, count);
}

function gzipped(pieces: Uint8Array[]): number {
  return gzipSync(Buffer.concat(pieces), { level: 9 }).length;
}

function total(pieces: Uint8Array[]): number {
  return pieces.reduce((sum, piece) => sum + piece.length, 0);
}
