import { type Attribute, type Cloud, type Up, upVector, type Values } from "../cloud/cloud.ts";
import { OWN_COLORS } from "../settings/settings.ts";
import { spreadOf } from "../cloud/prepare.ts";
import type { Theme } from "./theme.ts";

const PLAIN = "plain";
const HEIGHT = "height";

export interface Coloring {
  /** Three bytes for each point. `null`: the file's own colors. */
  tints: Uint8Array | null;
  legend: Legend | null;
}

export type Legend =
  | { kind: "ramp"; low: number; high: number; colors: readonly string[] }
  | { kind: "categories"; entries: { label: string; color: string; count: number }[] };

const STEPS = 256;
const MOST_ENTRIES = 12;

/**
 * Matplotlib's viridis (van der Walt and Smith, 2015; CC0) at 16 places, linear between them. It differs from the whole
 * map by at most 7 of 255. The eye sees even steps, also with color blindness. It is readable in gray, too.
 */
const VIRIDIS_STOPS = [
  "#440154", "#481a6c", "#472f7d", "#414487", "#39568c", "#31688e", "#2a788e", "#23888e",
  "#1f988b", "#22a884", "#35b779", "#54c568", "#7ad151", "#a5db36", "#d2e21b", "#fde725",
]; // prettier-ignore
const VIRIDIS = Array.from({ length: STEPS }, (_, i) => viridis(i / (STEPS - 1)));

/** Tableau 10: colors for categories, easy to tell apart. */
const TABLEAU = "#4e79a7 #f28e2c #e15759 #76b7b2 #59a14f #edc949 #af7aa1 #ff9da7 #9c755f #bab0ab".split(" ");
/** Classes that everybody connects with a color. Other classes take the colors above in turn. */
const CLASS_COLORS: Readonly<Record<string, string>> = {
  "never classified": "#9aa0a6",
  unclassified: "#b9bec4",
  ground: "#b08d62",
  "low vegetation": "#b5cf6b",
  "medium vegetation": "#7fb24e",
  "high vegetation": "#3f8f46",
  building: "#d9694f",
  "low noise": "#e377c2",
  "high noise": "#c566c9",
  water: "#4f94d4",
  road: "#7f8794",
  vehicle: "#3f6fe0",
};

type Rgb = readonly [number, number, number];

/** Everything by which a cloud can be colored, each with a label. */
export function colorChoices({ colors, attributes }: Cloud): { value: string; label: string }[] {
  return [
    { value: OWN_COLORS, label: colors ? "Its own colors" : "Two tones" },
    { value: PLAIN, label: "One color" },
    { value: HEIGHT, label: "Height" },
    ...attributes.map(({ name }) => ({
      value: name,
      label: name.charAt(0).toUpperCase() + name.slice(1).replaceAll("_", " "),
    })),
  ];
}

export function colorBy(choice: string, cloud: Cloud, up: Up, theme: Theme): Coloring {
  if (choice === PLAIN) return { tints: painted(cloud.count, [rgb(theme.plain)], () => 0), legend: null };
  if (choice === HEIGHT) return ramp(cloud.count, heights(cloud, up));
  const attribute = cloud.attributes.find(({ name }) => name === choice);
  if (!attribute) return { tints: null, legend: null };
  const { kind, values } = attribute;
  return kind === "category" ? categories(attribute) : ramp(cloud.count, (i) => values[i]!);
}

/** The heights of the points, in the file's coordinates. */
function heights({ local, center }: Cloud, up: Up): (i: number) => number {
  const axis = up === "z" ? 2 : 1;
  const sign = upVector(up)[axis];
  return (i) => sign * (local[3 * i + axis]! + center[axis]);
}

/** Colors from low to high. A few stray values at either end do not count. */
function ramp(count: number, value: (i: number) => number): Coloring {
  const [low, high] = spreadOf(count, value);
  const scale = high > low ? (STEPS - 1) / (high - low) : 0;
  const tints = painted(count, VIRIDIS, (i) => {
    const step = Math.round((value(i) - low) * scale);
    // NaN gets the lowest color.
    return step > 0 ? Math.min(STEPS - 1, step) : 0;
  });
  return { tints, legend: { kind: "ramp", low, high, colors: VIRIDIS_STOPS } };
}

function categories({ values, labels = {}, colors = {} }: Attribute): Coloring {
  const { known, counts, numbers } = numbered(values);
  const ascending = [...known].sort((a, b) => a - b);
  const shown = new Map(
    ascending.map((value, i) => [
      value,
      colors[value] ?? CLASS_COLORS[labels[value] ?? ""] ?? TABLEAU[i % TABLEAU.length]!,
    ]),
  );
  const tints = painted(
    values.length,
    known.map((value) => rgb(shown.get(value)!)),
    (i) => numbers[i]!,
  );
  const entries = ascending.map((value) => ({
    label: labels[value] ?? String(value),
    color: shown.get(value)!,
    count: counts[known.indexOf(value)]!,
  }));
  // If there are too many for the list, only the largest ones are kept.
  if (entries.length > MOST_ENTRIES) entries.sort((a, b) => b.count - a.count).splice(MOST_ENTRIES);
  return { tints, legend: { kind: "categories", entries } };
}

/** The different values in the order of the file, their counts, and for each point the number of its value. */
function numbered(values: Values): { known: number[]; counts: number[]; numbers: Uint32Array } {
  const numberOf = new Map<number, number>();
  const counts: number[] = [];
  const numbers = new Uint32Array(values.length);
  let [value, number] = [NaN, -1];
  for (let i = 0; i < values.length; i++) {
    // Neighbors in a file mostly have the same value.
    if (values[i] !== value) {
      value = values[i]!;
      number = numberOf.get(value) ?? numberOf.size;
      numberOf.set(value, number);
    }
    numbers[i] = number;
    counts[number] = (counts[number] ?? 0) + 1;
  }
  return { known: [...numberOf.keys()], counts, numbers };
}

/** Gives each point one of the colors. */
function painted(count: number, colors: readonly Rgb[], colorOf: (i: number) => number): Uint8Array {
  const bytes = Uint8Array.from(colors.flat());
  const tints = new Uint8Array(3 * count);
  for (let i = 0; i < count; i++) {
    const from = 3 * colorOf(i);
    tints[3 * i] = bytes[from]!;
    tints[3 * i + 1] = bytes[from + 1]!;
    tints[3 * i + 2] = bytes[from + 2]!;
  }
  return tints;
}

function viridis(share: number): Rgb {
  const at = share * (VIRIDIS_STOPS.length - 1);
  const i = Math.min(VIRIDIS_STOPS.length - 2, Math.floor(at));
  const [from, to] = [rgb(VIRIDIS_STOPS[i]!), rgb(VIRIDIS_STOPS[i + 1]!)];
  return [0, 1, 2].map((channel) => Math.round(from[channel]! + (at - i) * (to[channel]! - from[channel]!))) as [
    number,
    number,
    number,
  ];
}

function rgb(hex: string): Rgb {
  const bits = Number.parseInt(hex.slice(1), 16);
  return [bits >> 16, (bits >> 8) & 255, bits & 255];
}
