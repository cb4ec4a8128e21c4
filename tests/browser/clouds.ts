/*
 * Small clouds, and writers for the file formats that the page opens. Coordinates are written in full, so that reading
 * them gives the same bits.
 */

/** Points on a bumpy ball around the origin, the same every time. */
export function ball(count: number): Float32Array {
  const positions = new Float32Array(3 * count);
  for (let i = 0; i < count; i++) {
    const up = 1 - (2 * (i + 0.5)) / count;
    const turn = i * Math.PI * (3 - Math.sqrt(5));
    const radius = (2 + 0.2 * Math.sin(7 * turn)) * Math.sqrt(1 - up * up);
    positions.set([radius * Math.cos(turn), 2 * up, radius * Math.sin(turn)], 3 * i);
  }
  return positions;
}

/** The same ball somewhere in UTM coordinates, to a tenth of a millimeter: far too fine for f32. */
export function georeferencedBall(count: number): Float64Array {
  return Float64Array.from(ball(count), (value, i) => {
    const offset = [512_345.5, 5_403_210.25, 431.75][i % 3]!;
    return Math.round((offset + value) * 1e4) / 1e4;
  });
}

export function rows(positions: ArrayLike<number>): number[][] {
  return Array.from({ length: positions.length / 3 }, (_, i) => [
    positions[3 * i]!,
    positions[3 * i + 1]!,
    positions[3 * i + 2]!,
  ]);
}

export function text(content: string): Uint8Array {
  return new TextEncoder().encode(content);
}

/** UTF-16 after a byte order mark, like some spreadsheets write it. */
export function utf16(content: string): Uint8Array {
  return new Uint8Array(Buffer.from(`\ufeff${content}`, "utf16le"));
}

function joined(...parts: Uint8Array[]): Uint8Array {
  return new Uint8Array(Buffer.concat(parts));
}

function numbers(values: ArrayLike<number>, bytes: 4 | 8, littleEndian = true): Uint8Array {
  const view = new DataView(new ArrayBuffer(bytes * values.length));
  for (let i = 0; i < values.length; i++) {
    if (bytes === 4) view.setFloat32(4 * i, values[i]!, littleEndian);
    else view.setFloat64(8 * i, values[i]!, littleEndian);
  }
  return new Uint8Array(view.buffer);
}

function plyHeader(format: string, type: string, count: number, more = "", end = "\n"): string {
  const axes = ["x", "y", "z"].map((axis) => `property ${type} ${axis}`);
  return [
    "ply",
    `format ${format} 1.0`,
    `element vertex ${count}`,
    ...axes,
    ...(more ? [more] : []),
    "end_header",
    "",
  ].join(end);
}

export function asciiPly(positions: ArrayLike<number>, claimed = positions.length / 3): Uint8Array {
  return text(
    plyHeader("ascii", "float", claimed) +
      rows(positions)
        .map((row) => row.join(" "))
        .join("\n") +
      "\n",
  );
}

/** A mesh whose faces have their own colors, in a file with Windows line ends. */
export function meshPly(positions: ArrayLike<number>): Uint8Array {
  const faces =
    "element face 2\r\nproperty list uchar int vertex_indices\r\nproperty uchar red\r\nproperty uchar green\r\nproperty uchar blue";
  const body = [...rows(positions).map((row) => row.join(" ")), "3 0 1 2 255 0 0", "3 2 1 3 0 255 0", ""].join("\r\n");
  return text(plyHeader("ascii", "float", positions.length / 3, faces, "\r\n") + body);
}

export function binaryPly(positions: ArrayLike<number>, type: "float" | "double", littleEndian: boolean): Uint8Array {
  const format = littleEndian ? "binary_little_endian" : "binary_big_endian";
  return joined(
    text(plyHeader(format, type, positions.length / 3)),
    numbers(positions, type === "float" ? 4 : 8, littleEndian),
  );
}

export function pcd(positions: ArrayLike<number>, kind: "ascii" | "binary" | "binary_compressed"): Uint8Array {
  const count = positions.length / 3;
  const header = text(
    ["# .PCD v0.7 - Point Cloud Data file format", "VERSION 0.7", "FIELDS x y z", "SIZE 4 4 4", "TYPE F F F", "COUNT 1 1 1", `WIDTH ${count}`, "HEIGHT 1", "VIEWPOINT 0 0 0 1 0 0 0", `POINTS ${count}`, `DATA ${kind}`, ""].join("\n"),
  ); // prettier-ignore
  if (kind === "ascii") {
    return joined(
      header,
      text(
        rows(positions)
          .map((row) => row.join(" "))
          .join("\n") + "\n",
      ),
    );
  }
  if (kind === "binary") return joined(header, numbers(positions, 4));
  // Compressed files are sorted by field: all x, all y, all z.
  const fields = [0, 1, 2].map((axis) =>
    numbers(
      rows(positions).map((row) => row[axis]!),
      4,
    ),
  );
  const plain = joined(...fields);
  const packed = literalLzf(plain);
  return joined(header, new Uint8Array(Uint32Array.of(packed.length, plain.length).buffer), packed);
}

/** LZF without compression: runs of up to 32 bytes. The length minus one comes before each run. */
function literalLzf(plain: Uint8Array): Uint8Array {
  const parts: Uint8Array[] = [];
  for (let i = 0; i < plain.length; i += 32) {
    const run = plain.subarray(i, i + 32);
    parts.push(Uint8Array.of(run.length - 1), run);
  }
  return joined(...parts);
}

/** A mesh with normals and a name. Its faces leave out most vertices. */
export function meshObj(positions: ArrayLike<number>): Uint8Array {
  const vertices = rows(positions).map((row) => `v ${row.join(" ")}`);
  return text(["# a ball", "o ball", ...vertices, "vn 0 0 1", "f 1//1 2//1 3//1", "f 3//1 2//1 4//1", ""].join("\n"));
}
