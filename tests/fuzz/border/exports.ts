// Every export of every entry, read from the modules, with good arguments of which one or two places hold hostile values.
// A call is answered, or refused with an HprError or with what the value itself throws, and the clouds live on.
import fc from "fast-check";
import * as main from "hidden-point-removal";
import * as deck from "hidden-point-removal/deck";
import * as files from "hidden-point-removal/files";
import * as inline from "hidden-point-removal/inline";
import * as lite from "hidden-point-removal/lite";
import * as nodes from "hidden-point-removal/nodes";
import * as potree from "hidden-point-removal/potree";
import * as fiber from "hidden-point-removal/react-three-fiber";
import * as stream from "hidden-point-removal/stream";
import * as three from "hidden-point-removal/three";
import * as webgpu from "hidden-point-removal/three/webgpu";
import * as worker from "hidden-point-removal/worker";
import { BufferAttribute, BufferGeometry, Group, PerspectiveCamera, Points } from "three";

import { HOSTILE, isOwn, throwing } from "./hostile.js";
import { outcomeOf, require } from "./outcome.js";
import { type AnyCloud, CAMERAS, Part, QUESTIONS } from "./table.js";

const ENTRIES = { main, worker, files, lite, inline, stream, three, nodes, webgpu, potree, deck, fiber };

const POSITIONS = Float32Array.from({ length: 180 }, (_, i) => Math.sin(i * i) + (i % 3));
const ALL = new Part(POSITIONS.length / 3);
const positions = () => POSITIONS.slice();
const at = () => [3, 2, 5];
const nothing = () => undefined;
const signal = () => new AbortController().signal;
const camera = () => structuredClone(CAMERAS[0]);
const within = () => ({ distance: 9, box: [[-9, -9, -9], at()], mask: new Uint8Array(ALL.length).fill(1) });

const points = () =>
  new Points(new BufferGeometry().setAttribute("position", new BufferAttribute(POSITIONS.slice(), 3)));
const eye = () => {
  const camera = new PerspectiveCamera(50, 1, 0.1, 100);
  camera.position.set(0, 0, 5);
  return camera;
};
const drawing = () => ({
  worker: false,
  mode: "hide",
  nonFinite: "skip",
  stale: "keep",
  looks: 2,
  settle: { exponent: 2 },
});

const PLY =
  "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n1 2 3\n";
const KITTI = ["P0: 9 0 4 0 0 9 4 0 0 0 1 0", "P1: 9 0 4 0 0 9 4 0 0 0 1 0"].join("\n");
const metadata = () => ({ version: "2.0", attributes: [], hierarchy: {}, encoding: "DEFAULT", boundingBox: {} });
const ranges = () => Promise.resolve(new Uint8Array(22));

type Arguments = Record<string, () => unknown[]>;

const merge = () => ({ radius: 99, inversion: { power: 2 } });
const seenBy = () => ({ offsets: new Uint32Array(61), cameras: new Uint32Array(0), towards: new Float32Array(0) });
const columns = () => ({ intensity: new Uint16Array(60), own: new Float32Array(60) });

/** Functions, and classes that are constructed. */
const FUNCTIONS: Arguments = {
  PointCloud: () => [positions(), { dimension: 3, stride: 3, nonFinite: "skip" }],
  hiddenPointRemoval: () => [positions(), at(), { inversion: { power: 2 }, radius: 99 }],
  Horizon: () => [at(), merge()],
  mergeVisible: () => [[{ positions: positions(), ids: new Uint32Array(60) }], at(), merge()],
  cameraFromPose: () => [at(), [0, 0, 0, 1], camera(), "opengl"],
  cameraFromThree: () => [eye(), 8, 8],
  intrinsicsFromFieldOfView: () => [50, 8, 8],
  orientNormals: () => [positions(), seenBy()],
  permissibleCurvature: () => [9, 2, 0.5],
  radiusBound: () => [0.1, 5, 0.1],
  ringOfViewpoints: () => [at(), [0, 0, 0], { count: 4, fraction: 0.1 }],
  configure: () => [{ wasm: undefined, worker: undefined }],
  readCloud: () => [
    new Blob([PLY]),
    { columns: ["x", "y", "z"], damaged: true, onProgress: nothing, signal: signal(), wasm: undefined },
  ],
  readCameras: () => [[new File([KITTI], "calib.txt")], { width: 8, height: 8 }],
  writeCloud: () => [
    { positions: positions(), colors: new Uint8Array(180), columns: columns() },
    "las",
    { indices: Uint32Array.of(1, 2), onNote: nothing },
  ],
  colmapVis: () => [seenBy()],
  openOctree: () => [
    { metadata: metadata(), hierarchy: ranges, octree: ranges },
    { fetch: () => Promise.reject(new Error()), colors: true, cache: 9, retries: 0, timeout: 9, wasm: undefined },
  ],
  HiddenPointFilter: () => [points(), drawing()],
  HiddenPointNodesFilter: () => [new Group().add(points()), { ...drawing(), pending: "draw" }],
  PotreeFilter: () => [{ scene: { pointclouds: [] }, pRenderer: {}, addEventListener: nothing }, drawing()],
};

/** Exports that are called otherwise, below, or not at all: components, whose framework reads what they are given. */
const OTHERS = [
  ...["HprError", "OctreeStep", "VisibilityMap", "ViewStream", "WorkerPointCloud", "transfer", "init", "initSync"],
  ...["VisiblePointCloudLayer", "VisiblePoints", "useHiddenPointFilter"],
];

const CHANGES: Arguments = { append: () => [positions()], remove: () => [[1, 2, 3]] };
const FILTERS: Arguments = {
  update: () => [eye(), at()],
  sees: () => [{ x: 1, y: 2, z: 3 }],
  setOptions: () => [{ exponent: 2, within: within(), settle: false }],
  addEventListener: () => ["change", nothing],
};

interface Row {
  name: string;
  args: () => unknown[];
  call: (...args: unknown[]) => unknown;
}

type Callable = (...args: unknown[]) => unknown;

/** Methods of what `open` opens for each call; `close` gives it up afterwards. */
const methods = <T extends object>(open: () => T | Promise<T>, table: Arguments, close: (it: T) => unknown = nothing) =>
  Object.entries(table).map(([name, args]): Row => ({
    name,
    args,
    call: async (...given) => {
      const it = await open();
      try {
        return await (it as Record<string, Callable>)[name]!(...given);
      } finally {
        await close(it);
      }
    },
  }));

function questionsTo(cloud: AnyCloud, request: object): Row[] {
  const more = [{}, { exponent: 2, within: within() }, { looks: 3, thickness: 0.1, surface: "noisy" }];
  return Object.entries(QUESTIONS).flatMap(([name, row]) =>
    more.map((options) => ({
      name: `${name}${"signal" in request ? " of a worker" : ""}`,
      args: () => {
        const args = row(at(), ALL, ALL.length);
        const all = { ...(name === "autoRadius" ? {} : structuredClone(options)), ...request };
        return [...args.slice(0, -1), Object.assign(all, args.at(-1))];
      },
      call: (...args) =>
        name === "transfer"
          ? (main.transfer as Callable)(cloud, ...args)
          : (cloud as unknown as Record<string, Callable>)[name]!(...args),
    })),
  );
}

/** All calls. Throws if an entry has an export that is not in the tables above. */
async function rows(): Promise<Row[]> {
  const cloud = new main.PointCloud(POSITIONS);
  const small = new lite.PointCloud(POSITIONS);
  const remote = await worker.WorkerPointCloud.create(POSITIONS, { shared: true });
  const map = cloud.visibilityMap([3, 2, 5], { points: 64 });
  const heard = <T extends three.HiddenPointFilter | nodes.HiddenPointNodesFilter>(filter: T): T => {
    filter.addEventListener("error", ({ error }: { error: Error }) => events.push(error));
    return filter;
  };
  const filter = () => heard(new three.HiddenPointFilter(points(), { worker: false }));
  const group = () => heard(new nodes.HiddenPointNodesFilter(new Group().add(points()), { worker: false }));
  const follow = () => remote.follow({ onError: nothing });
  const known = new Set<unknown>();
  const functions = Object.entries(ENTRIES).flatMap(([entry, module]) =>
    Object.entries(module).flatMap(([name, value]: [string, unknown]): Row[] => {
      require(name in FUNCTIONS || OTHERS.includes(name), `${entry} exports ${name}, which no call of the fuzzer has`);
      if (known.has(value) || OTHERS.includes(name)) return [];
      known.add(value);
      const isClass = /^[A-Z]/.test(name);
      const call = (...args: unknown[]): unknown =>
        isClass ? Reflect.construct(value as never, args) : (value as Callable)(...args);
      const close = async (...args: unknown[]) => {
        const made = (await call(...args)) as { dispose?: () => void } | undefined;
        if (isClass) made?.dispose?.();
      };
      return [{ name: `${name} of ${entry}`, args: FUNCTIONS[name]!, call: close }];
    }),
  );
  return [
    ...functions,
    ...methods(() => cloud, CHANGES),
    ...methods(() => small, {
      ...CHANGES,
      visibleFrom: () => [at(), { exponent: 2 }],
      autoRadius: () => [at(), "auto"],
    }),
    ...methods(() => remote, CHANGES),
    ...methods(() => remote, {
      follow: () => [{ exponent: 2, settle: { looks: 2 }, stale: "all", onAnswer: nothing, onError: nothing }],
    }),
    ...methods(() => worker.WorkerPointCloud, {
      create: () => [
        positions(),
        { shared: true, nonFinite: "error", transfer: false, onProgress: nothing, signal: signal() },
      ],
    }),
    ...methods(() => map, { hides: () => [positions()] }),
    ...methods(() => new main.Horizon(at(), { radius: 99 }), {
      add: () => [positions()],
      screen: () => [positions()],
      hidesBox: () => [[0, 0, 0], at()],
    }),
    ...methods(follow, { look: () => [at()], lookAlong: () => [at()] }, (it) => it.dispose()),
    ...methods(filter, { ...FILTERS, isVisible: () => [3] }, (it) => it.dispose()),
    ...methods(group, FILTERS, (it) => it.dispose()),
    ...questionsTo(cloud, {}),
    ...questionsTo(remote, { latest: false, signal: signal() }),
  ];
}

let table: Promise<Row[]> | undefined;
/** The errors that filters sent since the last call. */
const events: unknown[] = [];

/** The places in a tree of arguments: each holds a value that can be replaced. */
function placesIn(tree: object, found: [holder: object, key: string][] = []): typeof found {
  for (const [key, value] of Object.entries(tree) as [string, unknown][]) {
    found.push([tree, key]);
    const isPlain =
      typeof value === "object" &&
      value !== null &&
      [Object.prototype, Array.prototype].includes(Object.getPrototypeOf(value) as never);
    if (isPlain) placesIn(value, found);
  }
  return found;
}

const OPEN = { enumerable: true, configurable: true };
const WORKER = import.meta.resolve("hidden-point-removal/worker-thread.js");
const spoil = fc.record({ place: fc.nat(), how: fc.nat({ max: 9 }), hostile: fc.constantFrom(...HOSTILE) });
const witness = { count: 0 };

export const exports = fc.asyncProperty(
  fc.nat(),
  fc.array(spoil, { minLength: 1, maxLength: 2 }),
  async (row, spoils) => {
    const all = await (table ??= rows());
    const { name, args, call } = all[row % all.length]!;
    const given = args();
    const places = placesIn(given);
    const said = spoils.map(({ place, how, hostile: [what, make] }) => {
      const [holder, key] = places[place % places.length]!;
      if (how === 0) Reflect.deleteProperty(holder, key);
      else Object.defineProperty(holder, key, { ...(how === 1 ? { get: throwing } : { value: make() }), ...OPEN });
      return `${key}: ${how === 0 ? "missing" : how === 1 ? "throws" : what}`;
    });
    const title = `${name} with ${said.join(", ")}`;
    const start = performance.now();
    const found = await outcomeOf(() => call(...given));
    // Any string is an address: `configure` must not leave one to the next case.
    main.configure({ worker: WORKER });
    const duration = Math.round(performance.now() - start);
    require(duration < 30_000, `${title} took ${duration} ms`);
    const errors = [...events.splice(0), ...("refused" in found ? [found.error] : [])];
    for (const error of errors.filter((one) => !isOwn(one))) {
      const code = error instanceof main.HprError || error instanceof lite.HprError ? error.code : undefined;
      const isAborted = error instanceof DOMException && error.name === "AbortError";
      require(isAborted ||
        (code !== undefined && code !== "internal"), `${title}: ${(error as Error).stack ?? String(error)}`);
    }
    // The wasm lives on.
    const { count } = main.hiddenPointRemoval(POSITIONS, [0, 0, 5]);
    witness.count ||= count;
    require(witness.count === count, `${title} changed what another cloud answers`);
  },
);
