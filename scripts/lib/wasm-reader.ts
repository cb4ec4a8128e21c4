/** The numbers of sections. */
export const SECTION = { custom: 0, import: 2, memory: 5, export: 7, code: 10, data: 11 } as const;

/** Bytes of the magic number and of the version, before the first section. */
export const HEADER = 8;

const FUNCTION_NAMES = 1;

export interface Section {
  id: number;
  bytes: Uint8Array;
}

/** The sections of a module, in their order. */
export function sectionsOf(module: Uint8Array): Section[] {
  const reader = new Reader(module);
  reader.skip(HEADER);
  const sections = [];
  while (!reader.done) sections.push({ id: reader.number(), bytes: reader.bytes() });
  return sections;
}

/** The names of functions, by their numbers. `section` is the rest of the custom section "name". */
export function functionNames(section: Reader): Map<number, string> {
  while (!section.done) {
    const kind = section.number();
    const part = new Reader(section.bytes());
    if (kind === FUNCTION_NAMES) return new Map(part.list(() => [part.number(), part.text()]));
  }
  return new Map();
}

/** Reads numbers, byte strings and lists as WebAssembly writes them. */
export class Reader {
  readonly #bytes: Uint8Array;
  #at = 0;

  constructor(bytes: Uint8Array) {
    this.#bytes = bytes;
  }

  get done(): boolean {
    return this.#at >= this.#bytes.length;
  }

  skip(count: number): void {
    this.#at += count;
  }

  number(): number {
    let value = 0;
    for (let weight = 1; ; weight *= 128) {
      const byte = this.#bytes[this.#at++]!;
      value += (byte & 127) * weight;
      if (byte < 128) return value;
    }
  }

  bytes(): Uint8Array {
    const length = this.number();
    this.skip(length);
    return this.#bytes.subarray(this.#at - length, this.#at);
  }

  text(): string {
    return new TextDecoder().decode(this.bytes());
  }

  list<T>(item: () => T): T[] {
    return Array.from({ length: this.number() }, item);
  }

  rest(): Uint8Array {
    return this.#bytes.subarray(this.#at);
  }
}
