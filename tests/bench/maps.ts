// How long a map of directions takes, and the share of the hidden points that it hides, along an orbit.
import { PointCloud, type VisibilityMapOptions } from "hidden-point-removal";

import { WrongAnswer } from "./check.js";
import { type Cloud, CLOUDS } from "./clouds.js";
import { median, type Row, type Table } from "./report.js";
import { bounds, orbit } from "./views.js";

type Setting = [cloud: string, options: VisibilityMapOptions, angle?: number];

const SETTINGS: Setting[] = [
  ["dragon", { exponent: 3 }],
  ["dragon", {}],
  ["dragon", { looks: 3 }],
  ["bumpy-1m", {}],
  ["bumpy-1m", { looks: 3 }],
  ["bumpy-3m", { exponent: 3 }],
  ["room", {}],
  ["room", {}, 60],
];
const DEGREES = 2;
const STEPS = 180;
/** One in so many maps is compared with the exact answer, which maps do not use. */
const EVERY = 12;

/**
 * A full turn by maps alone. The first map is not counted. Some places are asked cold as well, in turns.
 * With an angle, only the directions of a cone along the orbit count. Throws if a map of one hull
 * hides a visible point.
 */
export function timeMaps(): Table {
  const rows = SETTINGS.map(([name, options, angle]) => turn(CLOUDS[name]!()!, options, EVERY, angle));
  const note =
    `Median milliseconds in Node, on one core; ${STEPS} maps, ${DEGREES}° apart, of which one in ${EVERY} is compared. ` +
    '"Wrong" can be above 0 only with looks. With an angle, only a cone along the orbit counts.';
  return { title: "Maps of directions", note, rows };
}

/** A full turn around one cloud. One map in `every` is compared. */
export function turn(made: Cloud, options: VisibilityMapOptions, every: number, angle?: number): Row {
  const { name } = made;
  console.error(`${name}, ${JSON.stringify(options)}: maps…`);
  const cloud = new PointCloud(made.positions);
  const at = orbit(made);
  const { center } = bounds(made);
  const times = { cold: [] as number[], map: [] as number[] };
  const [shares, wrong]: [number[], number[]] = [[], []];
  let first = 0;
  for (let step = 0; step <= STEPS; step++) {
    const viewpoint = at(DEGREES * step);
    const ahead = at(DEGREES * step + 90);
    const direction = center.map((x, axis) => ahead[axis]! - x);
    const towards = angle === undefined ? {} : { towards: { direction, angle } };
    const map = timed(() => cloud.visibilityMap(viewpoint, { ...options, ...towards }));
    if (step === 0) first = map.milliseconds;
    else times.map.push(map.milliseconds);
    if (step % every > 0 || step === 0) continue;
    const cold = timed(() => cloud.visibleFrom(viewpoint, options));
    times.cold.push(cold.milliseconds);
    const hidden = map.answer.hides(made.positions);
    const counts = { hidden: 0, found: 0, visible: 0, wrong: 0 };
    cold.answer.mask().forEach((visible, i) => {
      if (angle !== undefined && !isWithin(made.positions, i, viewpoint, direction, angle)) return;
      counts[visible === 1 ? "visible" : "hidden"]++;
      if (hidden[i] === 1) counts[visible === 1 ? "wrong" : "found"]++;
    });
    if (options.looks === undefined && counts.wrong > 0) throw new WrongAnswer(`${name}: a map hides visible points`);
    // A bare wall hides nothing.
    if (counts.hidden > 0) shares.push(counts.found / counts.hidden);
    wrong.push(counts.wrong / counts.visible);
  }
  cloud.dispose();
  const [cold, map] = [median(times.cold), median(times.map)];
  return {
    cloud: angle === undefined ? name : `${name}, ${angle}°`,
    radius: JSON.stringify(options),
    "cold ms": cold,
    "map ms": map,
    "map ÷ cold": map / cold,
    "first map ms": first,
    "hidden found %": 100 * (shares.reduce((sum, share) => sum + share) / shares.length),
    "least %": 100 * Math.min(...shares),
    "wrong, worst %": 100 * Math.max(...wrong),
  };
}

function isWithin(positions: ArrayLike<number>, i: number, viewpoint: number[], direction: number[], angle: number) {
  const v = viewpoint.map((x, axis) => positions[3 * i + axis]! - x);
  const dot = v.reduce((sum, x, axis) => sum + x * direction[axis]!, 0);
  return dot >= Math.cos((angle * Math.PI) / 360) * Math.hypot(...v) * Math.hypot(...direction);
}

function timed<T>(work: () => T): { answer: T; milliseconds: number } {
  const start = performance.now();
  const answer = work();
  return { answer, milliseconds: performance.now() - start };
}
