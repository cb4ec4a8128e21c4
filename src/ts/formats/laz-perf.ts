/** The memory of laz-perf, the LAZ decoder of hobu (Apache 2.0). `createLazPerf()` of its package makes it. */
interface LazMemory {
  /** If the memory has grown, this is another array. */
  readonly HEAPU8: Uint8Array;
  /** Takes memory of the decoder. */
  _malloc(bytes: number): number;
  /** Gives it back. */
  _free(pointer: number): void;
}

/** The part of laz-perf that decompresses chunks of points. */
export interface LazPerf extends LazMemory {
  ChunkDecoder: new () => {
    /** Begins with a chunk of compressed points. */
    open(format: number, recordLength: number, pointer: number): void;
    /** Writes the next point to an address. */
    getPoint(pointer: number): void;
    /** Ends the decoder. */
    delete(): void;
  };
}

/** The part of laz-perf that decompresses whole files. */
export interface LazFiles extends LazMemory {
  LASZip: new () => {
    /** Begins with a whole file. */
    open(pointer: number, length: number): void;
    /** Writes the next point to an address. */
    getPoint(pointer: number): void;
    /** Ends the decoder. */
    delete(): void;
  };
}

/** How the points of a chunk are stored. */
export interface ChunkLayout {
  format: number;
  /** The number of bytes of a point. */
  rowBytes: number;
}

/** Decompresses a chunk of points. `take` gets one point after another, in the same memory. */
export function decodeChunk(
  perf: LazPerf,
  chunk: Uint8Array,
  count: number,
  { format, rowBytes }: ChunkLayout,
  take: (point: DataView) => void,
): void {
  const from = perf._malloc(chunk.length);
  const to = perf._malloc(rowBytes);
  const decoder = new perf.ChunkDecoder();
  try {
    perf.HEAPU8.set(chunk, from);
    decoder.open(format, rowBytes, from);
    for (let i = 0; i < count; i++) {
      decoder.getPoint(to);
      take(new DataView(perf.HEAPU8.buffer, to, rowBytes));
    }
  } finally {
    decoder.delete();
    perf._free(from);
    perf._free(to);
  }
}
