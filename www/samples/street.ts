import { box, cylinder, group, type Hit, type Material, type Solid, sphere, type Vector } from "./trace.ts";
import type { LoadedCloud } from "../cloud/cloud.ts";
import { gaussian, mulberry32, type Truth } from "./generator.ts";

const ASPHALT: Material = { color: [92, 93, 97], kind: 11, gloss: 0.3 };
const PAINT: Material = { color: [226, 226, 220], kind: 11, gloss: 0.95 };
const PAVEMENT: Material = { color: [158, 154, 147], kind: 2, gloss: 0.5 };
const STONE: Material = { color: [176, 170, 160], kind: 6, gloss: 0.55 };
const FRAME: Material = { color: [232, 230, 224], kind: 6, gloss: 0.7 };
const DOOR: Material = { color: [86, 62, 48], kind: 6, gloss: 0.3 };
const GLASS: Material = { color: [104, 122, 134], kind: 6, gloss: 0.15 };
const BARK: Material = { color: [104, 84, 66], kind: 5, gloss: 0.35 };
const TIRE: Material = { color: [44, 44, 46], kind: 64, gloss: 0.15 };
const STEEL: Material = { color: [108, 114, 116], kind: 65, gloss: 0.6 };
const ROOM: Material = { color: [206, 190, 166], kind: 66, gloss: 0.6 };
const FURNITURE: Material = { color: [150, 106, 74], kind: 66, gloss: 0.4 };
const PLASTER: Vector[] = [[205, 176, 140], [188, 108, 88], [214, 208, 196], [142, 160, 164], [198, 186, 128], [176, 142, 130]]; // prettier-ignore
const LACQUER: Vector[] = [
  [158, 44, 40],
  [40, 66, 110],
  [206, 206, 204],
  [52, 54, 58],
  [120, 134, 126],
];

const HALF_LENGTH = 35;
const CURB = 3.6;
const FACADE = 6.4;
const DEPTH = 4.2;
const STOREY = 3.3;

/** `throughPane` decides for each ray that meets a window whether it passes. */
export function makeScene(random: () => number, throughPane: () => boolean): Solid<Material> {
  const solids: Solid<Material>[] = [ground()];
  for (const side of [-1, 1] as const) {
    for (let x = -HALF_LENGTH; x < HALF_LENGTH - 4;) {
      const width = Math.min(HALF_LENGTH - x, 8 + 5 * random());
      const storeys = 3 + Math.floor(2.4 * random());
      // Some neighboring houses have a gap between them.
      if (random() < 0.86) {
        solids.push(
          house(
            x,
            x + width,
            side,
            storeys,
            { color: PLASTER[Math.floor(random() * PLASTER.length)]!, kind: 6, gloss: 0.6 },
            random,
            throughPane,
          ),
        );
      }
      x += width;
    }
    for (let x = -31; x < 32; x += 9.4 + 2 * random()) {
      solids.push(random() < 0.72 ? tree(x, side * 4.4, random) : lamp(x, side * 4.1));
    }
    for (let x = -30; x < 30; x += 5.6 + 2.5 * random()) if (random() < 0.62) solids.push(car(x, side * 2.55, random));
  }
  solids.push(...[[-9, 4.9], [7.5, -5.2], [16, 5.3], [-13, -5.4]].map(([x, y]) => person(x!, y!))); // prettier-ignore
  return group(solids);
}

function ground(): Solid<Material> {
  const level =
    (z: number): Solid<number> =>
    (from, along, reach) => {
      const distance = (z - from[2]) / along[2];
      return distance > 0 && distance < reach ? { distance, normal: [0, 0, 1], material: z } : null;
    };
  const [road, pavement] = [level(0), level(0.12)];
  return (from, along, reach) => {
    const higher = pavement(from, along, reach);
    const at = (hit: Hit<number>) => ({ x: from[0] + hit.distance * along[0], y: from[1] + hit.distance * along[1] });
    if (higher && Math.abs(at(higher).y) >= CURB) {
      return Math.abs(at(higher).y) < FACADE + DEPTH ? { ...higher, material: PAVEMENT } : null;
    }
    const hit = road(from, along, reach);
    if (!hit) return null;
    const { x, y } = at(hit);
    if (Math.abs(y) > CURB) return null;
    const dashed = Math.abs(y) < 0.07 && (x + 100) % 4 < 2;
    return { ...hit, material: dashed || (Math.abs(x) < 2 && (y + 100) % 1 < 0.5) ? PAINT : ASPHALT };
  };
}

/** A façade with windows, and rooms behind it: floors, walls, a piece of furniture. */
function house(
  from: number,
  to: number,
  side: 1 | -1,
  storeys: number,
  wall: Material,
  random: () => number,
  throughPane: () => boolean,
): Solid<Material> {
  const height = storeys * STOREY + 0.5;
  const windows = Math.max(2, Math.round((to - from) / 2.6));
  const bay = (to - from) / windows;
  const door = Math.floor(random() * windows);
  const y = side * FACADE;
  const [low, high] = side > 0 ? [FACADE, FACADE + DEPTH] : [-FACADE - DEPTH, -FACADE];

  const rooms: Solid<Material>[] = [];
  for (let storey = 0; storey < storeys; storey++) {
    for (let room = 0; room < windows; room += 2) {
      const [a, b] = [from + room * bay + 0.08, Math.min(to, from + (room + 2) * bay) - 0.08];
      rooms.push(box([a, low + 0.05, storey * STOREY + 0.15], [b, high - 0.05, (storey + 1) * STOREY], ROOM));
      const x = a + (b - a) * (0.15 + 0.5 * random());
      const inner = y + side * (1.2 + 1.5 * random());
      rooms.push(
        box(
          [x, Math.min(inner, inner + 0.7 * side), storey * STOREY + 0.15],
          [x + 1.1, Math.max(inner, inner + 0.7 * side), storey * STOREY + 0.95 + 0.7 * random()],
          FURNITURE,
        ),
      );
    }
  }
  const inside = group(rooms);
  const outside = box([from, low, 0], [to, high, height], wall);
  const cornice = box(
    [from, Math.min(y, y - 0.25 * side), height - 0.4],
    [to, Math.max(y, y - 0.25 * side), height],
    STONE,
  );
  const part = (x: number, z: number): Material | null => {
    const [u, v] = [((x - from) % bay) / bay - 0.5, z % STOREY];
    if (z < STOREY && Math.floor((x - from) / bay) === door) {
      return Math.abs(u) < 0.24 && v < 2.3 ? DOOR : Math.abs(u) < 0.3 && v < 2.45 ? STONE : wall;
    }
    if (z > storeys * STOREY || Math.abs(u) > 0.29 || v < 0.85 || v > 2.55) return z < 0.7 ? STONE : wall;
    const frame = Math.abs(u) > 0.26 || v < 0.93 || v > 2.47 || Math.abs(u) < 0.015 || Math.abs(v - 1.95) < 0.035;
    return frame ? FRAME : null;
  };
  return (eye, along, reach) => {
    const above = cornice(eye, along, reach);
    const hit = outside(eye, along, reach);
    if (!hit || (above && above.distance < hit.distance)) return above;
    if (hit.normal[1] === 0) return hit;
    const material = part(eye[0] + hit.distance * along[0], eye[2] + hit.distance * along[2]);
    if (material) return { ...hit, material };
    if (!throughPane()) return { ...hit, material: GLASS };
    return behind(hit.distance + 0.06, eye, along, reach, inside);
  };
}

/** The hit behind a pane, with its distance from the eye. */
function behind(
  pane: number,
  eye: Vector,
  along: Vector,
  reach: number,
  inside: Solid<Material>,
): Hit<Material> | null {
  const hit = inside(eye.map((value, axis) => value + pane * along[axis]!) as Vector, along, reach - pane);
  return hit && { ...hit, distance: hit.distance + pane };
}

function tree(x: number, y: number, random: () => number): Solid<Material> {
  const trunk = 2.3 + 0.5 * random();
  const center: Vector = [x, y, trunk + 1.5];
  const leaves: Solid<Material>[] = [];
  for (let i = 0; i < 170; i++) {
    const up = 2 * random() - 1;
    const turn = 2 * Math.PI * random();
    const reach = 1.75 * Math.cbrt(random());
    const ring = Math.sqrt(1 - up * up) * reach;
    const at: Vector = [x + ring * Math.cos(turn), y + ring * Math.sin(turn), center[2] + 0.95 * up * reach];
    const fresh = 0.75 + 0.4 * random();
    leaves.push(
      sphere(at, 0.09 + 0.13 * random(), { color: [92 * fresh, 132 * fresh, 66 * fresh], kind: 5, gloss: 0.45 }),
    );
  }
  return group([cylinder([x, y, 0], 0.14, trunk + 1.2, BARK), group(leaves, { center, radius: 2.1 })]);
}

function lamp(x: number, y: number): Solid<Material> {
  return group([
    cylinder([x, y, 0], 0.06, 5.2, STEEL),
    box([x - 0.15, y - 0.35, 5.1], [x + 0.15, y + 0.35, 5.25], STEEL),
  ]);
}

function car(x: number, y: number, random: () => number): Solid<Material> {
  const body: Material = { color: LACQUER[Math.floor(random() * LACQUER.length)]!, kind: 64, gloss: 0.8 };
  const wheels = [-1.3, 1.3].flatMap((along) =>
    [-0.75, 0.75].map((across) => sphere<Material>([x + along, y + across, 0.31], 0.31, TIRE)),
  );
  const parts = [
    box<Material>([x - 2.1, y - 0.85, 0.32], [x + 2.1, y + 0.85, 0.85], body),
    box<Material>([x - 1.5, y - 0.75, 0.85], [x + 0.9, y + 0.75, 1.42], body),
    ...wheels,
  ];
  return group(parts, { center: [x, y, 0.7], radius: 2.5 });
}

function person(x: number, y: number): Solid<Material> {
  const coat: Material = { color: [70, 78, 104], kind: 65, gloss: 0.4 };
  const skin: Material = { color: [196, 152, 128], kind: 65, gloss: 0.5 };
  return group([cylinder([x, y, 0.1], 0.2, 1.4, coat), sphere([x, y, 1.62], 0.13, skin)]);
}

/*
 * A street of 70 meters with houses, trees and parked cars, as a terrestrial laser scanner sees it from three places.
 * The rays have even steps of both angles. Each ray makes one point, at its first hit. Glass lets most rays through. So
 * there are points of the rooms behind the façades. Through the walls, nobody in the street would see these points.
 * Units are meters; x is along the street, z up. The seed is fixed: the points are the same on every machine.
 */

const SEED = 2007;
const STATIONS: Vector[] = [
  [-21, 1.1, 1.75],
  [0.5, -1.3, 1.75],
  [22, 0.9, 1.75],
];
const TURNS = 500;
const STEPS = 158;
/** The angles of the lowest and the highest ray, in degrees. */
const LOWEST = -42;
const HIGHEST = 58;
const REACH = 48;
/** One standard deviation of the measured distance, in meters. */
const NOISE = 0.004;
/** The share of the beams that a pane sends back. */
const PANE = 0.06;

const LABELS = {
  2: "ground",
  5: "high vegetation",
  6: "building",
  11: "road",
  64: "vehicle",
  65: "street furniture",
  66: "behind glass",
};

export function make(): LoadedCloud {
  const most = STATIONS.length * TURNS * STEPS;
  const positions = new Float32Array(3 * most);
  const colors = new Uint8Array(3 * most);
  const intensity = new Uint8Array(most);
  const classification = new Uint8Array(most);
  let count = 0;
  for (const { from, along, hit, measured, light, grain } of scan()) {
    const { color, kind, gloss } = hit.material;
    for (let axis = 0; axis < 3; axis++) {
      positions[3 * count + axis] = from[axis]! + measured * along[axis]!;
      colors[3 * count + axis] = Math.min(255, color[axis]! * light);
    }
    const slant = Math.abs(along[0] * hit.normal[0] + along[1] * hit.normal[1] + along[2] * hit.normal[2]);
    intensity[count] = Math.min(
      255,
      gloss * (0.25 + 0.75 * slant) * (0.92 + 0.16 * grain) * Math.min(1, 22 / (10 + hit.distance)) * 255,
    );
    classification[count] = kind;
    count++;
  }
  return {
    positions: positions.slice(0, 3 * count),
    colors: colors.slice(0, 3 * count),
    facts: { crs: { name: "Its own", unit: { name: "m", meters: 1 }, heightUnit: null, isAngular: false } },
    attributes: [
      { name: "intensity", kind: "scalar", values: intensity.slice(0, count) },
      { name: "classification", kind: "category", values: classification.slice(0, count), labels: LABELS },
    ],
  };
}

/** Everything that was scanned, with panes that one can look through, and the places that the beams met. */
export function truth(): Truth {
  const places: number[] = [];
  for (const { from, along, hit } of scan()) {
    places.push(...from.map((value, axis) => value + hit.distance * along[axis]!));
  }
  return { scene: makeScene(mulberry32(SEED), () => true), places: Float64Array.from(places) };
}

/** Every beam that comes back, with the measured distance. */
function* scan(): Generator<{
  from: Vector;
  along: Vector;
  hit: Hit<Material>;
  measured: number;
  light: number;
  grain: number;
}> {
  const random = mulberry32(SEED);
  const scene = makeScene(random, () => random() >= PANE);
  for (const from of STATIONS) {
    for (let turn = 0; turn < TURNS; turn++) {
      for (let step = 0; step < STEPS; step++) {
        const around = (2 * Math.PI * (turn + 0.4 * random())) / TURNS;
        const up = ((LOWEST + ((HIGHEST - LOWEST) * (step + 0.4 * random())) / STEPS) * Math.PI) / 180;
        const along: Vector = [Math.cos(up) * Math.cos(around), Math.cos(up) * Math.sin(around), Math.sin(up)];
        const hit = scene(from, along, REACH);
        if (!hit) continue;
        const measured = hit.distance + NOISE * gaussian(random);
        yield { from, along, hit, measured, light: shade(hit.normal, hit.material, random), grain: random() };
      }
    }
  }
}

/** Soft daylight from the south and from above. Rooms are darker. */
function shade(normal: Vector, { kind }: Material, random: () => number): number {
  const light =
    0.84 + 0.16 * normal[2] + 0.14 * Math.max(0, 0.5 * normal[0] - 0.86 * normal[1]) + 0.06 * (random() - 0.5);
  return kind === 66 ? 0.8 * light : light;
}
