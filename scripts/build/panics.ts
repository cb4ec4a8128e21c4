import { functionNames, HEADER, Reader, SECTION, sectionsOf } from "../lib/wasm-reader.js";

/** The functions of Rust's libraries that a failed check calls, and that make and print its message. */
const PANICS =
  /\bpanicking::(panic\b|panic_fmt|panic_bounds_check|panic_const|panic_with_hook|assert_failed)|::panic_already_|::panic_access_error/;

/** No local variables, then `unreachable` and `end`. */
const TRAP = Uint8Array.of(0, 0x00, 0x0b);

/**
 * Makes a failed check trap without a message. The package reports a trap as the error `internal`. The places in the
 * code and the numbers of each message would take 3.7 kB of the gzipped module.
 *
 * `module` needs the names of its functions. Throws if it has no function to change.
 */
export function withoutMessages(module: Uint8Array): Uint8Array {
  const panics = new Set([...namesOf(module)].filter(([, name]) => PANICS.test(name)).map(([number]) => number));
  if (panics.size === 0) throw new Error("The module has no function for panics, or no names.");
  let imported = 0;
  const sections = sectionsOf(module).map(({ id, bytes }) => {
    const section = new Reader(bytes);
    // All imports are functions: the glue imports no memory and no table.
    if (id === SECTION.import) imported = section.number();
    if (id !== SECTION.code) return [Uint8Array.of(id), withLength(bytes)];
    const bodies = section.list(() => section.bytes());
    const changed = bodies.map((body, i) => withLength(panics.has(imported + i) ? TRAP : body));
    return [Uint8Array.of(id), withLength(Buffer.concat([encoded(bodies.length), ...changed]))];
  });
  return Buffer.concat([module.subarray(0, HEADER), ...sections.flat()]);
}

function namesOf(module: Uint8Array): Map<number, string> {
  for (const { id, bytes } of sectionsOf(module)) {
    const section = new Reader(bytes);
    if (id === SECTION.custom && section.text() === "name") return functionNames(section);
  }
  return new Map();
}

function withLength(bytes: Uint8Array): Uint8Array {
  return Buffer.concat([encoded(bytes.length), bytes]);
}

/** A number as WebAssembly writes it: seven bits a byte, the lowest first. */
function encoded(value: number): Uint8Array {
  const bytes = [];
  for (; value > 127; value >>>= 7) bytes.push((value & 127) | 128);
  return Uint8Array.of(...bytes, value);
}
