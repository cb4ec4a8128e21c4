// Octrees from servers that fail, and octrees whose lists and headers have changed bytes. The last step must be the answer
// of one version of the files, or there is a refusal with a code.
import { HprError, init, PointCloud } from "hidden-point-removal";
import { openOctree, type OctreeStep } from "hidden-point-removal/stream";

import { randomNumbers } from "../package/support";
import type { Naive } from "./stream/naive";
import { type Behavior, type Fault, serverOf, type Site } from "./stream/server";
import { type Subject, subjects } from "./stream/subjects";

/** Cases that wait for one another's pauses. */
const AT_ONCE = 500;
/** With the larger scales, many nodes are hidden and not read. */
const SCALES = [0.1, 1, 3] as const;

/** A viewpoint, and the scale c of the inversion. */
interface View {
  at: readonly number[];
  c: number;
}

export interface Counts {
  tried: number;
  exact: number;
  refused: number;
  /** Exact for all that was read, but a hidden part that was not read contradicts its list. */
  believed: number;
  wrong: number;
}

const counts = (): Counts => ({ tried: 0, exact: 0, refused: 0, believed: 0, wrong: 0 });

/** Tries cases for this many minutes. */
export async function fuzzStream(minutes: number, seed: number): Promise<number> {
  const end = Date.now() + 60_000 * minutes;
  const tallies = new Map<string, Counts>();
  for (let at = seed; Date.now() < end; at += AT_ONCE) await tryCases(at, AT_ONCE, tallies, console.log);
  for (const [name, { exact, refused, believed, tried, wrong }] of tallies) {
    console.log(`${name}: ${exact} exact, ${refused} refused, ${believed} believed; ${tried} cases, ${wrong} wrong`);
  }
  return [...tallies.values()].reduce((sum, { wrong }) => sum + wrong, 0);
}

let all: Promise<Subject[]> | undefined;

/** Tries the cases of some seeds, from one on. Each seed determines its case. */
export async function tryCases(
  seed: number,
  many: number,
  tallies: Map<string, Counts>,
  say: (text: string) => void,
): Promise<void> {
  await init();
  all ??= subjects();
  const known = await all;
  const one = async (at: number) => {
    const random = randomNumbers(at);
    const subject = known[random() < 0.04 ? 3 : Math.floor(3 * random())]!;
    const isDamage = random() < 0.4;
    const name = `${subject.name}, ${isDamage ? "changed bytes" : "a failing server"}`;
    const tally = tallies.get(name) ?? counts();
    tallies.set(name, tally);
    const { outcome, facts } = await (isDamage ? damaged(subject, random) : failing(subject, random));
    tally.tried += 1;
    if (outcome === "exact" || outcome === "refused" || outcome === "believed") {
      tally[outcome] += 1;
    } else {
      tally.wrong += 1;
      say(`seed ${at}, ${name}: ${outcome}\n  ${facts}`);
    }
  };
  await Promise.all(Array.from({ length: many }, (_, i) => one(seed + i)));
}

interface Tried {
  /** `exact`, `refused`, `believed`, or what is wrong. */
  outcome: string;
  facts: string;
}

const inverted = ({ c }: View) => ({ inversion: { exponential: c } });

function anyView({ viewpoints }: Subject, random: () => number): View {
  return { at: viewpoints[Math.floor(viewpoints.length * random())]!, c: SCALES[Math.floor(3 * random())]! };
}

/** A server that fails at some requests, and whose files may be replaced at one. */
async function failing(subject: Subject, random: () => number): Promise<Tried> {
  const faults = new Map<number, Fault>();
  const requests = 4 + Math.floor(24 * random());
  for (let i = Math.floor(3 * random()); i > 0; i--) faults.set(Math.floor(requests * random()), anyFault(random));
  const behavior: Behavior = {
    sites: [subject.versions[0].site, subject.versions[1].site],
    replacedAt: random() < 0.6 ? Math.floor(requests * random()) : Infinity,
    // Something must tell the versions apart.
    telling: {
      etag: (["strong", "weak", "none"] as const)[Math.floor(3 * random())]!,
      modified: random() < 0.5,
      contentRange: random() < 0.7,
    },
    faults,
    knowsIfRange: random() < 0.5,
  };
  const { telling } = behavior;
  if (telling.etag === "none") telling.modified = true;
  // A server that sends other bytes must say so.
  if (!telling.contentRange && [...faults.values()].some(({ kind }) => kind === "shifted")) telling.contentRange = true;
  const view = anyView(subject, random);
  const options = { retries: Math.floor(3 * random()), timeout: 400 };
  const facts = JSON.stringify({ ...behavior, sites: undefined, faults: [...faults], view, options });
  const answer = await answerOf(subject, behavior, view, options);
  if (typeof answer === "string") return { outcome: answer, facts };
  const isOf = subject.versions.map(({ nodes }) =>
    answer.steps.every((step) => faultIn(step, nodes, view) === undefined),
  );
  return { outcome: isOf.includes(true) ? "exact" : "the answer is that of neither version", facts };
}

function anyFault(random: () => number): Fault {
  const kinds = [
    "reset",
    "cut",
    "endless",
    "silent",
    "shifted",
    "short",
    "long",
    "multipart",
    "gzip",
    "whole",
  ] as const;
  const kind = [...kinds, "slow", "status", "status", "status"][Math.floor((kinds.length + 4) * random())]!;
  if (kind === "slow") return { kind, milliseconds: Math.floor(40 * random()) };
  if (kind !== "status") return { kind: kind as (typeof kinds)[number] };
  const status = [400, 403, 404, 410, 412, 416, 429, 500, 502, 503, 504][Math.floor(11 * random())]!;
  const retryAfter = [undefined, "0", "1", "9999", "Wed, 21 Oct 2015 07:28:00 GMT", "soon"][Math.floor(6 * random())];
  return { kind, status, ...(retryAfter !== undefined && { retryAfter }) };
}

const isDigit = (byte: number) => byte >= 48 && byte < 58;

/** A good server of files in which bytes of the header, the metadata or the list of nodes are others. */
async function damaged(subject: Subject, random: () => number): Promise<Tried> {
  const { file, from, to } = subject.damage[Math.floor(subject.damage.length * random())]!;
  const original = subject.versions[0].site;
  const bytes = original[file]!.slice();
  const changes: [number, number][] = [];
  for (let i = random() < 0.8 ? 1 : 3; i > 0; i--) {
    let at = from + Math.floor((to - from) * random());
    if (file.endsWith(".json") && random() < 0.7) {
      // Another number.
      while (!isDigit(bytes[at]!)) at = (at + 1) % bytes.length;
      bytes[at] = 48 + Math.floor(10 * random());
    } else {
      bytes[at] = random() < 0.5 ? bytes[at]! ^ (1 << Math.floor(8 * random())) : Math.floor(256 * random());
    }
    changes.push([at, bytes[at]!]);
  }
  const site: Site = { ...original, [file]: bytes };
  const view = anyView(subject, random);
  const facts = JSON.stringify({ file, changes, view });
  const telling = { etag: "strong", modified: true, contentRange: true } as const;
  const behavior = {
    sites: [site, site],
    replacedAt: Infinity,
    telling,
    faults: new Map(),
    knowsIfRange: true,
  } as const;
  const answer = await answerOf(subject, behavior, view, {});
  if (typeof answer === "string") return { outcome: answer, facts };
  const last = answer.steps.at(-1)!;
  const unseen = last.nodes.hidden > 0;
  const isOriginal = faultIn(last, subject.versions[0].nodes, view) === undefined;
  // A part that is hidden and not read may contradict the rest. The answer is true all the same.
  if (isOriginal && unseen) return { outcome: "exact", facts };
  let nodes: Naive;
  try {
    nodes = await subject.read(site);
  } catch (error) {
    return { outcome: `answered, but it cannot be read: ${String(error)}`, facts };
  }
  const listed = [...nodes.values()].reduce((sum, { positions }) => sum + positions.length / 3, 0);
  if (listed !== answer.points && !unseen) {
    return { outcome: `${answer.points} points, but ${listed} are listed`, facts };
  }
  const fault = faultIn(last, nodes, view);
  if (fault === undefined) return { outcome: "exact", facts };
  const sound = new Map([...nodes].filter(([, { isSound }]) => isSound));
  const isOfSound = sound.size < nodes.size && faultIn(last, sound, view) === undefined;
  return { outcome: isOfSound ? "believed" : fault, facts };
}

interface Answered {
  /** As the octree gives it. */
  points: number;
  steps: OctreeStep[];
}

/** The steps of a view, or `refused`, or how the view ended otherwise. */
async function answerOf(subject: Subject, behavior: Behavior, view: View, options: object): Promise<Answered | string> {
  const { fetch, asked } = serverOf(behavior);
  const steps: OctreeStep[] = [];
  let points: number;
  try {
    const octree = await openOctree(subject.address, { fetch, ...options });
    points = octree.points;
    for await (const step of octree.visibleFrom(view.at, inverted(view))) steps.push(step);
    octree.dispose();
  } catch (error) {
    const isKnown = error instanceof HprError && ["load", "radius", "too-large"].includes(error.code);
    return isKnown ? "refused" : `no refusal: ${String(error)}`;
  }
  if (asked() > 300) return `${asked()} requests`;
  if (steps.at(-1)?.exact !== true) return "it ends without an exact answer";
  return { steps, points };
}

/** Why a step is not the answer of a cloud of these nodes. A step that is not the last has points of it. */
function faultIn(step: OctreeStep, nodes: Naive, view: View): string | undefined {
  for (const { key, indices, positions } of step.visible) {
    const own = nodes.get(key)?.positions ?? [];
    const isOwn = [...indices].every((index, i) => [0, 1, 2].every((axis) => own[3 * index + axis] === positions[3 * i + axis])); // prettier-ignore
    if (!isOwn) return `node ${key} has other points`;
  }
  if (!step.exact) return undefined;
  const { starts, indices: expected } = visibleIn(nodes, view);
  const found = step.visible.flatMap(({ key, indices }) => [...indices].map((index) => starts.get(key)! + index));
  const isSame =
    found.length === expected.length && found.sort((a, b) => a - b).every((index, i) => index === expected[i]);
  return isSame ? undefined : `${found.length} points are visible instead of ${expected.length}`;
}

interface Visible {
  /** The number of the first point of each node among the points of all nodes. */
  starts: Map<string, number>;
  indices: Uint32Array;
}

/** What was asked of the versions is asked again in most cases. */
const answered = new WeakMap<Naive, Map<string, Visible>>();

function visibleIn(nodes: Naive, view: View): Visible {
  const known = answered.get(nodes) ?? new Map<string, Visible>();
  answered.set(nodes, known);
  const before = known.get(JSON.stringify(view));
  if (before) return before;
  const starts = new Map<string, number>();
  const points: number[] = [];
  for (const [key, { positions }] of nodes) {
    starts.set(key, points.length / 3);
    for (const value of positions) points.push(value);
  }
  const cloud = new PointCloud(points);
  const visible = { starts, indices: cloud.visibleFrom(view.at, inverted(view)).indices };
  cloud.dispose();
  known.set(JSON.stringify(view), visible);
  return visible;
}
