// The arguments of `npm run bench -- …`.
import { parseArgs } from "node:util";

import { CLOUDS } from "./clouds.js";

export const USAGE = `npm run bench -- [WHAT…] [--clouds NAME,NAME…] [--peers] [--json]

WHAT, by default --speed and --workers:
  --speed      cold queries, natively and in Node; three.js on the same flipped points
  --maps       maps of directions against cold queries, along an orbit; in a worker, at 60 frames a second
  --workers    two workers against one, eight views of a million points
  --octrees    the share of an octree that a view reads
  --all        all of it, and --peers

  --clouds     only these of --speed's clouds:
               ${Object.keys(CLOUDS).join(", ")}
  --peers      also SciPy (Qhull), installed into target/ (needs Python 3 with pip)
  --json       prints JSON instead of tables`;

const SECTIONS = ["speed", "maps", "workers", "octrees"] as const;
export type Section = (typeof SECTIONS)[number];

export interface BenchOptions {
  sections: ReadonlySet<Section>;
  clouds: string[];
  peers: boolean;
  json: boolean;
}

/** Throws an Error that says what is wrong with the arguments. */
export function readOptions(args: string[]): BenchOptions {
  const flag = { type: "boolean", default: false } as const;
  const names = [...SECTIONS, "all", "peers", "json"] as const;
  const flags = Object.fromEntries(names.map((name) => [name, flag])) as Record<(typeof names)[number], typeof flag>;
  const { values } = parseArgs({ args, options: { ...flags, clouds: { type: "string" } } });
  const asked = SECTIONS.filter((section) => values[section] || values.all);
  const clouds = values.clouds?.split(",") ?? Object.keys(CLOUDS);
  const unknown = clouds.find((name) => !(name in CLOUDS));
  if (unknown !== undefined) throw new Error(`There is no cloud named ${unknown}.`);
  const usual: Section[] = values.clouds === undefined ? ["speed", "workers"] : ["speed"];
  return {
    sections: new Set(asked.length === 0 ? usual : asked),
    clouds,
    peers: values.peers || values.all,
    json: values.json,
  };
}
