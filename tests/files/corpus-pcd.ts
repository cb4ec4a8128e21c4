import { bytes, type Case, type Edit, edited, SAME } from "./corpus";
import { binary, literals, packed, pcdBody, type PcdEncoding, pcdHeader, POINTS, type Value } from "./valid";

/** Faults of the header. They are the same in text and binary. A bar separates messages. Each of them is right. */
const HEADER_FAULTS: [name: string, edit: Edit, expected: Case["expected"]][] = [
  ["no end", [/DATA.*\n/, ""], "its PCD header has no end|is not a line of a PCD header"],
  [
    "unknown data",
    [/DATA.*/, "DATA octal"],
    "line 11 gives PCD data that is none of ascii, binary and binary_compressed",
  ],
  ["no data", [/DATA.*/, "DATA"], "line 11 gives PCD data that is none of"],
  ["unknown line", ["VIEWPOINT", "VIEWED"], "line 9 is not a line of a PCD header"],
  ["a line misspelled", ["SIZE", "SIZES"], "line 4 is not a line of a PCD header"],
  ["no fields", [/FIELDS.*\n/, ""], "its PCD header has no line FIELDS"],
  ["no sizes", [/SIZE.*\n/, ""], "its PCD header has no line SIZE"],
  ["no types", [/TYPE.*\n/, ""], "its PCD header has no line TYPE"],
  ["fields twice", [/(FIELDS.*\n)/, "$1$1"], "line 4 stands in the PCD header a second time"],
  ["sizes twice", [/(SIZE.*\n)/, "$1SIZE 8 8 8 1\n"], "line 5 stands in the PCD header a second time"],
  ["points twice", [/(POINTS.*\n)/, "$1POINTS 5\n"], "line 11 stands in the PCD header a second time"],
  ["columns beside fields", [/(SIZE)/, "COLUMNS a b c d\n$1"], "line 4 stands in the PCD header a second time"],
  ["a field short", ["x y z intensity", "x y z"], 'line 4 has 4 values for 3 fields: "SIZE 4 4 4 1"'],
  ["a field more", ["x y z intensity", "x y z w intensity"], "line 4 has 4 values for 5 fields"],
  ["a size short", ["4 4 4 1", "4 4 4"], "line 4 has 3 values for 4 fields"],
  ["a size more", ["4 4 4 1", "4 4 4 1 1"], "line 4 has 5 values for 4 fields"],
  ["a type short", ["F F F U", "F F F"], "line 5 has 3 values for 4 fields"],
  ["a count short", ["1 1 1 1", "1 1 1"], "line 6 has 3 values for 4 fields"],
  ["a count more", ["1 1 1 1", "1 1 1 1 1"], "line 6 has 5 values for 4 fields"],
  ["sizes in hexadecimal", ["4 4 4 1", "0x4 4 4 1"], 'line 4 gives x a size that its type does not have: "F 0x4"'],
  ["size of nothing", ["4 4 4 1", "4 0 4 1"], "line 4 gives y a size that its type does not have"],
  ["size of three bytes", ["4 4 4 1", "4 3 4 1"], "line 4 gives y a size that its type does not have"],
  ["float of two bytes", ["4 4 4 1", "4 2 4 1"], 'line 4 gives y a size that its type does not have: "F 2"'],
  ["size below zero", ["4 4 4 1", "-4 4 4 1"], "line 4 gives x a size that its type does not have"],
  ["size with decimals", ["4 4 4 1", "4 4 4.5 1"], "line 4 gives z a size that its type does not have"],
  ["unknown type", ["F F F U", "F F D U"], "line 4 gives z a size that its type does not have"],
  ["no counts below one", ["1 1 1 1", "1 1 1 0"], 'line 6 does not say how many numbers intensity is: "0"'],
  ["count in words", ["1 1 1 1", "1 1 1 one"], "line 6 does not say how many numbers intensity is"],
  ["count in hexadecimal", ["1 1 1 1", "1 1 1 0x1"], "line 6 does not say how many numbers intensity is"],
  ["x is several numbers", ["1 1 1 1", "2 1 1 1"], "the x of its points is 2 numbers"],
  ["x twice", ["intensity", "x"], "line 3 names x twice"],
  ["intensity twice", ["y z intensity", "intensity z intensity"], "line 3 names intensity twice"],
  ["X beside x", ["intensity", "X"], "its header names x twice"],
  ["no z", ["x y z", "x y height"], 'its header names no x, y and z, but "x y height intensity"'],
  ["width times height is less", ["WIDTH 4", "WIDTH 3"], 'line 10 does not give WIDTH times HEIGHT, 3: "POINTS 4"'],
  ["width times height is more", ["HEIGHT 1", "HEIGHT 2"], "line 10 does not give WIDTH times HEIGHT, 8"],
  ["no height", ["HEIGHT 1", "HEIGHT 0"], "line 10 does not give WIDTH times HEIGHT, 0"],
  ["points in hexadecimal", ["POINTS 4", "POINTS 0x4"], 'line 10 is not a number of points: "POINTS 0x4"'],
  ["points with an exponent", ["POINTS 4", "POINTS 4e0"], "line 10 is not a number of points"],
  ["points below zero", ["POINTS 4", "POINTS -4"], "line 10 is not a number of points"],
  ["points without number", ["POINTS 4", "POINTS"], "line 10 is not a number of points"],
  ["two numbers of points", ["POINTS 4", "POINTS 4 4"], "line 10 is not a number of points"],
  ["width in words", ["WIDTH 4", "WIDTH four"], "line 7 is not a number of points"],
  ["height in hexadecimal", ["HEIGHT 1", "HEIGHT 0x1"], "line 8 is not a number of points"],
  ["points beyond all numbers", ["POINTS 4", `POINTS ${"9".repeat(30)}`], "line 10 is not a number of points"],
  [
    "no number of points",
    (text) => text.replace("WIDTH 4\n", "").replace("POINTS 4\n", ""),
    "its PCD header does not say how many points there are",
  ],
  ["no width", ["WIDTH 4\n", ""], SAME],
  ["no points", ["POINTS 4\n", ""], SAME],
  ["no counts", ["COUNT 1 1 1 1\n", ""], SAME],
  ["no version", ["VERSION 0.7\n", ""], SAME],
  ["columns for fields", ["FIELDS", "COLUMNS"], SAME],
  ["small letters", (text) => text.replace("FIELDS", "fields").replace("TYPE F", "type f"), SAME],
  ["an image", (text) => text.replace("WIDTH 4", "WIDTH 2").replace("HEIGHT 1", "HEIGHT 2"), SAME],
  ["a comment more", ["VERSION", "# by a test\n\nVERSION"], SAME],
  ["byte order mark", (text) => `\ufeff${text}`, SAME],
  ["ends of Windows", (text) => text.replaceAll("\n", "\r\n"), SAME],
  ["ends of old Macs", (text) => text.replaceAll("\n", "\r"), SAME],
  ["px, py and pz", ["x y z", "px py pz"], SAME],
];

const BODY_FAULTS: [name: string, edit: Edit, expected: Case["expected"]][] = [
  ["a value short", ["1.5 -2 0.25 10", "1.5 -2 10"], 'line 13 has 3 values, and its header promises 4: "1.5 -2 10"'],
  ["a value more", ["1.5 -2", "1.5 -2 3"], "line 13 has 5 values, and its header promises 4"],
  ["a value short in the last row", ["-0.5 7 8 30", "7 8 30"], "line 15 has 3 values, and its header promises 4"],
  ["word for a number", ["-2", "two"], "line 13 is not a point, its y is not a number"],
  ["hexadecimal", ["10 0\n", "0x10 0\n"], 'line 12 is not a point, its z is not a number: "0 0 0x10 0"'],
  ["decimal comma", ["1.5", "1,5"], "line 13 is not a point, its x is not a number"],
  ["a point more", (text) => `${text}1 2 3 4\n`, "line 16 comes after the last row that the header promises"],
  ["a point short", ["1.5 -2 0.25 10\n", ""], "it ends after 3 of the 4 points that its header promises"],
  ["nothing", () => "", "it ends after 0 of the 4 points"],
  ["text behind the end", (text) => `${text}the end\n`, "line 16 comes after the last row"],
  ["two rows in one line", ["0 0 10 0\n", "0 0 10 0 "], "line 12 has 8 values, and its header promises 4"],
  ["missing values", ["1.5 -2 0.25", "nan NaN -nan"], [...POINTS[0], NaN, NaN, NaN, ...POINTS[2], ...POINTS[3]]],
  ["blank lines", (text) => text.replaceAll("\n", "\n\t\n"), SAME],
  ["ends of Windows", (text) => text.replaceAll("\n", "\r\n"), SAME],
  ["no last end", (text) => text.trimEnd(), SAME],
  ["a line without end", ["1.5", `${" ".repeat(1_100_000)}1.5`], "line 13 is longer than 1 MB"],
];

const REST_FAULTS: [name: string, edit: (body: Buffer) => Uint8Array, expected: Case["expected"]][] = [
  ["cut in the first point", (body) => body.subarray(0, 7), "it ends after 0 of the 4 points that its header promises"],
  ["cut in the last point", (body) => body.subarray(0, 51), "it ends after 3 of the 4 points that its header promises"],
  ["nothing", () => new Uint8Array(), "it ends after 0 of the 4 points"],
  ["a byte more", (body) => bytes(body, "x"), "it goes on after the last of the points that its header promises"],
  ["a point more", (body) => bytes(body, body.subarray(0, 13)), "it goes on after the last of the points"],
  ["zeros at the end", (body) => bytes(body, new Uint8Array(4096)), SAME],
  ["an end of a line at the end", (body) => bytes(body, "\n"), SAME],
];

const plain = binary(
  POINTS.flatMap((point) => point.map((value): Value => [value, "Float32"])),
  true,
);
const PACKED_FAULTS: [name: string, content: Uint8Array, expected: Case["expected"]][] = [
  ["nothing", new Uint8Array(), "it ends after 0 of the 4 points"],
  ["cut in its lengths", packed(literals(plain), 52).subarray(0, 7), "it ends after 0 of the 4 points"],
  ["cut in its data", pcdBody("binary_compressed").subarray(0, 40), "it ends after 0 of the 4 points"],
  [
    "longer than promised",
    packed(literals(Buffer.alloc(53)), 53),
    "its compressed data is 53 bytes long, and its header promises 52",
  ],
  [
    "shorter than promised",
    packed(literals(plain), 48),
    "its compressed data is 48 bytes long, and its header promises 52",
  ],
  ["less in it than promised", packed(literals(plain), 52), "its compressed data is damaged"],
  ["more in it than promised", packed(literals(Buffer.alloc(53)), 52), "its compressed data is damaged"],
  ["a run that is cut", packed(Uint8Array.of(31, 1, 2), 52), "its compressed data is damaged"],
  [
    "a copy from before the beginning",
    packed(Uint8Array.of(0x20, 9, 0x20, 9, 0xff, 0xff, 0xff), 52),
    "its compressed data is damaged",
  ],
  ["a copy that is cut", packed(Uint8Array.of(0, 7, 0xe0, 40), 52), "its compressed data is damaged"],
  [
    "a length beyond all memory",
    packed(Uint8Array.of(0, 7), 0xffffffff),
    "its compressed data is 4294967295 bytes long",
  ],
  ["bytes behind it", bytes(pcdBody("binary_compressed"), "x"), "it goes on after the last of the points"],
  ["zeros behind it", bytes(pcdBody("binary_compressed"), new Uint8Array(9)), SAME],
  ["all zeros, by one copy of itself", packed(Uint8Array.of(0, 0, 0xe0, 42, 0), 52), new Array<number>(12).fill(0)],
  [
    "1 and 2 by turns, by a copy of eight bytes before",
    packed(Uint8Array.of(7, 0, 0, 128, 63, 0, 0, 0, 64, 0xe0, 35, 7), 52),
    [1, 1, 1, 2, 2, 2, 1, 1, 1, 2, 2, 2],
  ],
];

/** Types of x, y and z. Three numbers of another type lie between x and y. */
function typedCases(): Case[] {
  const types: [letter: string, size: number, values: readonly number[], write: (view: DataView, at: number, value: number) => void][] = [
    ["I", 1, [-128, 127, 0], (view, at, value) => { view.setInt8(at, value); }],
    ["U", 1, [255, 1, 0], (view, at, value) => { view.setUint8(at, value); }],
    ["I", 2, [-32768, 1, 0], (view, at, value) => { view.setInt16(at, value, true); }],
    ["U", 2, [65535, 1, 0], (view, at, value) => { view.setUint16(at, value, true); }],
    ["I", 4, [-2147483648, 1, 0], (view, at, value) => { view.setInt32(at, value, true); }],
    ["U", 4, [4294967295, 1, 0], (view, at, value) => { view.setUint32(at, value, true); }],
    ["I", 8, [-(2 ** 53), 1, 0], (view, at, value) => { view.setBigInt64(at, BigInt(value), true); }],
    ["U", 8, [2 ** 53, 1, 0], (view, at, value) => { view.setBigUint64(at, BigInt(value), true); }],
    ["F", 4, [0.25, 1e-3, 1e30].map(Math.fround), (view, at, value) => { view.setFloat32(at, value, true); }],
    ["F", 8, [0.1, 1e-3, 512345.6789], (view, at, value) => { view.setFloat64(at, value, true); }],
  ]; // prettier-ignore
  return types.map(([letter, size, values, write]) => {
    const header = `FIELDS _ x _ y z\nSIZE 2 ${size} 1 ${size} ${size}\nTYPE U ${letter} U ${letter} ${letter}\nCOUNT 2 1 3 1 1\nWIDTH 1\nHEIGHT 1\nDATA binary\n`;
    const body = Buffer.alloc(7 + 3 * size);
    const view = new DataView(body.buffer, body.byteOffset, body.length);
    [4, 7 + size, 7 + 2 * size].forEach((at, axis) => {
      write(view, at, values[axis]!);
    });
    return { name: `PCD of ${letter}${8 * size}`, file: "typed.pcd", content: bytes(header, body), expected: values };
  });
}

export function pcdCases(): Case[] {
  const make = (name: string, encoding: PcdEncoding, content: Uint8Array, expected: Case["expected"]): Case => ({
    name: `PCD ${encoding}, ${name}`,
    file: "fault.pcd",
    content,
    expected,
  });
  return [
    ...(["ascii", "binary", "binary_compressed"] as const).flatMap((encoding) =>
      HEADER_FAULTS.map(([name, edit, expected]) =>
        make(`header: ${name}`, encoding, bytes(edited(pcdHeader(encoding), edit), pcdBody(encoding)), expected),
      ),
    ),
    ...BODY_FAULTS.map(([name, edit, expected]) =>
      make(`body: ${name}`, "ascii", bytes(pcdHeader("ascii"), edited(pcdBody("ascii").toString(), edit)), expected),
    ),
    ...REST_FAULTS.map(([name, edit, expected]) =>
      make(`body: ${name}`, "binary", bytes(pcdHeader("binary"), edit(pcdBody("binary"))), expected),
    ),
    ...PACKED_FAULTS.map(([name, content, expected]) =>
      make(`body: ${name}`, "binary_compressed", bytes(pcdHeader("binary_compressed"), content), expected),
    ),
    ...typedCases(),
  ];
}
