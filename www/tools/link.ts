// Marks and stations as parameters of the address. Points are named by their index in the cloud.
import { MARK_PARAMETERS, type MarkParameter } from "../settings/address.ts";
import { PLACE } from "../settings/kinds.ts";
import type { Label } from "./label.ts";
import type { Measure } from "./measure.ts";
import { LONGEST_NAME, type Station, type Stations } from "./stations.ts";

/** The longest text of each parameter, in characters. Many programs cut an address after 2,000 or a little more. */
const LONGEST = 600;
const LONGEST_LABEL = 80;

/** The tools whose results are part of the address. */
export interface Marked {
  measure: Measure;
  label: Label;
  stations: Stations;
}

export interface Link {
  parameters: Record<MarkParameter, string[]>;
  /** The things that are too long for an address. */
  left: string[];
}

const SAID: Record<MarkParameter, string> = {
  measure: "the distances",
  label: "the labels",
  station: "the stations",
};

export function linkOf({ measure, label, stations }: Marked): Link {
  const parameters: Link["parameters"] = {
    measure: measure.pairs.map((ends) => ends.join()),
    label: label.texts.map(({ index, text }) => `${index},${text}`),
    station: stations.all.map(({ name, at }) => `${at.join()},${name}`),
  };
  const left: string[] = [];
  for (const name of MARK_PARAMETERS) {
    if (parameters[name].join("").length <= LONGEST) continue;
    parameters[name] = [];
    left.push(SAID[name]);
  }
  return { parameters, left };
}

/** Sets the marks of an address. Returns whether each of them suits a cloud of `count` points. */
export function restore(search: string, { measure, label, stations }: Marked, count: number): boolean {
  const query = new URLSearchParams(search);
  const all = (name: MarkParameter) => query.getAll(name).slice(0, LONGEST);
  const isIndex = (word: string | undefined) => /^\d{1,10}$/.test(word ?? "") && Number(word) < count;
  let isWhole = true;
  for (const text of all("measure")) {
    const ends = text.split(",");
    if (ends.length === 2 && ends.every(isIndex)) measure.measure(Number(ends[0]), Number(ends[1]));
    else isWhole = false;
  }
  for (const text of all("label")) {
    const [at, ...rest] = text.split(",");
    const words = rest.join().slice(0, LONGEST_LABEL).trim();
    if (isIndex(at) && words !== "") label.add(Number(at), words);
    else isWhole = false;
  }
  const places = all("station").map(stationOf);
  const known = places.filter((station) => station !== null);
  if (known.length === 0 || count === 0) return isWhole && places.length === 0;
  stations.add(known);
  return isWhole && known.length === places.length;
}

function stationOf(text: string): Station | null {
  const [x, y, z, ...words] = text.split(",");
  const at = PLACE.parse([x, y, z].join());
  const name = words.join().trim().slice(0, LONGEST_NAME);
  return at && name !== "" ? { name, at } : null;
}
