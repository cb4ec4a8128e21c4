// Arguments as users hold them, for every question here and in workers: vectors of classes, records without a prototype,
// arrays that change after the call, signals with a reason.
import * as hpr from "hidden-point-removal";
import { init, type Viewpoint } from "hidden-point-removal";
import { colmapVis } from "hidden-point-removal/files";
import { PointCloud as LitePointCloud, init as initLite } from "hidden-point-removal/lite";
import { HiddenPointNodesFilter } from "hidden-point-removal/nodes";
import { HiddenPointFilter } from "hidden-point-removal/three";
import { WorkerPointCloud } from "hidden-point-removal/worker";
import { BufferAttribute, BufferGeometry, Group, PerspectiveCamera, Points, Quaternion, Vector3 } from "three";
import { afterAll, describe, expect, it } from "vitest";

import { transferredAway } from "../fuzz/border/argument";
import { outcomeOf } from "../fuzz/border/outcome";
import { type AnyCloud, asked, CAMERAS, Part, QUESTIONS } from "../fuzz/border/table";
import { bumpySphere, expectRefusal, problemOf } from "./support";

await Promise.all([init(), initLite()]);
const { HprError, PointCloud } = hpr;
const positions = bumpySphere(3, 3000);
const ALL = new Part(positions.length / 3);
const cloud = new PointCloud(positions);
const remote = await WorkerPointCloud.create(positions, { workers: 2 });
afterAll(() => remote.dispose());

/** A vector of a library whose `length` is a method. */
class Vector {
  readonly x: number;
  readonly y: number;
  readonly z: number;

  constructor(x: number, y: number, z: number) {
    [this.x, this.y, this.z] = [x, y, z];
  }

  length(): number {
    return Math.hypot(this.x, this.y, this.z);
  }
}

const FAR = [0.5, 1, 5] as const;
const bare = Object.assign(Object.create(null) as object, { x: FAR[0], y: FAR[1], z: FAR[2] });
const PLACES = [new Vector3(...FAR), new Vector(...FAR), bare, Float64Array.from(FAR)];

const IMAGE = { data: Float32Array.from({ length: 32 * 24 }, (_, i) => i), width: 32, height: 24 };

/** A map of directions is compared by what it hides. A calibration gives back the caller's own options. */
const told = async (answer: unknown) => {
  const known = await answer;
  if (known instanceof hpr.VisibilityMap) return known.hides(positions);
  return typeof known === "object" && known !== null && "recall" in known ? { ...known, options: undefined } : known;
};

/** Calls `act` with each object and array in a tree of arguments. */
function within(tree: unknown, act: (node: object) => void): void {
  if (typeof tree !== "object" || tree === null) return;
  act(tree);
  if (!ArrayBuffer.isView(tree)) Object.values(tree).forEach((branch) => within(branch, act));
}

describe.each(Object.keys(QUESTIONS))("%s", (name) => {
  const args = (at: unknown) => QUESTIONS[name]!(at, ALL, ALL.length);
  const ask = (of: AnyCloud, more?: object, at: unknown = FAR) => told(asked(of, name, args(at), more));
  const takesWithin = name !== "autoRadius";
  const mask = () => Uint8Array.from(positions.subarray(0, ALL.length), (_, i) => i % 4);

  it("takes vectors of any class, and records without a prototype", async () => {
    for (const of of [cloud, remote]) {
      const expected = await ask(of);
      for (const at of PLACES) {
        const given = args(at);
        within(given.at(-1), (node) =>
          Reflect.setPrototypeOf(node, ArrayBuffer.isView(node) ? Float64Array.prototype : null),
        );
        expect(await told(asked(of, name, given))).toEqual(expected);
      }
    }
  });

  it("is not changed by what somebody added to Object.prototype", async () => {
    const added = {
      looks: 2,
      exponent: 1,
      mask: new Uint8Array(3000),
      convention: "opencv",
      scores: true,
      length: 7,
      channels: 4,
    };
    for (const of of [cloud, remote]) {
      const expected = await ask(of);
      Object.assign(Object.prototype, added);
      const found = Promise.resolve(ask(of)).finally(() => {
        for (const key of Object.keys(added)) Reflect.deleteProperty(Object.prototype, key);
      });
      expect(await found).toEqual(expected);
    }
  });

  it("in a worker takes arguments as they are at the call", async () => {
    const options = () => (takesWithin ? { within: { mask: mask() } } : {});
    const expected = await ask(cloud, options());
    const damages: ((node: object) => void)[] = [
      (node) => ArrayBuffer.isView(node) && new Uint8Array(node.buffer).fill(77),
      (node) => ArrayBuffer.isView(node) && transferredAway(node),
      (node) => !ArrayBuffer.isView(node) && Object.keys(node).forEach((key) => Reflect.deleteProperty(node, key)),
    ];
    for (const damage of damages) {
      const [given, more] = [args(Float64Array.from(FAR)), options()];
      const found = told(asked(remote, name, given, more));
      within([given, more], damage);
      expect(await found).toEqual(expected);
    }
  });

  it("refuses arrays whose memory is gone", async () => {
    const views: object[] = [];
    within(args(Float64Array.from(FAR)), (node) => ArrayBuffer.isView(node) && views.push(node));
    for (const [lost] of views.entries()) {
      const given = args(Float64Array.from(FAR));
      let next = 0;
      within(given, (node) => {
        if (ArrayBuffer.isView(node) && next++ === lost) transferredAway(node);
      });
      for (const of of [cloud, remote]) expect(await problemOf(() => asked(of, name, given))).toBeInstanceOf(HprError);
    }
  });

  it("in a worker rejects with the reason of its signal, and drops what a newer question overtakes", async () => {
    const reason = new TypeError("the user went on");
    expect(await problemOf(() => ask(remote, { signal: AbortSignal.abort(null) }))).toBeNull();
    const controller = new AbortController();
    const given = problemOf(() => ask(remote, { signal: controller.signal }));
    controller.abort(reason);
    expect(await given).toBe(reason);
    expect(await problemOf(() => ask(remote, { signal: AbortSignal.abort(reason) }))).toBe(reason);
    const expected = await ask(cloud);
    const busy = Array.from({ length: 4 }, () => ask(remote));
    const [old, newer] = [problemOf(() => ask(remote, { latest: true })), ask(remote, { latest: true })];
    expect([(await old).name, await newer]).toEqual(["AbortError", expected]);
    expect(await Promise.all(busy)).toEqual(busy.map(() => expected));
  });

  it("tells its progress, or refuses to", async () => {
    // Here, `autoRadius` takes no options.
    for (const of of name === "autoRadius" ? [remote] : [cloud, remote]) {
      const heard: number[] = [];
      const onProgress = (share: number) => heard.push(share);
      const outcome = await outcomeOf(() => ask(of, { onProgress }));
      const isMany = ["coverage", "seenBy", "placeViewpoints", "transfer"].includes(name);
      expect("refused" in outcome ? outcome.refused : heard.at(-1)).toBe(isMany ? 1 : "option");
      expect(heard).toEqual([...heard].sort((a, b) => a - b));
    }
  });
});

it("takes vectors wherever a place stands", () => {
  const [low, high, turn] = [new Vector3(-1, -1, -0.3), new Vector3(0.7, 1, 1), new Quaternion(0, 0, 0, 2)];
  const within = (box: readonly [Viewpoint, Viewpoint]) => cloud.visibleFrom(FAR, { within: { box } }).indices;
  expect(within([low, high])).toEqual(within([low.toArray(), high.toArray()]));
  const horizon = new hpr.Horizon(new Vector3(...FAR), { radius: 100 });
  expect(horizon.hidesBox(low, high)).toBe(horizon.hidesBox(low.toArray(), high.toArray()));
  horizon.dispose();
  const posed = hpr.cameraFromPose(low.toArray(), [0, 0, 0, 2], CAMERAS[0]!);
  expect(hpr.cameraFromPose(low, turn, CAMERAS[0]!)).toEqual(posed);
});

describe.each([
  ["here", () => Promise.resolve(new PointCloud(positions))],
  ["in a worker", () => WorkerPointCloud.create(positions)],
  ["of lite", () => Promise.resolve(new LitePointCloud(positions))],
])("indices to remove, %s", (_, make) => {
  it.each<[RegExp, () => object]>([
    [/transferred away, got an object of type Uint32Array/, () => transferredAway(Uint32Array.of(1, 2))],
    [/transferred away, got an object of type Float64Array/, () => transferredAway(Float64Array.of(1, 2))],
    [/got a mask/, () => cloud.visibleFrom(FAR).mask()],
    [/got a mask/, () => [...cloud.visibleFrom(FAR).mask()]],
  ])("must not be what %s names", async (names, indices) => {
    const own = await make();
    await expectRefusal("option", names, () => own.remove(indices() as never));
    expect((await own.visibleFrom(FAR)).indices).toEqual(cloud.visibleFrom(FAR).indices);
    await own.dispose();
  });
});

it("a filter takes its cloud, its nodes and its listeners from functions that give some", async () => {
  const points = () => new Points(new BufferGeometry().setAttribute("position", new BufferAttribute(positions, 3)));
  const camera = new PerspectiveCamera();
  camera.position.set(...FAR);
  const settled = async (filter: HiddenPointFilter | HiddenPointNodesFilter) => {
    const error = new Promise((heard) => filter.addEventListener("error", (event) => heard(event.error)));
    filter.update(camera);
    const found = await Promise.race([error, filter.ready.then(() => filter.visibleCount)]);
    filter.dispose();
    return found;
  };
  const final = { settle: false, stale: "keep", worker: false } as const;
  const by = (made: unknown) => settled(new HiddenPointFilter(points(), { ...final, cloud: (() => made) as never }));
  expect(await by(new PointCloud(positions))).toBe(cloud.visibleFrom(FAR).count);
  for (const junk of [null, undefined, 5, {}, Promise.resolve(null)]) {
    expect(await by(junk)).toMatchObject({ code: "option" });
    const nodes = () => (junk instanceof Promise ? [junk] : junk);
    const filter = new HiddenPointNodesFilter(new Group(), { ...final, nodes: nodes as never });
    expect(await settled(filter)).toMatchObject({ code: "option" });
    const hearing = new HiddenPointFilter(points(), final);
    await expectRefusal("option", /listener/, () => hearing.addEventListener("change", junk as never));
    hearing.dispose();
  }
  const lost = points();
  const filter = new HiddenPointFilter(lost, final);
  Object.assign(lost.geometry.attributes["position"]!, { array: transferredAway(positions.slice()) });
  lost.geometry.attributes["position"]!.needsUpdate = true;
  expect(await settled(filter)).toMatchObject({ code: "positions-type" });
});

it.each<[string, () => unknown]>([
  ["visibleFromCamera", () => cloud.visibleFromCamera([0, 0, 5] as never)],
  ["transfer", () => hpr.transfer(undefined as never, [], [])],
  ["transfer", () => hpr.transfer(cloud, [], null as never)],
  ["transfer", () => hpr.transfer(cloud, [CAMERAS[0]!], [{ data: IMAGE.data, width: 64n, height: 48 }] as never)],
  ["calibrate", () => cloud.calibrate([null] as never)],
  ["colmapVis", () => colmapVis(null as never)],
  ["colmapVis", () => colmapVis({ offsets: { at: () => 0, length: 1 }, cameras: [] } as never)],
  ["orientNormals", () => hpr.orientNormals(new Float32Array(3), null as never)],
  ["intrinsicsFromFieldOfView", () => hpr.intrinsicsFromFieldOfView(1n as never, 2, 2)],
  ["intrinsicsFromFieldOfView", () => hpr.intrinsicsFromFieldOfView(50, 2n as never, 2)],
  ["cameraFromPose", () => hpr.cameraFromPose({ length: 1e15 }, [0, 0, 0, 1], CAMERAS[0]!)],
  ["cameraFromThree", () => hpr.cameraFromThree({ isPerspectiveCamera: true } as never, 4, 4)],
])("%s refuses junk with an HprError", async (_, call) => {
  expect(await problemOf(call)).toBeInstanceOf(HprError);
});
