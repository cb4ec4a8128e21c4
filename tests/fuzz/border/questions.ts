// Questions to structured clouds, with looks, scores, choices of points, and cameras. Most are good. Some must
// be refused.
import fc from "fast-check";
import type { ImageCamera, PointCloud, VisibilityOptions } from "hidden-point-removal";
import type { WorkerPointCloud } from "hidden-point-removal/worker";
import { named, typed } from "./argument.js";
import type { Place, Scene } from "./scenes.js";

type AnyCloud = PointCloud | WorkerPointCloud;

export interface Question {
  name: string;
  on: (cloud: AnyCloud) => unknown;
}

/** A good value, or now and then a value that must be refused. */
const mostly = <T>(good: readonly T[], bad: readonly T[]): fc.Arbitrary<T> =>
  fc.oneof({ weight: 15, arbitrary: fc.constantFrom(...good) }, { weight: 1, arbitrary: fc.constantFrom(...bad) });

const INVERSIONS: readonly VisibilityOptions[] = [
  {},
  {},
  { looks: 2 },
  { looks: 3 },
  { looks: 2, scores: true },
  { looks: 3, scores: true },
  { exponent: 2 },
  { exponent: 3.5 },
  { radius: 1e3 },
  { radius: 60 },
  { radius: "opposite" },
  { inversion: { power: 2 } },
  { inversion: { exponential: "auto" } },
  { inversion: { exponential: 3 } },
];
const BAD_INVERSIONS: readonly VisibilityOptions[] = [
  { radius: 7 },
  { looks: 4 as 3 },
  { looks: 3, radius: 100 } as object,
  { scores: true } as object,
  { exponent: NaN },
];

/** All points, no point, and every third point, for a cloud of this length. */
const MASKS: readonly ((length: number) => Uint8Array)[] = [
  (length) => new Uint8Array(length).fill(255),
  (length) => new Uint8Array(length),
  (length) => new Uint8Array(length).map((_, i) => Number(i % 3 === 0)),
];
const LONG_MASK = (length: number) => new Uint8Array(length + 1);

/** The option `within`, around a place. */
function within({ length, place }: Scene): fc.Arbitrary<VisibilityOptions["within"]> {
  const distance = mostly([0, 1, 3, 6.5, 30, Infinity], [-1, NaN]);
  const box = fc.tuple(place, mostly([0, 2, 5], [-1])).map(([min, size]) => [min, min.map((x) => x + size)] as const);
  const mask = mostly(MASKS, [LONG_MASK]).map((make) => make(length));
  return fc.record({ distance, box, mask }, { requiredKeys: [] });
}

function view(scene: Scene): fc.Arbitrary<VisibilityOptions> {
  const choice = fc.oneof({ weight: 2, arbitrary: fc.constant(undefined) }, { weight: 1, arbitrary: within(scene) });
  return fc
    .tuple(mostly(INVERSIONS, BAD_INVERSIONS), choice)
    .map(([inversion, within]) => ({ ...inversion, ...(within && { within }) }));
}

/** Quarter turns about the axes, as the columns of a matrix. */
const TURNS: readonly (readonly number[])[] = [
  [1, 0, 0, 0, 1, 0, 0, 0, 1],
  [1, 0, 0, 0, 0, 1, 0, -1, 0],
  [0, 0, -1, 0, 1, 0, 1, 0, 0],
  [-1, 0, 0, 0, 1, 0, 0, 0, -1],
];
/** A reflection, and a stretch. */
const NO_TURNS: readonly (readonly number[])[] = [
  [-1, 0, 0, 0, 1, 0, 0, 0, 1],
  [2, 0, 0, 0, 1, 0, 0, 0, 1],
];

function camera({ place }: Scene): fc.Arbitrary<ImageCamera> {
  const matrix = fc.tuple(mostly(TURNS, NO_TURNS), place).map(([turn, at]) => {
    const [x, y, z] = [turn.slice(0, 3), turn.slice(3, 6), turn.slice(6, 9)];
    return [...x, 0, ...y, 0, ...z, 0, ...at, 1];
  });
  const lens = mostly(
    [
      { fx: 100, fy: 100, cx: 100, cy: 100, width: 200, height: 200 },
      { fx: 4, fy: 4, cx: 8, cy: 4, width: 16, height: 8 },
      // The middle of the image is its border.
      { fx: 10, fy: 10, cx: 0, cy: 0, width: 10, height: 10 },
    ],
    [
      { fx: 10, fy: 10, cx: 5, cy: 5, width: 0, height: 10 },
      { fx: 10, fy: 0, cx: 5, cy: 5, width: 10, height: 10 },
      { fx: NaN, fy: 10, cx: 5, cy: 5, width: 10, height: 10 },
      { fx: 10, fy: 10, cx: 5, cy: 5, width: 10, height: Infinity },
    ],
  );
  const more = fc.record(
    {
      distortion: mostly(
        [
          [-0.3, 0.1, 0.001, -0.001, 0],
          [0, 0, 0, 0, 0],
        ],
        [
          [1, 2],
          [NaN, 0, 0, 0, 0],
        ],
      ),
      model: mostly<ImageCamera["model"]>(["OPENCV", undefined], ["FOV", "THIN_PRISM_FISHEYE", "FISHEYE" as "OPENCV"]),
      near: mostly([0, 0.5, 1], [3, 50, -1, NaN]),
      far: mostly([3, 20, Infinity], [0, NaN]),
    },
    { requiredKeys: [] },
  );
  const convention = fc.constantFrom("opencv", "opengl");
  return fc
    .tuple(matrix, lens, fc.oneof(fc.constant({}), more), convention)
    .map(([cameraToWorld, lens, more, convention]) => ({ cameraToWorld, convention, ...lens, ...more }));
}

const DIRECTIONS: readonly Place[] = [[0, 0, -1], [0, 1, 0], [1, 1, 0], [1, -2, 3]]; // prettier-ignore
const NO_DIRECTIONS: readonly Place[] = [[0, 0, 0], [NaN, 0, 0]]; // prettier-ignore

/** Questions by one method, with the arguments of these parts. */
const asking = <T>(
  method: string,
  parts: fc.Arbitrary<T>,
  ask: (cloud: AnyCloud, parts: T) => unknown,
): fc.Arbitrary<Question> =>
  named(
    parts.map((parts) => ({ name: `${method} ${fc.stringify(parts)}`, on: (cloud: AnyCloud) => ask(cloud, parts) })),
  );

/** Any question to the cloud of a scene. */
export function question(scene: Scene): fc.Arbitrary<Question> {
  const { place } = scene;
  const options = view(scene);
  const places = fc.array(place, { maxLength: 4 });
  const positions = fc
    .tuple(
      fc.array(place, { maxLength: 12 }),
      fc.nat({ max: 9 }),
      fc.constantFrom(Float64Array, Float32Array, Int16Array),
    )
    .map(([list, n, Type]) => (n === 9 ? [...list.flat(), NaN, 0, 0] : n < 4 ? typed(Type, list.flat()) : list.flat()));
  const weights = mostly([undefined, 0.25], [NaN]);
  const placing = fc.record(
    { count: fc.constantFrom(1, 2, 9, 0), share: fc.constantFrom(0.5, 1, 0) },
    { requiredKeys: [] },
  );
  const rule = fc.constantFrom("auto", "opposite", "search") as fc.Arbitrary<"auto">;
  const direction = mostly(DIRECTIONS, NO_DIRECTIONS);
  const edge = mostly<{ maxEdge?: number }>([{}, { maxEdge: 2 }, { maxEdge: Infinity }], [{ maxEdge: NaN }]);
  const light = mostly<{ smoothing?: number; ambient?: number }>(
    [{}, { smoothing: 0 }, { ambient: 0.25 }],
    [{ ambient: 2 }],
  );
  return fc.oneof(
    {
      weight: 4,
      arbitrary: asking("visibleFrom", fc.tuple(place, options), (cloud, args) => cloud.visibleFrom(...args)),
    },
    {
      weight: 3,
      arbitrary: asking("visibleFromCamera", fc.tuple(camera(scene), options), (cloud, args) =>
        cloud.visibleFromCamera(...args),
      ),
    },
    {
      weight: 3,
      arbitrary: asking("sees", fc.tuple(place, positions, options), (cloud, args) => cloud.sees(...args)),
    },
    asking("visibleFromDirection", fc.tuple(direction, options), (cloud, args) => cloud.visibleFromDirection(...args)),
    asking("visibleFromAny", fc.tuple(places, options), (cloud, args) => cloud.visibleFromAny(...args)),
    asking("visibleFromAtLeast", fc.tuple(mostly([1, 2], [0, 9]), places, options), (cloud, args) =>
      cloud.visibleFromAtLeast(...args),
    ),
    asking("coverage", fc.tuple(places, options), (cloud, args) => cloud.coverage(...args)),
    asking("placeViewpoints", fc.tuple(places, options, placing, weights), (cloud, [list, view, placing, weight]) => {
      const weights = weight === undefined ? undefined : new Float64Array(scene.length).fill(weight);
      return cloud.placeViewpoints(list, { ...view, ...placing, weights });
    }),
    asking("autoRadius", fc.tuple(place, rule), (cloud, args) => cloud.autoRadius(...args)),
    asking("reconstruct", fc.tuple(place, options, edge), (cloud, [from, view, edge]) =>
      cloud.reconstruct(from, { ...view, ...edge }),
    ),
    asking("illuminate", fc.tuple(places, options, light), (cloud, [lights, view, light]) =>
      cloud.illuminate(lights, { ...view, ...light }),
    ),
  );
}
