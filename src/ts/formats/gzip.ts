import { FormatProblem } from "./problem.js";
import { blocks, bytesSource, checkByteLength, type Source } from "./source.js";

/** So many bytes are unpacked of any file. Beyond them, no file of points is so many times as large as its packing. */
const [SURELY, RATIO] = [1 << 26, 100];

/** A file that was packed with gzip, unpacked and without the ending of its name. Any other file as it is. */
export async function unpacked<File extends { source: Source; name: string }>(file: File): Promise<File> {
  const [first, second] = await file.source.read(0, 2);
  if (first !== 0x1f || second !== 0x8b) return file;
  const parts: Uint8Array<ArrayBuffer>[] = [];
  let length = 0;
  for await (const part of unpackedParts(file.source)) {
    length += part.length;
    checkByteLength(length);
    if (length > SURELY && length > RATIO * file.source.size) {
      const times = Math.round(length / file.source.size);
      throw new FormatProblem(`it is packed with gzip to less than 1/${times} of its size, as no points are`);
    }
    parts.push(part);
  }
  const whole = new Uint8Array(length);
  let at = 0;
  for (const part of parts) {
    whole.set(part, at);
    at += part.length;
  }
  return { ...file, source: bytesSource(whole), name: file.name.replace(/\.gz$/i, "") };
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
