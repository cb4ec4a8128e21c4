import type { ChosenColumns } from "../../src/ts/formats/axes";
import { bytes, type Case, SAME } from "./corpus";
import { POINTS, table } from "./valid";

const SPACED = table(" ");
const COMMAS = table(",");
/** Each point has its number before it and a time after it. */
const NUMBERED = POINTS.map((point, i) => [i + 1, ...point, 0.5 * i]);
const commas = (text: string) => text.replaceAll(".", ",");
const withFirst = (x: number) => [x, ...SAME.slice(1)];

const numberedFrom = (first: number, more: readonly number[] = []) =>
  POINTS.map((point, i) => [first + i, ...point, ...more]);
const two = NUMBERED.slice(0, 2);
const leftOut = NUMBERED.filter((_, i) => i !== 1);
const grid = [0, 1, 2, 3].map((x) => [x, 7, 0.5 * x, 12]);
const colored = [1, 2, 3, 4].map((x) => [x, 2 * x, 3 * x, 255, 128, x]);

type Row = [name: string, content: string | Uint8Array, expected: Case["expected"], columns?: ChosenColumns];

const DEGREES = "names longitude and latitude: degrees must be projected to meters first";
const NO_NAMES = "is neither three numbers nor names of columns x, y and z";

const ROWS: Row[] = [
  ["spaces", SPACED, SAME],
  ["tabs", table("\t"), SAME],
  ["several spaces", table("   "), SAME],
  ["commas", COMMAS, SAME],
  ["commas and spaces", table(", "), SAME],
  ["semicolons", table(";"), SAME],
  ["spaces at the beginning", SPACED.replace(/^/gm, "  "), SAME],
  ["a comma at the end of each line", COMMAS.replaceAll("\n", ",\n"), [...SAME]],
  ["no last end", SPACED.trimEnd(), SAME],
  ["ends of Windows", SPACED.replaceAll("\n", "\r\n"), SAME],
  ["ends of old Macs", SPACED.replaceAll("\n", "\r"), SAME],
  ["mixed ends", SPACED.replace("\n", "\r").replace("\n", "\r\n"), SAME],
  ["byte order mark", `\ufeff${SPACED}`, SAME],
  ["byte order mark before names", `\ufeffx,y,z\n${COMMAS}`, SAME],
  ["blank lines", SPACED.replaceAll("\n", "\n\n \n"), SAME],
  ["comments between", SPACED.replaceAll("\n", "\n# one more\n// another\n"), SAME],
  ["exponents", "1e1 2E-1 -3.5e+0\n", [10, 0.2, -3.5]],
  ["points without digits behind", "1. .5 -.25\n", [1, 0.5, -0.25]],
  ["numbers of many digits", "512345.678901 5403210.123456 1\n", [512345.678901, 5403210.123456, 1]],
  ["missing words of C libraries", "nan -inf Infinity\n1 2 3\n", [NaN, NaN, NaN, 1, 2, 3]],
  ["missing words of Windows", "1.#QNAN -1.#IND 1.#INF\n1 2 3\n", [NaN, NaN, NaN, 1, 2, 3]],
  ["number beyond all numbers", "1e999 0 0\n1 2 3\n", "line 1 has a number out of range in column 1"],
  [
    "more columns",
    table(
      " ",
      POINTS.map((point) => [...point, 7, "a"]),
    ),
    SAME,
  ],

  ["decimal commas and spaces", commas(SPACED), SAME],
  ["decimal commas and tabs", commas(table("\t")), SAME],
  ["decimal commas and semicolons", commas(table(";")), SAME],
  ["decimal commas in quotation marks", '"1,5","2,5","3,5"\n', [1.5, 2.5, 3.5]],
  ["decimal commas below names", `x;y;z\n${commas(table(";"))}`, SAME],
  [
    "decimal commas and commas",
    "1,5,2,5,3,5\n1,5,2,5,3\n",
    "line 2 is not a point, it has 5 columns and lines above have 6",
  ],
  ["decimal commas and commas with spaces", "1,5, 2,5, 3,5\n", "line 1 has commas that may divide numbers or decimals"],
  ["decimals of commas between commas", "1,05,2,07,3,00\n", "line 1 has commas that may divide numbers or decimals"],
  ["decimal commas and commas below names", "x,y,z\n1,5,2,5,3,5\n", "line 2 has 6 columns, and line 1 names 3"],
  [
    "decimal commas and points",
    "1,5;2,5;3\n1.5;2;3\n",
    "line 2 has both decimal points and decimal commas with line 1",
  ],
  [
    "decimal commas and points in one line",
    "1,5;2.5;3\n",
    "line 1 has both decimal points and decimal commas with line 1",
  ],
  ["thousands", "1,234.5;2;3\n", `line 1 ${NO_NAMES}`],
  ["thousands in later lines", "1;2;3\n1.234,5;2;3\n", "line 2 is not a point, its column 1 is not a number"],

  ["names", `x y z\n${SPACED}`, SAME],
  ["names in capitals", `X,Y,Z\n${COMMAS}`, SAME],
  ["names in quotation marks", `"x","y","z"\n${COMMAS}`, SAME],
  ["names with brackets", `X [m],Y [m],Z [m]\n${COMMAS}`, SAME],
  ["names with units", `x_m,y_m,z_m\n${COMMAS}`, SAME],
  ["names with units, others before", `id,x_m,y_m,z_m,t\n${table(",", NUMBERED)}`, SAME],
  ["ids beside E, N and H", `Nr,E,N,H,Time\n${table(",", NUMBERED)}`, SAME],
  ["easting, northing, height", `Id,Easting,Northing,Height,Time\n${table(",", NUMBERED)}`, SAME],
  ["east, north, altitude", `id;East;North;Altitude;t\n${table(";", NUMBERED)}`, SAME],
  ["names of ParaView", `"id","Points:0","Points:1","Points:2","t"\n${table(",", NUMBERED)}`, SAME],
  ["names with coordinate", `id,x_coord,y_coord,z_coord,t\n${table(",", NUMBERED)}`, SAME],
  [
    "names in another order",
    `z,t,y,x\n${table(
      ",",
      POINTS.map(([x, y, z]) => [z, 9, y, x]),
    )}`,
    SAME,
  ],
  ["names between tabs", `Point id\tX\tY\tZ\tGPS time\n${table("\t", NUMBERED)}`, SAME],
  ["empty words between tabs", `id\tx\ty\tz\tt\n${table("\t", NUMBERED).replace("1\t", "\t")}`, SAME],
  ["names between spaces, points between commas", `x y z\n${COMMAS}`, SAME],
  ["blank line below the names", `id,x,y,z,t\n\n${table(",", NUMBERED)}`, SAME],
  ["comment below the names", `id,x,y,z,t\n# by a test\n${table(",", NUMBERED)}`, SAME],
  ["comment above the names", `# by a test, 2020\nid,x,y,z,t\n${table(",", NUMBERED)}`, SAME],
  ["units below the names", `id,x,y,z,t\n,m,m,m,s\n${table(",", NUMBERED)}`, SAME],
  ["units in brackets below the names", `id;x;y;z;t\n[-];[m];[m];[m];[s]\n${table(";", NUMBERED)}`, SAME],
  ["NA in the first row", `id,x,y,z,t\n1,NA,NA,NA,0\n${table(",", NUMBERED)}`, [NaN, NaN, NaN, ...SAME]],
  ["NA for x in the first row", `id,x,y,z,t\n1,NA,5,6,0\n${table(",", NUMBERED)}`, [NaN, 5, 6, ...SAME]],
  ["nothing for x in the first row", `id,x,y,z,t\n1,,5,6,0\n${table(",", NUMBERED)}`, [NaN, 5, 6, ...SAME]],
  ["NA and null later", `x,y,z\n${COMMAS}NA,null,N/A\n`, [...SAME, NaN, NaN, NaN]],
  ["NA without names", `NA NA NA\n${SPACED}`, [NaN, NaN, NaN, ...SAME]],
  [
    "words in another column",
    `name,x,y,z\n${table(
      ",",
      POINTS.map((point, i) => [`"p, ${i}"`, ...point]),
    )}`,
    SAME,
  ],
  ["doubled quotation marks", `name,x,y,z\n"say ""p"", please",1,2,3\n`, [1, 2, 3]],
  ["names in a comment", `# id x y z t\n${table(" ", NUMBERED)}`, SAME],
  ["names in a comment of C", `//X [m] Y [m] Z [m]\n${SPACED}`, SAME],
  ["names in a comment behind a word", `# columns: id x y z t\n${table(" ", NUMBERED)}`, SAME],
  ["names in a comment, another below", `# id x y z t\n# by a test\n${table(" ", NUMBERED)}`, SAME],
  [
    "fewer names in a comment",
    `# x y z\n${table(
      " ",
      POINTS.map((point) => [...point, 1, 2]),
    )}`,
    SAME,
  ],

  ["a second line of words", `id,x,y,z,t\nabc,def,ghi,jkl,mno\n${table(",", NUMBERED)}`, "line 2 is not a point"],
  ["two lines of units", `x,y,z\nm,m,m\nm,m,m\n${COMMAS}`, "line 3 is not a point"],
  ["degrees below the names", `x,y,z\ndeg,deg,m\n${COMMAS}`, "line 2 is not a point"],
  ["a name more", `id,x,y,z\n${COMMAS}`, "line 2 has 3 columns, and line 1 names 4"],
  ["a name less", `x,y,z\n${table(",", NUMBERED)}`, "line 2 has 5 columns, and line 1 names 3"],
  ["other names", `id,time,a,b,c\n${table(",", NUMBERED)}`, `line 1 ${NO_NAMES}: "id,time,a,b,c"`],
  ["other names for three columns", `a,b,c\n${COMMAS}`, `line 1 ${NO_NAMES}`],
  ["degrees", `lon,lat,height\n${COMMAS}`, `line 1 ${DEGREES}`],
  ["degrees in full", `id;Latitude [deg];Longitude [deg];alt;t\n${table(";", NUMBERED)}`, `line 1 ${DEGREES}`],
  ["degrees in a comment", `# lon lat alt\n${SPACED}`, `line 1 ${DEGREES}`],
  ["degrees that are chosen", `lon,lat,alt\n${COMMAS}`, SAME, ["lon", "lat", "alt"]],
  ["degrees beside x, y and z", `lon,x,y,z,lat\n${table(",", NUMBERED)}`, SAME],
  ["only a latitude", `lat,time,height\n${COMMAS}`, `line 1 ${NO_NAMES}`],
  ["only two axes", `id,x,y,w,t\n${table(",", NUMBERED)}`, `line 1 ${NO_NAMES}`],
  ["x twice", `x,x,y,z,t\n${table(",", NUMBERED)}`, 'its columns 1 and 2 are names of the same axis: "x x y z t"'],
  ["x and X", `x,X,y,z,t\n${table(",", NUMBERED)}`, "its columns 1 and 2 are names of the same axis"],
  [
    "x beside easting",
    `easting,x,northing,height,t\n${table(",", NUMBERED)}`,
    "its columns 2 and 1 are names of the same axis",
  ],
  ["easting beside x, y and z", `easting,x,y,z,t\n${table(",", NUMBERED)}`, SAME],
  [
    "names with other units",
    `id,x_m,y_m,z_mm,t\n${table(",", NUMBERED)}`,
    'its x, y and z are in different units: "m mm"',
  ],
  [
    "names with other units in brackets",
    `x [m],y [m],z [ft]\n${COMMAS}`,
    'its x, y and z are in different units: "m ft"',
  ],
  ["names with one unit in two words", `x (m),y (meters),z\n${COMMAS}`, SAME],
  ["other units below the names", `x,y,z\nm,m,mm\n${COMMAS}`, 'its x, y and z are in different units: "m mm"'],
  [
    "two heights",
    `east,north,height,elevation,t\n${table(",", NUMBERED)}`,
    "its columns 3 and 4 are names of the same axis",
  ],
  ["z beside a height", `height,x,y,z,t\n${table(",", NUMBERED)}`, SAME],
  [
    "other names in a comment",
    `# timestamp tx ty tz q\n${table(" ", NUMBERED)}`,
    "line 1 may name the columns, but not which are x, y and z",
  ],
  [
    "a part of the names in a comment",
    `# id x y z\n${table(" ", NUMBERED)}`,
    "line 1 names 4 columns, and the points have 5",
  ],
  ["a title", `Scan of my room\n${SPACED}`, `line 1 ${NO_NAMES}`],
  ["a letter", "Dear all,\n\nthank you for 3 nice days.\n", `line 1 ${NO_NAMES}`],
  ["names alone", "x,y,z\n", "it has no line of three numbers"],
  ["names twice", `x,y,z\n${COMMAS}x,y,z\n${COMMAS}`, "line 6 is not a point, its column 1 is not a number"],
  ["nothing", "", "it has no line of three numbers|no line"],
  ["blanks alone", "\n \n\t\n", "it has no line of three numbers"],
  ["comments alone", "# a\n# b\n", "it has no line of three numbers"],
  ["two columns", "1 2\n3 4\n", `line 1 ${NO_NAMES}`],

  [
    "a value short",
    SPACED.replace("-2 ", ""),
    'line 2 is not a point, it has 2 columns and lines above have 3: "1.5 0.25"',
  ],
  ["a value more", SPACED.replace("-2", "-2 -2"), "line 2 is not a point, it has 4 columns and lines above have 3"],
  [
    "a column short, in the others",
    table(" ", NUMBERED).replace(" 0.5\n", "\n"),
    "line 2 is not a point, it has 4 columns and lines above have 5",
  ],
  ["an empty word for y", COMMAS.replace("-2", ""), [...SAME.slice(0, 4), NaN, ...SAME.slice(5)]],
  ["a word for y", SPACED.replace("-2", "two"), "line 2 is not a point, its column 2 is not a number"],
  ["hexadecimal", SPACED.replace("1.5", "0x10"), "line 2 is not a point, its column 1 is not a number"],
  ["hexadecimal in the first line", SPACED.replace("0", "0x10"), `line 1 ${NO_NAMES}`],
  ["typographic minus", SPACED.replace("-2", "\u22122"), "line 2 is not a point, its column 2 is not a number"],
  ["a blank that is none", SPACED.replace("1.5 ", "1.5\u00a0"), "line 2 is not a point, it has 2 columns"],
  ["a blank that is none for y", COMMAS.replace("-2", "\u00a0"), "line 2 is not a point, its column 2 is not a number"],
  ["another separator", COMMAS.replace("1.5,-2,0.25", "1.5 -2 0.25"), "line 2 is not a point, it has 1 columns"],
  ["a semicolon among commas", COMMAS.replace("1.5,-2", "1.5;-2"), "line 2 is not a point"],
  ["a quotation mark without end", `x,y,z\n"1,2,3\n`, "line 2 has a quotation mark without an end"],
  ["a comment behind a point", SPACED.replace("0.25", "0.25 # here"), "line 2 is not a point, it has 5 columns"],
  [
    "a word before the first point",
    `p ${SPACED}`,
    "line 1 is not a point, its column 1 is not a number|line 1 is neither|line 2",
  ],
  ["words before all points", SPACED.replace(/^/gm, "p "), "line 1 is not a point, its column 1 is not a number"],
  ["a line without end", `${SPACED}${" ".repeat(1_100_000)}1 2 3\n`, "line 5 is longer than 1 MB"],
  ["one line of all numbers", `${"1.5 ".repeat(400_000)}\n`, "line 1 is longer than 1 MB"],
  ["binary", Uint8Array.of(1, 2, 3, 0, 5, 6), "it is not text|is not a point cloud that this page knows"],
  ["a byte that is no letter", bytes("x,y,z,caf", Uint8Array.of(0xe9), "\n1,2,3,4\n"), [1, 2, 3]],
  ["a letter of two bytes, one of them a blank in Latin-1", "x y z \u00e0\n1 2 3 4\n", [1, 2, 3]],
  [
    "a command to the terminal",
    "1 2 3\n\u001b[2Jx y z\n",
    'line 2 is not a point, its column 1 is not a number: "?[2Jx y z"|is not a point cloud|it is not text',
  ],

  ["the number of points above", `4\n${SPACED}`, SAME],
  ["the number of points above, too small", `3\n${SPACED}`, "line 1 promises 3 points, and there are 4"],
  ["the number of points above, too large", `5\n${SPACED}`, "line 1 promises 5 points, and there are 4"],
  // The page takes the two counts for those of PTX.
  ["the number of points twice", `4\n4\n${SPACED}`, `line 2 ${NO_NAMES}|after 6 of the 10 lines above a scan`],
  ["the number of points between", `4\n${SPACED}4\n${SPACED}`, "line 6 is not a point, it has 1 columns"],
  ["the number of points and names", `4\nx y z\n${SPACED}`, SAME],
  ["atoms", "2\nwater\nO 0 0 0\nH 0 0 1\n", `line 2 ${NO_NAMES}`],

  ["numbers of points without names", table(" ", NUMBERED), SAME],
  ["numbers of points from 1001 on, before colors", table(",", numberedFrom(1001, [200, 100, 0])), SAME],
  ["numbers of points below a comment", `# by a test\n\n${table("\t", numberedFrom(0))}`, SAME],
  ["numbers of points of which one is missing", table(" ", leftOut), leftOut.flatMap((row) => row.slice(0, 3))],
  ["numbers of two points", table(" ", two), two.flatMap((row) => row.slice(0, 3))],
  ["x along a row of a grid", table(" ", grid), grid.flatMap((row) => row.slice(0, 3))],
  ["x that counts, with colors", table(" ", colored), colored.flatMap((row) => row.slice(0, 3))],
  ["numbers and two coordinates", "1 5 6\n2 7 8\n3 9 1\n", [1, 5, 6, 2, 7, 8, 3, 9, 1]],

  ["columns by number", table(" ", NUMBERED), SAME, ["2", "3", "4"]],
  ["columns by number, in another order", SPACED, POINTS.flatMap(([x, y, z]) => [z, x, y]), ["3", "1", "2"]],
  ["columns by number below other names", `a,b,c,d,e\n${table(",", NUMBERED)}`, SAME, ["2", "3", "4"]],
  ["columns by number below a title", `A title\n${table(" ", NUMBERED)}`, SAME, ["2", "3", "4"]],
  [
    "columns by number below too many lines",
    `A title\nand\nthree lines\n${SPACED}`,
    "line 3 is not a point",
    ["1", "2", "3"],
  ],
  ["columns by number beyond the last", SPACED, "line 3 is not a point", ["1", "2", "4"]],
  ["columns by name", `a,b,c,d,e\n${table(",", NUMBERED)}`, SAME, ["b", "c", "d"]],
  ["columns by name in capitals", `A,B,C,D,E\n${table(",", NUMBERED)}`, SAME, ["b", "c", "d"]],
  ["columns by name and number", `a,b,c,d,e\n${table(",", NUMBERED)}`, SAME, ["b", "3", "d"]],
  ["columns against the names", `x,y,z\n${COMMAS}`, POINTS.flatMap(([x, y, z]) => [z, y, x]), ["z", "y", "x"]],
  ["columns named twice", `a,b,c,d,d\n${table(",", NUMBERED)}`, "its header names d twice", ["b", "c", "d"]],
  ["columns that are not there", `a,b,c\n${COMMAS}`, 'it has no column named "w", but "a b c"', ["a", "b", "w"]],
  ["columns without names", SPACED, "it names no columns a, b, c", ["a", "b", "c"]],
  ["columns in a comment", `# a b c d e\n${table(" ", NUMBERED)}`, SAME, ["b", "c", "d"]],
];

/** Spellings of a first number, and its value. If the value is undefined, the spelling is not a coordinate. */
const NUMBERS: [word: string, value: number | undefined][] = [
  ["+7", 7],
  ["007", 7],
  ["-0", -0],
  ["1e-400", 0],
  ["7e", undefined],
  ["e7", undefined],
  ["--7", undefined],
  ["+-7", undefined],
  ["7-", undefined],
  ["7f", undefined],
  ["0b11", undefined],
  ["0o17", undefined],
  ["0x1F", undefined],
  ["1_000", undefined],
  ["1d5", undefined],
  ["1.5.2", undefined],
  ["1:2", undefined],
  ["½", undefined],
  ["٣", undefined],
  ["７", undefined],
  ["∞", undefined],
  ["true", undefined],
  ["infinite", undefined],
  ["nano", undefined],
  ["nan()", NaN],
  ["7%", undefined],
  ["$7", undefined],
  ["'7'", undefined],
  ["(7)", undefined],
];

export function tableCases(): Case[] {
  const rows = ROWS.map(([name, content, expected, columns]): Case => ({
    name: `table: ${name}`,
    file: name.includes("names") ? "table.csv" : "table.txt",
    content: bytes(content),
    expected,
    ...(columns ? { columns } : {}),
  }));
  const numbers = NUMBERS.map(([word, value]): Case => ({
    name: `table: the number ${word}`,
    file: "number.xyz",
    content: bytes(`x y z\n${word} ${SPACED.slice(2)}`),
    expected: value === undefined ? "line 2 is not a point" : withFirst(value),
  }));
  return [...rows, ...numbers];
}
