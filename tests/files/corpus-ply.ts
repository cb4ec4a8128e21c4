import { bytes, type Case, type Edit, edited, SAME } from "./corpus";
import { binary, plyBody, PLY_FORMATS, plyHeader, POINTS, type Value } from "./valid";

/** Faults of the header. They are the same in text and binary. A bar separates messages. Each of them is right. */
const HEADER_FAULTS: [name: string, edit: Edit, expected: Case["expected"]][] = [
  ["other first word", ["ply", "plyx"], "it does not begin like a PLY file"],
  ["a space before the first word", ["ply", " ply"], "it does not begin like a PLY file"],
  ["no end", ["end_header\n", ""], "|its PLY header has no end|is not a line of a PLY header"],
  ["end with more words", ["end_header", "end_header 1"], "line 11 is not a line of a PLY header"],
  ["unknown line", ["comment", "remark"], 'line 3 is not a line of a PLY header: "remark by a test"'],
  ["no format", [/format.*\n/, ""], "its PLY header gives no format"],
  ["unknown format", [/format \w+/, "format utf8"], "line 2 gives a PLY format that is none of"],
  ["format twice", [/(format.*\n)/, "$1$1"], "line 3 gives the PLY format a second time"],
  ["version 2.0", ["1.0", "2.0"], "line 2 gives a PLY version that is not 1.0"],
  ["no version", [" 1.0", ""], "line 2 gives a PLY version that is not 1.0"],
  ["words behind the version", ["1.0", "1.0 final"], "line 2 gives a PLY version that is not 1.0"],
  ["no vertices", ["element vertex", "element point"], "it is a PLY file without vertices"],
  ["vertices twice", [/(element face)/, "element vertex 1\n$1"], "line 9 names an element a second time"],
  ["faces twice", ["end_header", "element face 0\nend_header"], "line 11 names an element a second time"],
  ["count in words", ["vertex 4", "vertex four"], "line 4 does not give the number of an element"],
  ["count in hexadecimal", ["vertex 4", "vertex 0x4"], "line 4 does not give the number of an element"],
  ["count with an exponent", ["vertex 4", "vertex 4e0"], "line 4 does not give the number of an element"],
  ["count with decimals", ["vertex 4", "vertex 4.0"], "line 4 does not give the number of an element"],
  ["count below zero", ["vertex 4", "vertex -4"], "line 4 does not give the number of an element"],
  ["no count", ["vertex 4", "vertex"], "line 4 does not give the number of an element"],
  ["two counts", ["vertex 4", "vertex 4 5"], "line 4 does not give the number of an element"],
  [
    "count too large for a number",
    ["vertex 4", `vertex ${"9".repeat(30)}`],
    "line 4 does not give the number of an element",
  ],
  ["property of no element", [/(element vertex)/, "property float w\n$1"], "line 4 is a property of no element"],
  ["unknown type", ["float y", "half y"], 'line 6 is a property of unknown type: "property half y"'],
  ["type named like a method of every object", ["float y", "toString y"], "line 6 is a property of unknown type"],
  ["no type", ["property float y", "property y"], "line 6 is a property of unknown type"],
  ["no name", ["float y", "float"], "line 6 does not name one property"],
  ["two names", ["float y", "float y w"], "line 6 does not name one property"],
  ["x twice", ["uchar red", "uchar x"], "line 8 names a property a second time"],
  ["y twice", ["float z", "float y"], "line 7 names a property a second time"],
  ["red twice", ["uchar red", "uchar red\nproperty uchar red"], "line 9 names a property a second time"],
  ["X beside x", ["uchar red", "uchar X"], "its header names x twice"],
  ["Z beside z", ["uchar red", "uchar Z"], "its header names z twice"],
  ["no z", ["float z", "float height"], 'its header names no x, y and z, but "x y height red"'],
  ["no x", ["float x", "float nx"], "its header names no x, y and z"],
  ["axes of two kinds", ["float x", "float px"], "its header names no x, y and z"],
  ["x is a list", ["float x", "list uchar float x"], "the x of its vertices is a list"],
  ["list without type", ["list uchar int", "list uchar"], "line 10 is a property of unknown type"],
  ["list without name", [" vertex_indices", ""], "line 10 does not name one property"],
  [
    "list counted in floats",
    ["list uchar", "list float"],
    "counts the values of a list in a type that is not an integer",
  ],
  ["capitals", [/float ([xyz])/g, "float \u0001$1"], "its header names no x, y and z"],
  [
    "x, y and z as X, Y and Z",
    (text) => text.replace(/float ([xyz])/g, (_, axis: string) => `float ${axis.toUpperCase()}`),
    SAME,
  ],
  ["posx, posy and posz", [/float ([xyz])/g, "float pos$1"], SAME],
  ["px, py and pz", [/float ([xyz])/g, "float p$1"], SAME],
  ["blank line", ["comment", "\n\tcomment"], SAME],
  ["long comment", ["by a test", "by a test ".repeat(5000)], SAME],
  ["comment without end", ["by a test", "by a test ".repeat(200_000)], "its PLY header has no end"],
  ["object information", ["comment", "obj_info"], SAME],
  ["float32 and uint8", (text) => text.replaceAll("float ", "float32 ").replaceAll("uchar ", "uint8 "), SAME],
  ["byte order mark", (text) => `\ufeff${text}`, SAME],
  ["ends of Windows", (text) => text.replaceAll("\n", "\r\n"), SAME],
  ["ends of old Macs", (text) => text.replaceAll("\n", "\r"), SAME],
  ["tabs and blanks", (text) => text.replace("element vertex 4", " element\t vertex  4 "), SAME],
  ["no faces promised", ["face 1", "face 0"], "after the last"],
  ["a face more", ["face 1", "face 2"], "it ends after 1 of the 2 faces that its header promises"],
];

const BODY_FAULTS: [name: string, edit: Edit, expected: Case["expected"]][] = [
  ["a value short", ["1.5 -2 0.25 10", "1.5 -2 10"], 'line 13 has 3 values, and its header promises 4: "1.5 -2 10"'],
  ["a value more", ["1.5 -2 0.25 10", "1.5 -2 0.25 10 1"], "line 13 has 5 values, and its header promises 4"],
  ["a value short in the first row", ["0 0 10 0", "0 0 10"], "line 12 has 3 values, and its header promises 4"],
  ["a value short in the last row", ["-0.5 7 8 30", "7 8 30"], "line 15 has 3 values, and its header promises 4"],
  ["two rows in one line", ["0 0 10 0\n", "0 0 10 0 "], "line 12 has 8 values, and its header promises 4"],
  ["one row in two lines", ["1.5 -2 ", "1.5 -2\n"], "line 13 has 2 values, and its header promises 4"],
  ["word for a number", ["1.5", "one"], 'line 13 is not a point, its x is not a number: "one -2 0.25 10"'],
  ["hexadecimal", ["1.5", "0x10"], "line 13 is not a point, its x is not a number"],
  ["decimal comma", ["1.5", "1,5"], "line 13 is not a point, its x is not a number"],
  ["decimal commas everywhere", (text) => text.replaceAll(".", ","), "line 13 is not a point, its x is not a number"],
  ["separated by commas", ["1.5 -2 0.25 10", "1.5,-2,0.25,10"], "line 13 has 1 values, and its header promises 4"],
  ["typographic minus", ["-2", "\u22122"], "line 13 is not a point, its y is not a number"],
  ["no-break space", ["1.5 -2", "1.5\u00a0-2"], "line 13 has 3 values"],
  ["empty exponent", ["1.5", "1.5e"], "line 13 is not a point, its x is not a number"],
  ["two decimal points", ["1.5", "1.5.0"], "line 13 is not a point, its x is not a number"],
  ["a decimal point alone", ["1.5", "."], "line 13 is not a point, its x is not a number"],
  ["NA", ["1.5", "NA"], "line 13 is not a point, its x is not a number"],
  ["a comment", ["1.5 -2", "# 1.5 -2"], "line 13 has 5 values"],
  ["a point more", ["1.5 -2", "9 9 9 9\n1.5 -2"], "line 16 is a row whose list has a length of -0.5"],
  ["a point short", ["1.5 -2 0.25 10\n", ""], "it ends after 0 of the 1 faces"],
  ["no face", ["3 0 1 2\n", ""], "it ends after 0 of the 1 faces that its header promises"],
  ["a face more", ["3 0 1 2", "3 0 1 2\n3 0 1 3"], "line 17 comes after the last row that the header promises"],
  ["a corner short", ["3 0 1 2", "3 0 1"], "line 16 has 3 values, and its header promises 4"],
  ["corners below zero", ["3 0 1 2", "-3 0 1 2"], "line 16 is a row whose list has a length of -3"],
  ["one and a half corners", ["3 0 1 2", "1.5 0 1 2"], "line 16 is a row whose list has a length of 1.5"],
  ["text behind the end", (text) => `${text}the end\n`, "line 17 comes after the last row"],
  ["nothing", () => "", "it ends after 0 of the 4 vertices that its header promises"],
  ["cut in a row", (text) => text.slice(0, 15), "line 13 has 2 values"],
  ["blank lines", (text) => text.replaceAll("\n", "\n \n"), SAME],
  ["ends of Windows", (text) => text.replaceAll("\n", "\r\n"), SAME],
  ["ends of old Macs", (text) => text.replaceAll("\n", "\r"), SAME],
  ["mixed ends", ["\n", "\r"], SAME],
  ["no last end", (text) => text.trimEnd(), SAME],
  ["tabs", (text) => text.replaceAll(" ", "\t "), SAME],
  ["exponents and signs", ["1.5 -2 0.25", "+15e-1 -2.E+0 .25"], SAME],
  ["zeros at the end", (text) => `${text}\n\n\n`, SAME],
  ["a line without end", ["1.5", `1.5${"0".repeat(1_100_000)}`], "line 13 is longer than 1 MB"],
];

const SIZE = 4 * 13;
const REST_FAULTS: [name: string, edit: (body: Buffer) => Uint8Array, expected: Case["expected"]][] = [
  ["cut in the first vertex", (body) => body.subarray(0, 7), "it ends after 0 of the 4 vertices"],
  ["cut in the last vertex", (body) => body.subarray(0, SIZE - 1), "it ends after 3 of the 4 vertices"],
  ["cut behind the vertices", (body) => body.subarray(0, SIZE), "it ends after 0 of the 1 faces"],
  ["cut in the face", (body) => body.subarray(0, SIZE + 9), "it ends after 0 of the 1 faces"],
  ["nothing", () => new Uint8Array(), "it ends after 0 of the 4 vertices"],
  ["a byte short at the beginning", (body) => body.subarray(1), "it ends after 0 of the 1 faces|it goes on"],
  [
    "a byte more at the end",
    (body) => bytes(body, "x"),
    "it goes on after the last of the faces that its header promises",
  ],
  ["a face more", (body) => bytes(body, body.subarray(SIZE)), "it goes on after the last of the faces"],
  ["zeros at the end", (body) => bytes(body, new Uint8Array(100)), SAME],
  ["an end of a line at the end", (body) => bytes(body, "\r\n"), SAME],
  [
    "a longer list",
    (body) => bytes(body.subarray(0, SIZE), Uint8Array.of(200), body.subarray(SIZE + 1)),
    "it ends after 0 of the 1 faces",
  ],
  ["text for numbers", () => bytes("1.5 2.5 3.5 4"), "it ends after 1 of the 4 vertices"],
];

function headerCases(): Case[] {
  return (["ascii", "little", "big"] as const).flatMap((encoding) =>
    HEADER_FAULTS.filter(
      ([name]) => !(name === "no faces promised" || name === "a face more") || encoding !== "ascii",
    ).map(([name, edit, expected]): Case => ({
      name: `PLY ${encoding}, header: ${name}`,
      file: "fault.ply",
      content: bytes(edited(plyHeader(encoding), edit), plyBody(encoding)),
      expected,
    })),
  );
}

/** Types of x, y and z. Each row has values that all fit the type, or one value that does not. */
const TYPED: [type: string, row: string, expected: Case["expected"]][] = [
  ["uchar", "255 0 7", [255, 0, 7]],
  ["uchar", "256 0 7", "line 8 is not a point, its x is not of type uint8"],
  ["uchar", "-1 0 7", "line 8 is not a point, its x is not of type uint8"],
  ["char", "-128 127 7", [-128, 127, 7]],
  ["char", "0 128 7", "line 8 is not a point, its y is not of type int8"],
  ["short", "0 1.5 7", "line 8 is not a point, its y is not of type int16"],
  ["int", "2147483647 0 -2147483648", [2147483647, 0, -2147483648]],
  ["int", "2147483648 0 0", "line 8 is not a point, its x is not of type int32"],
  ["uint", "4294967295 0 0", [4294967295, 0, 0]],
  ["uint", "0 nan 0", "line 8 is not a point, its y is not of type uint32"],
  // A text keeps its digits.
  ["float", "0.1 nan 16777217", [0.1, NaN, 16777217]],
  ["double", "0.1 -inf 16777217", [0.1, NaN, 16777217]],
  ["double", "nan(ind) 1.#QNAN NaN", [NaN, NaN, NaN]],
  ["double", "0 0 1e999", "is out of range"],
];

function typedCases(): Case[] {
  return TYPED.map(([type, row, expected]) => ({
    name: `PLY ascii, ${type}: ${row}`,
    file: "typed.ply",
    content: bytes(
      `ply\nformat ascii 1.0\nelement vertex 1\n${["x", "y", "z"].map((axis) => `property ${type} ${axis}\n`).join("")}end_header\n${row}\n`,
    ),
    expected,
  }));
}

/** Files with lists in their vertices, and with another element before the vertices. */
function listCases(): Case[] {
  const header = (format: string) =>
    `ply\nformat ${format} 1.0\nelement camera 1\nproperty list uchar float matrix\nproperty uchar id\nelement vertex 2\nproperty list uchar ushort seen\nproperty float x\nproperty float y\nproperty float z\nend_header\n`;
  const body: Value[] = [
    [2, "Uint8"], [0.5, "Float32"], [1, "Float32"], [9, "Uint8"],
    [1, "Uint8"], [500, "Uint16"], ...POINTS[1].map((value): Value => [value, "Float32"]),
    [0, "Uint8"], ...POINTS[2].map((value): Value => [value, "Float32"]),
  ]; // prettier-ignore
  const points = [...POINTS[1], ...POINTS[2]];
  const text = `2 0.5 1 9\n1 500 ${POINTS[1].join(" ")}\n0 ${POINTS[2].join(" ")}\n`;
  const make = (name: string, content: Uint8Array, expected: Case["expected"]): Case => ({
    name: `PLY with lists: ${name}`,
    file: "lists.ply",
    content,
    expected,
  });
  return [
    make("text", bytes(header("ascii"), text), points),
    make(
      "list a value short",
      bytes(header("ascii"), text.replace("1 500 ", "1 ")),
      "line 13 has 4 values, and its header promises 5",
    ),
    make(
      "list a value more",
      bytes(header("ascii"), text.replace("1 500", "1 500 501")),
      "line 13 has 6 values, and its header promises 5",
    ),
    make(
      "list without length",
      bytes(header("ascii"), text.replace("1 500 1.5", "1.5")),
      "line 13 is a row whose list has a length of 1.5",
    ),
    make(
      "camera a value short",
      bytes(header("ascii"), text.replace("2 0.5 1 9", "2 0.5 1")),
      "line 12 has 3 values, and its header promises 4",
    ),
    ...(["little", "big"] as const).flatMap((order) => {
      const rows = binary(body, order === "little");
      const head = header(PLY_FORMATS[order]);
      return [
        make(order, bytes(head, rows), points),
        make(`${order}, cut`, bytes(head, rows.subarray(0, -1)), "it ends after 1 of the 2 vertices"),
        make(
          `${order}, cut in the camera`,
          bytes(head, rows.subarray(0, 5)),
          'it ends after 0 of the 1 "camera" elements|it ends after 0 of the 2 vertices',
        ),
        make(`${order}, a byte more`, bytes(head, rows, "x"), "it goes on after the last of the vertices"),
      ];
    }),
  ];
}

export function plyCases(): Case[] {
  return [
    ...headerCases(),
    ...BODY_FAULTS.map(([name, edit, expected]): Case => ({
      name: `PLY ascii, body: ${name}`,
      file: "fault.ply",
      content: bytes(plyHeader("ascii"), edited(plyBody("ascii").toString(), edit)),
      expected,
    })),
    ...(["little", "big"] as const).flatMap((encoding) =>
      REST_FAULTS.map(([name, edit, expected]): Case => ({
        name: `PLY ${encoding}, body: ${name}`,
        file: "fault.ply",
        content: bytes(plyHeader(encoding), edit(plyBody(encoding))),
        expected,
      })),
    ),
    ...(["little", "big"] as const).map((encoding): Case => ({
      name: `PLY ${encoding}, body in the other order of bytes`,
      file: "fault.ply",
      content: bytes(plyHeader(encoding), plyBody(encoding === "little" ? "big" : "little")),
      expected: `its numbers are ${encoding === "little" ? "big" : "little"}-endian, but its header says the opposite`,
    })),
    ...typedCases(),
    ...listCases(),
  ];
}
