import { FormatProblem } from "./problem.js";
import { LONGEST_LINE, looksBinary, markLength, tooLong } from "./text.js";

/** The bytes of a file, wherever they are. */
export interface Source {
  size: number;
  /** The bytes of a part; fewer at the end of the file. */
  read: (from: number, to: number) => Promise<Uint8Array<ArrayBuffer>>;
}

export const BLOCK = 1 << 24;
/** The size limit of files that must be in memory as a whole: compressed PCD, GLB, text in UTF-16. */
const MOST_AT_ONCE = 1_000_000_000;
const [LINE_FEED, RETURN] = [0x0a, 0x0d];

const number = new Intl.NumberFormat("en-US");

export function blobSource(blob: Blob): Source {
  return {
    size: blob.size,
    read: async (from, to) => {
      try {
        return new Uint8Array(await blob.slice(from, to).arrayBuffer());
      } catch (cause) {
        throw new FormatProblem("it was moved or changed, or there is too little memory", { cause });
      }
    },
  };
}

export function bytesSource({ buffer, byteOffset, length }: Uint8Array<ArrayBuffer>): Source {
  // A part of Node's Buffer would share its bytes where a part of an array is a copy.
  const bytes = new Uint8Array(buffer, byteOffset, length);
  return { size: length, read: (from, to) => Promise.resolve(bytes.subarray(from, to)) };
}

export async function wholeFile({ size, read }: Source): Promise<Uint8Array<ArrayBuffer>> {
  checkByteLength(size);
  return read(0, size);
}

export function checkByteLength(bytes: number): void {
  if (bytes > MOST_AT_ONCE) {
    const [size, most] = [bytes, MOST_AT_ONCE].map((each) => number.format(Math.round(each / 1e6)));
    throw new FormatProblem(`it is too large: ${size} MB, and such files are read up to ${most} MB`);
  }
}

export function viewOf(bytes: Uint8Array): DataView {
  return new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
}

/** The bytes from a place on, one piece at a time: only that piece of a large file is in memory. */
export async function* blocks(
  { size, read }: Source,
  start: number,
  multipleOf = 1,
): AsyncGenerator<Uint8Array<ArrayBuffer>> {
  const length = Math.max(1, Math.floor(BLOCK / multipleOf)) * multipleOf;
  for (let at = start; at < size; at += length) yield await read(at, at + length);
}

/** Lines that follow one another. */
export interface Lines {
  texts: string[];
  /** The number of the first one. */
  number: number;
  /** The place where the last one ends. */
  end: number;
  /** The place of each line in the file, and of the end of the last one. */
  places: () => Float64Array;
}

/** The lines from a place on, in groups of hundreds of thousands. They may have any kind of line end. */
export async function* lines(source: Source, start: number, firstNumber = 1): AsyncGenerator<Lines> {
  const decoder = new TextDecoder("utf-8", { ignoreBOM: true });
  let at = start === 0 ? markLength(await source.read(0, 3)) : start;
  let rest = new Uint8Array();
  let line = firstNumber;
  for await (const block of blocks(source, at)) {
    const bytes = joined(rest, block);
    if (at + bytes.length === source.size) {
      yield linesIn(bytes, decoder, line, at);
      return;
    }
    // The text after the last line end is not complete yet. A carriage return may belong to a line end that the next
    // block completes.
    const end = Math.max(bytes.lastIndexOf(LINE_FEED), bytes.lastIndexOf(RETURN, bytes.length - 2)) + 1;
    rest = bytes.slice(end);
    if (end > 0) {
      const some = linesIn(bytes.subarray(0, end), decoder, line, at);
      some.texts.pop();
      yield some;
      line += some.texts.length;
      at += end;
    }
    if (rest.length > LONGEST_LINE) throw tooLong(line);
  }
  if (rest.length > 0) yield linesIn(rest, decoder, line, at);
}

function joined(a: Uint8Array<ArrayBuffer>, b: Uint8Array<ArrayBuffer>): Uint8Array<ArrayBuffer> {
  if (a.length === 0) return b;
  const both = new Uint8Array(a.length + b.length);
  both.set(a);
  both.set(b, a.length);
  return both;
}

function linesIn(bytes: Uint8Array, decoder: TextDecoder, line: number, at: number): Lines {
  const text = decoder.decode(bytes);
  const texts = text.includes("\r") ? text.split(/\r\n|\r|\n/) : text.split("\n");
  const long = texts.findIndex(({ length }) => length > LONGEST_LINE);
  if (long >= 0) throw tooLong(line + long);
  return { texts, number: line, end: at + bytes.length, places: () => placesOf(bytes, texts.length, at) };
}

function placesOf(bytes: Uint8Array, count: number, at: number): Float64Array {
  const places = new Float64Array(count + 1).fill(at + bytes.length);
  let line = 0;
  places[line++] = at;
  for (let i = 0; i < bytes.length; i++) {
    const byte = bytes[i]!;
    if (byte === LINE_FEED || (byte === RETURN && bytes[i + 1] !== LINE_FEED)) places[line++] = at + i + 1;
  }
  return places;
}

/** So many bytes are unpacked of any file. Beyond them, hardly a file of points is so many times as large as its packing. */
const [SURELY, RATIO] = [1 << 26, 25];

/** Whether so many bytes are too many to be unpacked from so few. It is asked before memory is taken. */
export function isTooMuch(unpacked: number, packed: number, ratio = RATIO): boolean {
  return unpacked > SURELY && unpacked > ratio * packed;
}

/** A file that was packed with gzip, unpacked and without the ending of its name. Any other file as it is. */
export async function unpacked<File extends { source: Source; name: string }>(file: File): Promise<File> {
  const { size, read } = file.source;
  const [first, second] = await read(0, 2);
  if (first !== 0x1f || second !== 0x8b) return file;
  // A packing ends with the length of what it holds. One in several parts ends with that of the last part.
  const end = await read(Math.max(0, size - 4), size);
  const promised = end.length < 4 ? 0 : viewOf(end).getUint32(0, true);
  const refuse = (bytes: number) => {
    const says = `is damaged, has several parts, or holds ${number.format(bytes)} bytes`;
    throw new FormatProblem(`it is packed with gzip, and the packing ${says}; unpack it first`);
  };
  if (isTooMuch(promised, size) || promised > MOST_AT_ONCE) refuse(promised);
  // Blobs may lie on a disk, and thousands of small arrays cost more than their bytes.
  let parts: BlobPart[] = [];
  let length = 0;
  for await (const part of unpackedParts(file.source)) {
    length += part.length;
    if (length > promised && length > SURELY) refuse(length);
    if (parts.push(part) > 1000) parts = [new Blob(parts)];
  }
  return { ...file, source: blobSource(new Blob(parts)), name: file.name.replace(/\.gz$/i, "") };
}

async function* unpackedParts(source: Source): AsyncGenerator<Uint8Array<ArrayBuffer>> {
  const { readable, writable } = new DecompressionStream("gzip");
  const writer = writable.getWriter();
  // The reader below reports what goes wrong.
  const fed = feed(source, writer).catch((error: unknown) => writer.abort(error).catch(() => undefined));
  const reader = readable.getReader();
  try {
    for (;;) {
      const { done, value } = await reader.read().catch((cause: unknown) => {
        if (cause instanceof FormatProblem) throw cause;
        throw new FormatProblem("it is packed with gzip, and the packing is damaged", { cause });
      });
      if (done) return;
      yield value;
    }
  } finally {
    // A file that is too large is not read to its end.
    reader.cancel().catch(() => undefined);
    await fed;
  }
}

async function feed(source: Source, writer: WritableStreamDefaultWriter<Uint8Array<ArrayBuffer>>): Promise<void> {
  for await (const block of blocks(source, 0)) await writer.write(block);
  await writer.close();
}

/** The text of a file in UTF-8. Some spreadsheets export text with two bytes for each character. */
export async function textOf({ source, records }: { source: Source; records?: boolean | undefined }): Promise<Source> {
  const start = await source.read(0, 4096);
  const encoding = encodingOf(start);
  if (encoding === "utf-8") {
    if (looksBinary(start)) throw new FormatProblem("it is not text");
    return source;
  }
  // The bytes of points cannot be taken from text in another encoding.
  if (records) throw new FormatProblem("it is text in UTF-16; save it in UTF-8");
  return bytesSource(new TextEncoder().encode(new TextDecoder(encoding).decode(await wholeFile(source))));
}

/** The encoding by the byte order mark. */
function encodingOf([first, second]: Uint8Array): "utf-8" | "utf-16le" | "utf-16be" {
  if (first === 0xff && second === 0xfe) return "utf-16le";
  return first === 0xfe && second === 0xff ? "utf-16be" : "utf-8";
}
