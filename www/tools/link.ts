// Marks, the selection and stations as parameters of the address. Points are named by their index in the cloud.
import { MARK_PARAMETERS, type MarkParameter } from "../settings/address.ts";
import { PLACE, POSITIVE } from "../settings/kinds.ts";
import { gapsOf, indicesOf } from "./gaps.ts";
import type { Label } from "./label.ts";
import type { LateTool } from "./late-tool.ts";
import type { Measure } from "./measure.ts";
import { THROUGH } from "./measure/words.ts";
import type { Select } from "./select.ts";
import { LONGEST_NAME, type Station } from "./stations/station.ts";
import type { Stations } from "./stations/stations.ts";

/** The longest text of each parameter, in characters. Many programs cut an address after 2,000 or a little more. */
const LONGEST = 600;
const LONGEST_LABEL = 80;

/** The tools whose results are part of the address. */
export interface Marked {
  measure: Measure;
  label: Label;
  select: Select;
  stations: LateTool<Stations>;
  /** Whether hidden points count as well. */
  through: { checked: boolean };
}

export interface Link {
  parameters: Record<MarkParameter, string[]>;
  /** The things that are too long for an address. */
  left: string[];
}

const SAID: Record<MarkParameter, string> = {
  measure: "the distances",
  area: "the area",
  profile: "the profile",
  label: "the labels",
  select: "the selection",
  station: "the stations",
};

export function noMarks(): Link["parameters"] {
  return { measure: [], area: [], profile: [], label: [], select: [], station: [] };
}

export function linkOf({ measure, label, select, stations }: Marked): Link {
  const { other } = measure;
  const parameters: Link["parameters"] = {
    measure: measure.pairs.map((ends) => ends.join()),
    area: other?.mode === "area" ? [other.words] : [],
    profile: other?.mode === "profile" ? [other.words] : [],
    label: label.texts.map(({ index, text }) => `${index},${text}`),
    select: select.indices.length > 0 ? [gapsOf(select.indices, LONGEST)] : [],
    station: (stations.here?.all ?? []).map(({ name, at }) => `${at.join()},${name}`),
  };
  const left: string[] = [];
  for (const name of MARK_PARAMETERS) {
    if (parameters[name].join("").length <= LONGEST) continue;
    parameters[name] = [];
    left.push(SAID[name]);
  }
  return { parameters, left };
}

/**
 * Sets the marks of an address. Resolves with whether each of them suits a cloud of `count` points. `final` waits for
 * the final picture, and resolves with whether this cloud is still on screen.
 */
export async function restore(
  search: string,
  marked: Marked,
  count: number,
  final: () => Promise<boolean>,
): Promise<boolean> {
  const query = new URLSearchParams(search);
  const asked: Asked = {
    all: (name) => query.getAll(name).slice(0, LONGEST),
    index: (word) => {
      const index = /^\d{1,10}$/.test(word ?? "") ? Number(word) : count;
      return index < count ? index : null;
    },
  };
  const done = [restoreDistances(asked, marked), restoreLabels(asked, marked), restoreSelection(asked, marked, count)];
  // These two need code that is downloaded first.
  done.push(await restoreOther(asked, marked, final));
  done.push(await restoreStations(asked, marked, count, final));
  return done.every(Boolean);
}

/** The parameters of an address. */
interface Asked {
  all: (name: MarkParameter) => string[];
  /** `null`: the word is no index of a point. */
  index: (word: string | undefined) => number | null;
}

function restoreDistances({ all, index }: Asked, { measure }: Marked): boolean {
  let isWhole = true;
  for (const text of all("measure")) {
    const [from, to, more] = text.split(",");
    const ends = [index(from), index(to)] as const;
    if (ends[0] === null || ends[1] === null || more !== undefined) isWhole = false;
    else measure.measure(ends[0], ends[1]);
  }
  return isWhole;
}

function restoreLabels({ all, index }: Asked, { label }: Marked): boolean {
  let isWhole = true;
  for (const text of all("label")) {
    const comma = text.indexOf(",");
    const at = comma < 0 ? null : index(text.slice(0, comma));
    const words = text.slice(comma + 1, comma + 1 + LONGEST_LABEL).trim();
    if (at === null || words === "") isWhole = false;
    else label.add(at, words);
  }
  return isWhole;
}

function restoreSelection({ all }: Asked, { select }: Marked, count: number): boolean {
  const [text] = all("select");
  const indices = text === undefined ? null : indicesOf(text, count);
  if (indices) select.choose(indices);
  return text === undefined || indices !== null;
}

/** An area or a profile. The page shows one of them at a time, so a second one is left out. */
async function restoreOther(
  { all, index }: Asked,
  { measure, through }: Marked,
  final: () => Promise<boolean>,
): Promise<boolean> {
  const [other, ...more] = [
    ...all("area").map((text) => areaOf(text, index)),
    ...all("profile").map((text) => profileOf(text, index)),
  ];
  if (!other) return other === undefined;
  const put = await measure.ready(other.mode);
  if (!(await final())) return true;
  if (other.isThrough) through.checked = true;
  put?.(other.indices, other.width);
  return put !== null && more.length === 0;
}

interface Other {
  mode: "area" | "profile";
  indices: number[];
  width?: number;
  isThrough?: boolean;
}

function areaOf(text: string, index: Asked["index"]): Other | null {
  const words = text.slice(0, LONGEST).split(",");
  const indices = words.map(index).filter((corner) => corner !== null);
  return indices.length < words.length || indices.length < 3 ? null : { mode: "area", indices };
}

/** "i,j,width", and `THROUGH` if it has the hidden points of its strip, too. */
function profileOf(text: string, index: Asked["index"]): Other | null {
  const [from, to, width, through, more] = text.split(",");
  const indices = [index(from), index(to)].filter((end) => end !== null);
  const wide = POSITIVE.parse(width ?? "");
  const isThrough = through === THROUGH;
  if (indices.length < 2 || wide === undefined || more !== undefined) return null;
  return through === undefined || isThrough ? { mode: "profile", indices, width: wide, isThrough } : null;
}

async function restoreStations(
  { all }: Asked,
  { stations }: Marked,
  count: number,
  final: () => Promise<boolean>,
): Promise<boolean> {
  const places = all("station").map(stationOf);
  const known = places.filter((station) => station !== null);
  if (known.length === 0 || count === 0) return places.length === 0;
  const tool = await stations.ready();
  if (!(await final())) return true;
  tool?.add(known);
  return tool !== null && known.length === places.length;
}

function stationOf(text: string): Station | null {
  const [x, y, z, ...words] = text.split(",");
  const at = PLACE.parse([x, y, z].join());
  const name = words.join().trim().slice(0, LONGEST_NAME);
  return at && name !== "" ? { name, at } : null;
}
