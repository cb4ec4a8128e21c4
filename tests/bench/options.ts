// The arguments of `npm run bench -- …`.
import { parseArgs } from "node:util";

import { CLOUDS } from "./clouds.js";

export const USAGE = `npm run bench -- [WHAT…] [--clouds NAME,NAME…] [--peers] [--json]

WHAT, by default --speed, --drafts and --workers:
  --speed      cold queries, natively, in Node and in Chromium;
               three.js and quickhull3d on the same flipped points
  --drafts     early answers and samples against cold ones
  --workers    two workers against one, on a million points
  --sectors    the sectors of a view, one after another: what several cores would gain
  --adapter    what the adapters for three.js take of the page's own thread
  --page       the built demo page in Chromium: first picture, following, an orbit
  --fidelity   errors against ray-traced visibility, for each choice of the radius
  --all        all of it but --page, and --peers

  --clouds     only these of --speed's clouds:
               ${Object.keys(CLOUDS).join(", ")}
  --peers      also SciPy (Qhull) and Open3D, installed into target/ (needs Python 3 with pip)
  --json       prints JSON instead of tables`;

const SECTIONS = ["speed", "drafts", "workers", "sectors", "adapter", "page", "fidelity"] as const;
type Section = (typeof SECTIONS)[number];
/** The sections that "all" leaves out. */
const ALONE = new Set<Section>(["page"]);

export interface BenchOptions {
  sections: ReadonlySet<Section>;
  clouds: string[];
  peers: boolean;
  json: boolean;
}

/** Throws an Error that says what is wrong with the arguments. */
export function readOptions(args: string[]): BenchOptions {
  const flag = { type: "boolean", default: false } as const;
  const flags = {
    speed: flag,
    drafts: flag,
    workers: flag,
    sectors: flag,
    adapter: flag,
    page: flag,
    fidelity: flag,
    all: flag,
  };
  const options = { ...flags, peers: flag, json: flag, clouds: { type: "string" } } as const;
  const { values } = parseArgs({ args, options });
  const asked = SECTIONS.filter((section) => values[section] || (values.all && !ALONE.has(section)));
  const clouds = values.clouds?.split(",") ?? Object.keys(CLOUDS);
  const unknown = clouds.find((name) => !(name in CLOUDS));
  if (unknown !== undefined) throw new Error(`There is no cloud named ${unknown}.`);
  const usual: Section[] = values.clouds === undefined ? ["speed", "drafts", "workers"] : ["speed"];
  return {
    sections: new Set(asked.length === 0 ? usual : asked),
    clouds,
    peers: values.peers || values.all,
    json: values.json,
  };
}
