import type { Attribute, Crs, Field, FileFacts, LasSource, LoadedCloud, Values } from "../cloud/cloud.ts";
import { partOf } from "../cloud/prepare.ts";
import { checkedCloud } from "./limits.ts";
import { LoadProblem } from "./protocol.ts";
import type { Loading } from "./loaded.ts";
import { readCloud } from "./read.ts";

const number = new Intl.NumberFormat("en-US");

/** Reads several files into one cloud. A file that cannot be read is named in a note, and the others are kept. */
export async function readSeveral(
  files: readonly File[],
  { limit, onProgress }: Omit<Loading, "name" | "blob">,
): Promise<LoadedCloud> {
  const whole = files.reduce((sum, { size }) => sum + size, 0);
  const problems: string[] = [];
  let parts: Named[] = [];
  let done = 0;
  // Of all points together, every so many-th is kept.
  let step = 1;
  for (const file of files) {
    const { name } = file;
    const reading: Loading = {
      name,
      blob: file,
      limit,
      onProgress: (fraction) => onProgress?.((done + fraction * file.size) / Math.max(1, whole)),
    };
    try {
      if (file.size === 0) throw new LoadProblem(`${name} is empty.`);
      const cloud = checkedCloud(name, await readCloud(reading), false);
      const [first] = parts;
      const apart = first ? farApart(first.cloud, cloud) : 0;
      if (apart > 0) {
        const far = `${number.format(Number(apart.toPrecision(3)))} ${cloud.facts?.crs?.unit?.name ?? "units"}`;
        throw new LoadProblem(`${name} lies ${far} away from ${first!.name} and is left out; open it alone.`);
      }
      parts.push({ name, cloud: everyNth(cloud, step) });
    } catch (error) {
      if (!(error instanceof LoadProblem)) throw error;
      problems.push(error.message);
    }
    while (pointsOf(parts) > limit) {
      step *= 2;
      parts = parts.map((part) => ({ ...part, cloud: everyNth(part.cloud, 2) }));
    }
    done += file.size;
  }
  if (parts.length === 0) throw new LoadProblem(problems.join(" "));
  const cloud = merged(parts);
  const thinned = step > 1 ? [`Of all points of these files, one in ${number.format(step)} is shown.`] : [];
  return { ...cloud, notes: [...problems, ...thinned, ...(cloud.notes ?? [])] };
}

/** A file that is farther away than this many times the larger of two clouds would leave both too small to be seen. */
const FAR = 300;

/** The distance of two clouds, if they are too far apart to be shown together. Else 0. */
function farApart(...clouds: [LoadedCloud, LoadedCloud]): number {
  const boxes = clouds.map(({ positions }) =>
    [0, 1, 2].map((axis) => {
      let [low, high] = [Infinity, -Infinity];
      for (let i = axis; i < positions.length; i += 3) {
        low = Math.min(low, positions[i]!);
        high = Math.max(high, positions[i]!);
      }
      return [low, high] as const;
    }),
  );
  const [a, b] = boxes as [(typeof boxes)[0], (typeof boxes)[0]];
  const apart = Math.hypot(...a.map(([low, high], axis) => Math.max(0, low - b[axis]![1], b[axis]![0] - high)));
  const size = Math.max(...boxes.map((box) => Math.hypot(...box.map(([low, high]) => high - low))));
  return size > 0 && apart > FAR * size ? apart : 0;
}

function pointsOf(parts: readonly Named[]): number {
  return parts.reduce((sum, { cloud }) => sum + cloud.positions.length / 3, 0);
}

function everyNth(cloud: LoadedCloud, step: number): LoadedCloud {
  if (step === 1) return cloud;
  const count = Math.ceil(cloud.positions.length / 3 / step);
  return partOf(
    cloud,
    Uint32Array.from({ length: count }, (_, i) => i * step),
  );
}

/** A cloud that was read, with the name of its file. */
export interface Named {
  name: string;
  cloud: LoadedCloud;
}

/** The column with the number of each point's file. */
const FILE = "file";

const list = new Intl.ListFormat("en", { type: "conjunction" });

/**
 * Joins clouds, one after another. No coordinate changes: if one cloud needs eight bytes for it, all get eight bytes. Only columns
 * that every file has are kept. A new column says from which file a point is.
 */
export function merged(parts: readonly Named[]): LoadedCloud {
  const clouds = parts.map(({ cloud }) => cloud);
  const counts = clouds.map(({ positions }) => positions.length / 3);
  const columns = clouds.map(({ fields, attributes = [] }) => fields ?? attributes);
  const shared = columns[0]!.filter(({ name }) => columns.every((own) => own.some((other) => other.name === name)));
  const missing = new Set(columns.flatMap((own) => own.map(({ name }) => name)));
  for (const { name } of shared) missing.delete(name);
  const colors = joinedColors(clouds);
  for (const name of ["red", "green", "blue"]) missing.delete(name);
  if (!colors && clouds.some((cloud) => cloud.colors)) missing.add("colors");

  const fields = shared.map(({ name }) => joinedField(name, columns, counts));
  const attributes = fields.flatMap((field) => attributeOf(field, clouds));
  const files = fileColumn(parts, counts, fields);
  return {
    positions: joined(
      clouds.map(({ positions }) => positions),
      clouds.every(({ positions }) => positions instanceof Float32Array) ? Float32Array : Float64Array,
    ) as LoadedCloud["positions"],
    colors,
    fields: [files, ...fields],
    attributes: [{ ...files, kind: "category" }, ...attributes],
    facts: joinedFacts(clouds),
    ...sameUp(clouds),
    notes: [
      ...parts.flatMap(({ name, cloud }) => (cloud.notes ?? []).map((note) => `${name}: ${note}`)),
      ...(missing.size > 0
        ? [
            `Columns that not every file has are left out: ${list.format([...missing].map((name) => name.replaceAll("_", " ")))}.`,
          ]
        : []),
      ...systemNote(parts),
    ],
  };
}

function joined(arrays: readonly Values[], Type: new (length: number) => Values): Values {
  const all = new Type(arrays.reduce((sum, { length }) => sum + length, 0));
  let at = 0;
  for (const values of arrays) {
    all.set(values, at);
    at += values.length;
  }
  return all;
}

/** Numbers of different types become f64, which holds all of them exactly. */
function joinedField(name: string, columns: readonly (readonly Field[])[], counts: readonly number[]): Field {
  const own = columns.map((fields) => fields.find((field) => field.name === name)!);
  const types = new Set(own.map(({ values }) => values.constructor as new (length: number) => Values));
  const [Type] = types.size === 1 ? types : [Float64Array];
  const [{ values: first }] = own as [Field];
  const isConstant = own.every(({ values }) => values.length === 1 && Object.is(values[0], first[0]));
  const whole = own.map(({ values }, i) =>
    values.length === 1 ? filled(values.constructor as new (length: number) => Values, counts[i]!, values[0]!) : values,
  );
  const labels = Object.assign({}, ...own.map((field) => field.labels ?? {})) as Record<number, string>;
  const values = isConstant && types.size === 1 ? first : joined(whole, Type!);
  return { name, values, ...(Object.keys(labels).length > 0 ? { labels } : {}) };
}

function filled(Type: new (length: number) => Values, length: number, value: number): Values {
  return new Type(length).fill(value);
}

/** The column as something to color by, if it is that in at least one of the files. */
function attributeOf(field: Field, clouds: readonly LoadedCloud[]): Attribute[] {
  const own = clouds.flatMap(({ attributes = [] }) => attributes.filter(({ name }) => name === field.name));
  if (own.length === 0) return [];
  const isCategory = own.some(({ kind }) => kind === "category");
  return [{ ...own[0]!, ...field, kind: isCategory ? "category" : "scalar" }];
}

function fileColumn(
  parts: readonly Named[],
  counts: readonly number[],
  others: readonly Field[],
): Field & { labels: Record<number, string> } {
  const isTaken = others.some(({ name }) => name === FILE);
  const Type = parts.length <= 256 ? Uint8Array : Uint32Array;
  return {
    name: isTaken ? `source ${FILE}` : FILE,
    values: joined(
      counts.map((count, i) => filled(Type, count, i)),
      Type,
    ),
    labels: Object.fromEntries(parts.map(({ name }, i) => [i, name])),
  };
}

/** Colors, if every file has them. */
function joinedColors(clouds: readonly LoadedCloud[]): Uint8Array | null {
  const all = clouds.flatMap(({ colors }) => (colors ? [colors] : []));
  return all.length === clouds.length ? (joined(all, Uint8Array) as Uint8Array) : null;
}

/** Facts that hold for all files. */
function joinedFacts(clouds: readonly LoadedCloud[]): FileFacts {
  const facts = clouds.map(({ facts: own }) => own ?? {});
  const [first] = facts as [FileFacts];
  const decimals = facts.map((own) => own.decimals);
  const digits = [0, 1, 2].map((axis) => Math.max(...decimals.map((own) => own?.[axis] ?? 0)));
  return {
    ...(decimals.every((own) => own !== undefined) ? { decimals: digits as [number, number, number] } : {}),
    ...(first.crs && facts.every(({ crs }) => isSame(crs, first.crs!)) ? { crs: first.crs } : {}),
    // Then all coordinates are whole steps from one place, and the cloud can be saved as LAS without rounding.
    ...(first.las && facts.every(({ las }) => gridOf(las) === gridOf(first.las)) ? { las: first.las } : {}),
  };
}

/** The grid that the coordinates of a LAS file are on, and how its points are stored. */
function gridOf(las: LasSource | undefined): string | null {
  return las
    ? JSON.stringify([las.format, las.scale, las.offset, las.extras.map(({ description }) => [...description])])
    : null;
}

function isSame(a: Crs | undefined, b: Crs): boolean {
  return (
    a !== undefined &&
    a.name === b.name &&
    a.unit?.meters === b.unit?.meters &&
    a.heightUnit?.meters === b.heightUnit?.meters
  );
}

function systemNote(parts: readonly Named[]): string[] {
  const systems = parts.map(({ name, cloud }) => ({ name, crs: cloud.facts?.crs }));
  const given = systems.find(({ crs }) => crs)?.crs;
  if (!given || systems.every(({ crs }) => isSame(crs, given))) return [];
  const said = systems.map(({ name, crs }) => `${name}: ${crs?.name ?? "none"}`).join("; ");
  return [`The files do not name one coordinate system (${said}). Their coordinates are shown as they are.`];
}

function sameUp(clouds: readonly LoadedCloud[]): Pick<LoadedCloud, "taken"> {
  const up = clouds[0]!.taken?.up;
  return up && clouds.every(({ taken }) => taken?.up === up) ? { taken: { up } } : {};
}
