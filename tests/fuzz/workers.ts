// Compares clouds that several workers share by default with the same clouds in one instance.
// The clouds are rooms and blocks of a lattice, with 200,000 points and more. The viewpoints
// lie in planes of these clouds, on their points and on their corners.
import { init, PointCloud } from "hidden-point-removal";
import { WorkerPointCloud } from "hidden-point-removal/worker";

type Random = () => number;
type Place = [number, number, number];

/** A room's length, width and height. */
const SIZE: Place = [8, 6, 3];
/** From this number of points on, several workers are the default. */
const SHARED_FROM = 200_000;
const VIEWS = 8;

/** Random numbers in [0, 1) that are the same for the same seed (mulberry32). */
function randomNumbers(seed: number): Random {
  let state = seed | 0;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}

/** Points on the walls of a room. If `unit` is not 0, coordinates are rounded to multiples of it. */
function room(random: Random, count: number, unit: number): Float64Array {
  const positions = new Float64Array(3 * count);
  for (let i = 0; i < count; i++) {
    const p = SIZE.map((side) => random() * side);
    const wall = Math.floor(random() * 6);
    const axis = wall >> 1;
    p[axis] = wall % 2 === 0 ? 0 : SIZE[axis]!;
    positions.set(unit === 0 ? p : p.map((x) => Math.round(x / unit) * unit), 3 * i);
  }
  return positions;
}

/** A viewpoint in the plane of a wall or a point, on a corner, on a point, or on a line through two points. */
function viewpoint(random: Random, positions: Float64Array | Float32Array): Place {
  const any = (): Place => {
    const i = 3 * Math.floor((random() * positions.length) / 3);
    return [positions[i]!, positions[i + 1]!, positions[i + 2]!];
  };
  const inside = SIZE.map((side) => random() * side) as Place;
  const axis = Math.floor(random() * 3);
  switch (Math.floor(random() * 6)) {
    case 0:
      return any();
    case 1:
      return SIZE.map((side) => (random() < 0.5 ? 0 : side)) as Place;
    case 2: {
      const [a, b] = [any(), any()];
      return a.map((x, i) => 2 * b[i]! - x) as Place;
    }
    case 3:
      inside[axis] = any()[axis]!;
      return inside;
    case 4: {
      const outside = inside.map((x) => 3 * x - 6) as Place;
      outside[axis] = 0;
      return outside;
    }
    default:
      inside[axis] = random() < 0.5 ? 0 : SIZE[axis]!;
      return inside;
  }
}

function options(random: Random): object {
  const choices = [{}, {}, { exponent: 1 }, { exponent: 2 }, { exponent: 3 }, { exponent: 5 }, { radius: 1000 }];
  return choices[Math.floor(random() * choices.length)]!;
}

/** Compares views of shared clouds with views of one instance until the time is over. */
export async function fuzzWorkers(minutes: number, seed: number): Promise<{ tried: number; wrong: number }> {
  await init();
  const random = randomNumbers(seed);
  const end = Date.now() + 60_000 * minutes;
  let [tried, wrong] = [0, 0];
  while (Date.now() < end) {
    const count = SHARED_FROM + Math.floor(random() * 100_000);
    const unit = random() < 0.5 ? 0 : 1 / 64;
    const positions = room(random, count, unit);
    const given = random() < 0.5 ? positions : Float32Array.from(positions);
    const one = new PointCloud(given);
    const shared = await WorkerPointCloud.create(given);
    for (let view = 0; view < VIEWS && Date.now() < end; view++) {
      const [from, how] = [viewpoint(random, given), options(random)];
      const [expected, answer] = [one.visibleFrom(from, how), await shared.visibleFrom(from, how)];
      tried++;
      if (Buffer.compare(Buffer.from(answer.mask()), Buffer.from(expected.mask())) !== 0) {
        wrong++;
        const kind = `${given.constructor.name} of ${count} points, unit ${unit}, seed ${seed}`;
        const [found, right] = [answer.count, expected.count];
        console.log(`wrong: ${kind}, from [${from.join(", ")}] with ${JSON.stringify(how)}: ${found}, not ${right}`);
      }
    }
    one.dispose();
    await shared.dispose();
  }
  return { tried, wrong };
}
