import { functionNames, HEADER, Reader, SECTION, sectionsOf } from "../lib/wasm-reader.js";

/**
 * Functions that a module never needs to run: those that a failed check calls, those that word its message, and those
 * by which JavaScript would call closures of Rust, of which there are none. A module keeps the last two because their
 * numbers are in its table. Failed checks also have the names that rustc gives them, in a module without glue.
 */
const NEEDLESS =
  /\bpanicking::(panic\b|panic_fmt|panic_bounds_check|panic_const|panic_with_hook|assert_failed)|::panic_already_|::panic_access_error|\bfmt::|::closures::_::invoke|js_sys::futures|9panicking(5panic$|9panic_fmt|18panic_bounds_check|11panic_const|15panic_with_hook|13assert_failed)/;

/** No local variables, then `unreachable` and `end`. */
const TRAP = Uint8Array.of(0, 0x00, 0x0b);

/**
 * Makes a failed check trap without a message. The package reports a trap as the error `internal`. Messages, and the
 * places in the code that they name, would take 7 kB of the gzipped module.
 *
 * `module` needs the names of its functions. Throws if it has no function to change, or no place.
 */
export function withoutMessages(module: Uint8Array): Uint8Array {
  const needless = new Set([...namesOf(module)].filter(([, name]) => NEEDLESS.test(name)).map(([number]) => number));
  if (needless.size === 0) throw new Error("The module has no function for panics, or no names.");
  let imported = 0;
  const sections = sectionsOf(module).map(({ id, bytes }) => {
    const section = new Reader(bytes);
    // All imports are functions: the glue imports no memory and no table.
    if (id === SECTION.import) imported = section.number();
    if (id === SECTION.data) return [Uint8Array.of(id), withLength(withoutPlaces(bytes))];
    if (id !== SECTION.code) return [Uint8Array.of(id), withLength(bytes)];
    const bodies = section.list(() => section.bytes());
    const changed = bodies.map((body, i) => withLength(needless.has(imported + i) ? TRAP : body));
    return [Uint8Array.of(id), withLength(Buffer.concat([encoded(bodies.length), ...changed]))];
  });
  return Buffer.concat([module.subarray(0, HEADER), ...sections.flat()]);
}

/**
 * Clears messages, and the places in the code that panics name: `core::panic::Location`, which is the address and the
 * length of a file's name, a line and a column, and the names. wasm-opt leaves out what is zero.
 */
function withoutPlaces(section: Uint8Array): Uint8Array {
  const cleared = Uint8Array.from(section);
  const reader = new Reader(cleared);
  const segments = reader.list(() => {
    // Two bytes before the address say that it is a constant; one byte ends it.
    reader.skip(2);
    const start = reader.number();
    reader.skip(1);
    return { start, bytes: reader.bytes() };
  });
  const at = (address: number, length: number) => {
    const holder = segments.find(({ start, bytes }) => address >= start && address + length <= start + bytes.length);
    return holder?.bytes.subarray(address - holder.start, address - holder.start + length);
  };
  const places: Uint8Array[] = [];
  for (const { bytes } of segments) {
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
    for (let place = 0; place + PLACE <= bytes.length; place += 4) {
      const [address, length, line, column] = [0, 4, 8, 12].map((from) => view.getUint32(place + from, true));
      const name = length! < 200 ? at(address!, length!) : undefined;
      if (name === undefined || line! > 100_000 || column! > 1000) continue;
      if (FILE_NAME.test(Buffer.from(name).toString("latin1"))) places.push(bytes.subarray(place, place + PLACE), name);
    }
  }
  if (places.length === 0) throw new Error("The module has no places in the code.");
  for (const place of places) place.fill(0);
  for (const { bytes } of segments) {
    for (const { 0: message, index } of Buffer.from(bytes).toString("latin1").matchAll(MESSAGE)) {
      bytes.fill(0, index, index + message.length);
    }
  }
  return cleared;
}

/** Parts of messages of the standard library and of the hull. The digits stay: the reader of E57 writes numbers. */
const MESSAGE =
  /attempt to [a-z ]+|copy_from_slice: [^\0]+|\) does not match the [^\0]+|" out of range for [a-z ]+|range (?:start|end) index |slice index starts at |index out of bounds[a-z: ]*|(?:RefCell )?already (?:mutably )?borrowed|cannot access a Thread Local [^\0]+|one-time initialization [a-z ]+|<?internal error: entered unreachable code[: a-zA-Z]*|chunk size must be non-zero|mid > len|called `Option::unwrap\w*\(\)` on a `None` value|closure invoked recursively or after being dropped|assertion (?:`left|failed: [\w!=<>+ ]+)|a new vertex is on the (?:outer|lower) boundary/g;

const PLACE = 16;
const FILE_NAME = /^[\w./-]+\.rs$/;

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
