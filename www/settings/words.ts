import { MAX_POINTS, REACH } from "./limits.ts";
import type { PARAMETERS, SettingName } from "./table.ts";

/*
 * The words of the documents and of index.html about the table of settings. They stand apart from the table, since the
 * scripts that are downloaded do not need them. A row without words is a type error.
 */

export interface Words {
  /** The thing that the row sets. */
  is: string;
  /** The value if the address does not have the parameter. If this is missing, it is the usual value. */
  without?: string;
}

/** `labels`: the labels of the choices in the panel, by the text of each choice. */
export type SettingWords = Words & { labels?: Readonly<Record<string, string>> };

export const SETTING_WORDS: Record<SettingName, SettingWords> = {
  radius: {
    is: "the radius of the sphere, by a rule or as a length",
  },
  looks: {
    is: "looks at rest; `0`: one hull, as in the paper",
    without: "`3`; with `exponent`, `radius` or `inversion` `0`",
    labels: { 0: "One hull", 2: "2 looks", 3: "3 looks" },
  },
  thickness: {
    is: "how thick measured surfaces are; only with looks",
  },
  inversion: {
    is: "how points are flipped; c in spacings",
  },
  freeze: {
    is: "where the viewpoint stays",
    without: "the camera",
  },
  hidden: {
    is: "how hidden points are drawn",
    labels: { off: "Hide", dimmed: "Ghost", shown: "Highlight" },
  },
  compare: {
    is: "the dividing line, as a share of the width",
    without: "none",
  },
  color: {
    is: "colors",
  },
  size: {
    is: "point size ÷ the points’ rough distance",
  },
  fieldOfView: {
    is: "vertical field of view",
  },
  up: {
    is: "which way is up",
    without: "by the file",
    labels: { y: "Y", z: "Z", "-y": "−Y" },
  },
  theme: {
    is: "colors of the page",
    labels: { system: "System", dark: "Dark", light: "Light" },
  },
};

export const PARAMETER_WORDS: Record<keyof typeof PARAMETERS, Words> = {
  view: {
    is: `the camera’s place, within ${powerOfTen(REACH)} radii`,
    without: "the whole cloud is seen",
  },
  target: {
    is: "the place it looks at",
    without: "the middle",
  },
  exponent: {
    is: "log₁₀ of radius ÷ farthest distance",
    without: "automatic",
  },
  points: {
    is: "the most points; of more, an even share",
    without: `${MAX_POINTS / 1e6} million`,
  },
  stream: {
    is: "larger octrees are streamed",
    without: `${MAX_POINTS / 1e6} million; with \`points\`, nothing is streamed`,
  },
  turn: {
    is: "whether the picture turns until touched",
    without: "`1` if nothing else is asked",
  },
  story: {
    is: "a story; it sets everything else",
    without: "none",
  },
};

function powerOfTen(value: number): string {
  return `10${String(Math.log10(value)).replace(/\d/g, (digit) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(digit)]!)}`;
}
