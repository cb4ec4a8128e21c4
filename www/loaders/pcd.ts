import { PCDLoader } from "three/addons/loaders/PCDLoader.js";
import type { LoadedCloud } from "../cloud.ts";
import { pointsOf } from "./geometry.ts";
import { checkPointCount } from "./limits.ts";
import { LoadProblem } from "./problem.ts";

/**
 * PCDLoader, with the header read and written anew first: the loader trips over Windows line ends and double spaces,
 * knows colors only as "rgb", and does not notice a file that ends early.
 */
export function readPcd(name: string, data: ArrayBuffer): LoadedCloud {
  const broken = (why: string) => new LoadProblem(`${name} is broken: ${why}.`);

  // Latin-1 keeps one character a byte, so that a position in the text is a position in the file.
  const start = new TextDecoder("latin1").decode(new Uint8Array(data, 0, Math.min(data.byteLength, 1 << 16)));
  const match = /^([\s\S]*?(?:^|[\r\n])DATA[ \t]+(\w+)[ \t]*)(\r\n|\r|\n|$)/i.exec(start);
  if (!match) throw broken("its PCD header has no end");
  const kind = match[2]!.toLowerCase();
  if (kind !== "ascii" && kind !== "binary" && kind !== "binary_compressed") {
    throw new LoadProblem(`${name} is a PCD file of an unknown kind (${match[2]}).`);
  }

  const header = new Map<string, string[]>();
  for (const line of match[1]!.split(/[\r\n]+/)) {
    const words = line.trim().split(/\s+/);
    if (words[0] && !words[0].startsWith("#")) header.set(words[0].toUpperCase(), words.slice(1));
  }
  const fields = header.get("FIELDS") ?? header.get("COLUMNS") ?? [];
  const size = (header.get("SIZE") ?? []).map(Number);
  const type = header.get("TYPE") ?? [];
  const count = header.has("COUNT") ? header.get("COUNT")!.map(Number) : fields.map(() => 1);
  const points = header.has("POINTS") ? Number(header.get("POINTS")![0]) : Number(header.get("WIDTH")?.[0]) * Number(header.get("HEIGHT")?.[0]);
  if (!["x", "y", "z"].every((axis) => fields.includes(axis))) throw broken("its PCD header names no x, y and z");
  if (size.length !== fields.length || type.length !== fields.length || count.length !== fields.length) {
    throw broken("the lines of its PCD header do not match");
  }
  if (!Number.isInteger(points) || points < 0) throw broken("its PCD header does not say how many points there are");
  checkPointCount(name, points);

  const endsEarly = () => broken(`it ends before the ${points.toLocaleString("en-US")} points its header promises`);
  const body = new Uint8Array(data, match[0].length);
  const row = size.reduce((sum, bytes, i) => sum + bytes * count[i]!, 0);
  if (kind === "binary" && points * row > body.length) throw endsEarly();
  if (kind === "binary_compressed") {
    if (body.length < 8) throw endsEarly();
    const sizes = new DataView(data, match[0].length, 8);
    if (sizes.getUint32(0, true) > body.length - 8 || sizes.getUint32(4, true) < points * row) throw endsEarly();
  }

  const colorField = fields.includes("rgb") ? "rgb" : "rgba";
  const text = [
    "# .PCD v0.7",
    "VERSION 0.7",
    `FIELDS ${fields.map((field) => (field === colorField ? "rgb" : field)).join(" ")}`,
    `SIZE ${size.join(" ")}`,
    `TYPE ${type.join(" ")}`,
    `COUNT ${count.join(" ")}`,
    `WIDTH ${points}`,
    "HEIGHT 1",
    `POINTS ${points}`,
    `DATA ${kind}`,
    "",
  ].join("\n");
  const head = new TextEncoder().encode(text);
  const rewritten = new Uint8Array(head.length + body.length);
  rewritten.set(head);
  rewritten.set(body, head.length);

  const { geometry } = new PCDLoader().parse(rewritten.buffer);
  // A four-byte float is a float, also where a text writes it with more digits.
  const cloud = pointsOf(geometry, size[fields.indexOf("x")] === 4 ? "single" : "double");
  if (cloud.positions.length !== 3 * points) throw endsEarly();
  return isOrganized(header) ? { ...cloud, taken: { up: "-y", from: takenFrom(header) } } : cloud;
}

/** Rows and columns as a depth camera sees them: in its own coordinates, x to the right, y down, z ahead. */
function isOrganized(header: Map<string, string[]>): boolean {
  return Number(header.get("HEIGHT")?.[0]) > 1;
}

function takenFrom(header: Map<string, string[]>): [number, number, number] {
  const [x, y, z] = (header.get("VIEWPOINT") ?? []).map(Number);
  return [x, y, z].every(Number.isFinite) ? [x!, y!, z!] : [0, 0, 0];
}
