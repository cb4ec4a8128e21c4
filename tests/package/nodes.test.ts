// Many nodes that form one cloud. They must answer exactly like the cloud in one piece.
import type threads from "node:worker_threads";
import * as THREE from "three";
import { init, PointCloud, type VisibilityOptions } from "hidden-point-removal";
import {
  HiddenPointNodesFilter,
  type HiddenPointNodesFilterEvents,
  type HiddenPointNodesFilterOptions,
} from "hidden-point-removal/nodes";
import { HiddenPointFilter } from "hidden-point-removal/three";
import { afterEach, beforeAll, describe, expect, it } from "vitest";

import { cameraAt, pointsOf } from "./adapters";
import { watchedWorkers } from "./node-workers";
import { dragon, drawnOf, nodeOf, split, whole } from "./nodes-support";
import { bumpySphere } from "./support";

const filters: HiddenPointNodesFilter[] = [];

beforeAll(() => init());

afterEach(() => {
  for (const filter of filters.splice(0)) filter.dispose();
});

/** Nodes below a root that is turned and far away, and a camera in the root's space. */
function sceneOf(nodes: THREE.Points[], options?: HiddenPointNodesFilterOptions) {
  const root = new THREE.Group().add(...nodes);
  root.position.set(1000, 200, -300);
  root.rotation.set(0.1, 0.2, 0.3);
  const camera = new THREE.PerspectiveCamera();
  const scene = new THREE.Scene().add(root, camera);
  scene.updateMatrixWorld(true);
  const filter = new HiddenPointNodesFilter(root, { settle: false, ...options });
  filters.push(filter);
  const changes: HiddenPointNodesFilterEvents["change"][] = [];
  filter.addEventListener("change", (change) => changes.push(change));
  return { root, camera, scene, filter, changes };
}

type Scene = ReturnType<typeof sceneOf>;

/** Updates like an animation until everything is ready. */
async function settle({ filter, camera }: { filter: HiddenPointNodesFilter; camera: THREE.Camera }): Promise<void> {
  filter.update(camera);
  await expect.poll(() => filter.settled, { timeout: 60_000, interval: 5 }).toBe(true);
}

/** The answer of the unsplit cloud, for the viewpoint or direction of the nodes. */
function answerOf(
  nodes: THREE.Points[],
  { root, camera, changes }: Omit<Scene, "camera"> & { camera: THREE.Camera },
  options?: VisibilityOptions,
): number[] {
  const { viewpoint, direction, radius } = changes.at(-1)!;
  const cloud = new PointCloud(whole(nodes));
  const seen =
    direction === null
      ? root.worldToLocal(camera.position.clone())
      : new THREE.Vector3(0, 0, -1)
          .transformDirection(camera.matrixWorld)
          .transformDirection(root.matrixWorld.clone().invert());
  seen.toArray().forEach((x, axis) => {
    expect((viewpoint ?? direction)![axis]).toBeCloseTo(x, 9);
  });
  const answer =
    direction === null ? cloud.visibleFrom(viewpoint!, options) : cloud.visibleFromDirection(direction, options);
  expect(radius).toBe(answer.radius);
  return [...answer.indices];
}

describe("a cloud split into nodes", () => {
  it.each([true, false])("is seen exactly like the cloud in one piece, with worker: %s", async (worker) => {
    const nodes = split(dragon(), 10);
    expect(nodes.length).toBeGreaterThan(50);
    const scene = sceneOf(nodes, { worker });
    const { camera, root, changes } = scene;
    for (const place of [
      [0.3, 0.4, 0.5],
      [-0.05, 0.12, 0.1],
      [-0.02, 0.13, 0.0],
    ]) {
      camera.position.fromArray(root.localToWorld(new THREE.Vector3().fromArray(place)).toArray());
      await settle(scene);
      const { count, nodes: asked } = changes.at(-1)!;
      expect(asked).toBe(nodes.length);
      expect(count).toBe(scene.filter.visibleCount);
      expect(drawnOf(nodes)).toEqual(answerOf(nodes, scene));
    }
  });

  it("is seen so also after nodes have gone and come", async () => {
    const nodes = split(dragon(), 10);
    const [early, late] = [nodes.slice(0, 40), nodes.slice(40)];
    const scene = sceneOf(early);
    const { root, camera, changes } = scene;
    camera.position.fromArray(root.localToWorld(new THREE.Vector3(0.3, 0.4, 0.5)).toArray());
    const expectWhole = async (present: THREE.Points[]) => {
      await settle(scene);
      expect(changes.at(-1)!.nodes).toBe(present.length);
      expect(drawnOf(present)).toEqual(answerOf(present, scene));
    };
    await expectWhole(early);
    root.add(...late);
    await expectWhole(nodes);
    // Some nodes leave, and one is hidden. Later they come back.
    const left = nodes.filter((_, i) => i % 3 === 0);
    root.remove(...left);
    nodes[1]!.visible = false;
    const present = nodes.filter((_, i) => i % 3 !== 0 && i !== 1);
    await expectWhole(present);
    expect(left.every(({ geometry }) => geometry.index === null)).toBe(true);
    root.add(...left);
    nodes[1]!.visible = true;
    await expectWhole(nodes);
  });

  it("may consist of nested levels of detail", async () => {
    const positions = bumpySphere(3, 9000);
    const levels = [0, 1, 2].flatMap((level) => {
      const part = Float32Array.from(
        positions.filter((_, i) => [0, 1, 1, 2, 2, 2, 2, 2, 2][Math.floor(i / 3) % 9] === level),
      );
      return split(part, [1, 3, 6][level]!);
    });
    // Like an octree: each node is a child of another.
    const [first, ...others] = levels;
    const scene = sceneOf([first!]);
    for (const node of others) {
      node.position.sub(first!.position);
      first!.add(node);
    }
    scene.camera.position.fromArray(scene.root.localToWorld(new THREE.Vector3(1, 2, 4)).toArray());
    await settle(scene);
    const nested = levels.map((node) => {
      const at = node.clone(false);
      if (node !== first) at.position.add(first!.position);
      return at;
    });
    expect(drawnOf(levels)).toEqual(answerOf(nested, scene));
    expect(drawnOf(levels).length).toBeLessThan(5000);
  });

  // The automatic scale depends on all nodes together.
  const views: [name: string, options: VisibilityOptions][] = [
    ["an exponent", { exponent: 2.5 }],
    ["an automatic exponential", { inversion: { exponential: "auto" } }],
  ];

  it.each(views)("is seen with %s like one cloud", async (_, options) => {
    const nodes = split(bumpySphere(5, 4000), 5);
    const scene = sceneOf(nodes, options);
    scene.camera.position.fromArray(scene.root.localToWorld(new THREE.Vector3(2, 3, 4)).toArray());
    await settle(scene);
    expect(drawnOf(nodes)).toEqual(answerOf(nodes, scene, options));
  });

  it.each([["nothing else", {}], ...views] satisfies typeof views)(
    "is seen by an orthographic camera with %s like one cloud",
    async (_, options) => {
      const nodes = split(bumpySphere(5, 4000), 5);
      const scene = sceneOf(nodes, options);
      const camera = new THREE.OrthographicCamera();
      const { filter, changes } = scene;
      for (const turn of [0.3, 1.3]) {
        camera.rotation.set(turn, 0.4, 0.5);
        camera.updateMatrixWorld();
        await settle({ filter, camera });
        expect(drawnOf(nodes)).toEqual(answerOf(nodes, { ...scene, camera }, options));
      }
      expect(changes.map(({ viewpoint }) => viewpoint)).toEqual([null, null]);
      // Panning asks nothing. A new viewpoint asks.
      camera.position.set(3, 4, 5);
      await settle({ filter, camera });
      expect(changes).toHaveLength(2);
      scene.camera.position.fromArray(scene.root.localToWorld(new THREE.Vector3(2, 3, 4)).toArray());
      await settle(scene);
      expect(changes.at(-1)!.direction).toBeNull();
      expect(drawnOf(nodes)).toEqual(answerOf(nodes, scene, options));
    },
  );

  it("may be listed by its viewer, and edited or moved", async () => {
    const nodes = split(bumpySphere(1, 3000), 3);
    let listed = nodes.slice(0, 10);
    const scene = sceneOf(nodes, { nodes: () => listed });
    const { root, camera } = scene;
    camera.position.fromArray(root.localToWorld(new THREE.Vector3(0, 0, 5)).toArray());
    const expectWhole = async () => {
      await settle(scene);
      expect(drawnOf(listed)).toEqual(answerOf(listed, scene));
    };
    await expectWhole();
    listed = nodes;
    await expectWhole();
    const position = nodes[3]!.geometry.attributes["position"]!;
    position.array.fill(0.01, 0, 30);
    position.needsUpdate = true;
    await expectWhole();
    nodes[4]!.position.x += 0.25;
    await expectWhole();
    listed = [];
    await settle(scene);
    expect(drawnOf(nodes)).toHaveLength(3000);
    expect(scene.filter.visibleCount).toBe(0);
  });
});

describe("recovers from the death of the worker", () => {
  /** Called with the first message of a worker. A fast worker sends it before anybody could ask for it. */
  let atFirstMessage: (worker: threads.Worker) => void = () => undefined;
  watchedWorkers((worker) => {
    worker.once("message", () => atFirstMessage(worker));
  });

  it("while it prepares several nodes", async () => {
    const nodes = split(bumpySphere(1, 3000), 3);
    const scene = sceneOf(nodes);
    const errors: unknown[] = [];
    scene.filter.addEventListener("error", ({ error }) => errors.push(error));
    scene.camera.position.fromArray(scene.root.localToWorld(new THREE.Vector3(0, 0, 5)).toArray());
    // After the worker has started, and before any node is ready.
    const dead = new Promise<void>((resolve, reject) => {
      atFirstMessage = (worker) => {
        atFirstMessage = () => undefined;
        worker.removeAllListeners("message");
        worker.terminate().then(() => resolve(), reject);
      };
    });
    scene.filter.update(scene.camera);
    await dead;
    await settle(scene);
    expect(errors).toEqual([]);
    expect(scene.changes.at(-1)!.nodes).toBe(nodes.length);
    expect(drawnOf(nodes)).toEqual(answerOf(nodes, scene));
  });
});

it("treats a node that is listed twice as one, and comes to rest", async () => {
  const nodes = split(bumpySphere(1, 3000), 2);
  const scene = sceneOf(nodes, { nodes: () => [...nodes, ...nodes] });
  scene.camera.position.fromArray(scene.root.localToWorld(new THREE.Vector3(0, 0, 5)).toArray());
  await settle(scene);
  await settle(scene);
  expect(drawnOf(nodes)).toEqual(answerOf(nodes, scene));
  scene.filter.update(scene.camera);
  expect(scene.filter.settled).toBe(true);
});

describe("refuses", () => {
  const codes = (filter: HiddenPointNodesFilter) => {
    const told: string[] = [];
    filter.addEventListener("error", ({ error, points }) =>
      told.push(`${(error as { code?: string }).code ?? error.message} ${points?.name ?? "view"}`),
    );
    return told;
  };

  it("a value that is no root, a list that is no function, and a stretched root", () => {
    for (const root of [{}, null, undefined]) {
      expect(() => new HiddenPointNodesFilter(root as never)).toThrow(
        expect.objectContaining({ code: "option", message: expect.stringMatching(/root/) as string }),
      );
    }
    const root = new THREE.Group();
    expect(() => new HiddenPointNodesFilter(root, { nodes: [] as never })).toThrow(/nodes/);
    root.scale.x = 2;
    expect(() => new HiddenPointNodesFilter(root)).toThrow(/scale/);
  });

  it("once, a list entry that is not a node", () => {
    const scene = sceneOf([new THREE.Points()], { nodes: () => [new THREE.Mesh(), undefined] as never });
    const told = codes(scene.filter);
    for (let i = 0; i < 3; i++) scene.filter.update(scene.camera);
    expect(told).toEqual(["option view"]);
  });

  it("a node whose geometry has a filter, until it gets another geometry", async () => {
    const nodes = split(bumpySphere(1, 3000), 2);
    const shared = new THREE.Points(nodes[0]!.geometry);
    shared.name = "shared";
    const scene = sceneOf([...nodes, shared]);
    const told = codes(scene.filter);
    scene.camera.position.fromArray(scene.root.localToWorld(new THREE.Vector3(0, 0, 5)).toArray());
    for (let i = 0; i < 3; i++) await settle(scene);
    expect(told).toEqual(["option shared"]);
    expect(drawnOf(nodes)).toEqual(answerOf(nodes, scene));
    shared.geometry = nodes[0]!.geometry.clone();
    shared.geometry.setIndex(null).setDrawRange(0, Infinity);
    shared.position.copy(nodes[0]!.position);
    await settle(scene);
    expect(scene.changes.at(-1)!.nodes).toBe(nodes.length + 1);
    expect(told).toEqual(["option shared"]);
  });

  it("a node, once, and goes on with the others", async () => {
    const nodes = split(bumpySphere(1, 3000), 3);
    const broken = nodeOf(
      [
        [0, 0, 0],
        [NaN, 0, 0],
      ],
      [0, 0, 0],
    );
    broken.name = "broken";
    const morphing = nodeOf([[0, 0, 0]], [0, 0, 0]);
    morphing.name = "morphing";
    morphing.geometry.morphAttributes["position"] = [morphing.geometry.attributes["position"] as THREE.BufferAttribute];
    const filtered = nodeOf([[0, 0, 0]], [0, 0, 0]);
    filtered.name = "filtered";
    const other = new HiddenPointFilter(filtered, { worker: false });
    const scene = sceneOf([...nodes, broken, morphing, filtered]);
    const told = codes(scene.filter);
    scene.camera.position.fromArray(scene.root.localToWorld(new THREE.Vector3(0, 0, 5)).toArray());
    await settle(scene);
    for (let i = 0; i < 5; i++) await settle(scene);
    expect(told.sort()).toEqual(["non-finite broken", "option filtered", "option morphing"]);
    expect(drawnOf(nodes)).toEqual(answerOf(nodes, scene));
    broken.geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(6), 3));
    await settle(scene);
    expect(scene.changes.at(-1)!.nodes).toBe(nodes.length + 1);
    other.dispose();
  });
});

describe("nodes that wait for their first answer", () => {
  const isDrawn = (points: THREE.Points) => points.layers.mask !== 0;

  it("are not drawn with `pending: hide`, and have their layers back afterwards", async () => {
    const { points, group } = pointsOf(bumpySphere(5, 3000));
    const filter = new HiddenPointNodesFilter(group, { pending: "hide" });
    filters.push(filter);
    const camera = cameraAt(0, 0, 5);
    points.layers.enable(3);
    const before = points.layers.mask;
    filter.update(camera);
    expect([isDrawn(points), filter.visible.get(points)!.length]).toEqual([false, 0]);
    await expect.poll(() => filter.settled).toBe(true);
    expect(points.layers.mask).toBe(before);

    const later = pointsOf(bumpySphere(5, 3000).map((x) => x + 3)).points;
    group.add(later);
    filter.update(camera);
    expect([isDrawn(points), isDrawn(later)]).toEqual([true, false]);
    filter.enabled = false;
    expect(isDrawn(later)).toBe(true);
    filter.enabled = true;
    const last = pointsOf(bumpySphere(5, 3000).map((x) => x - 3)).points;
    group.add(last);
    filter.update(camera);
    filter.dispose();
    expect([isDrawn(later), isDrawn(last)]).toEqual([true, true]);
  });

  it("are drawn by default, and if they are refused", async () => {
    const usual = pointsOf(bumpySphere(5, 3000));
    const filter = new HiddenPointNodesFilter(usual.group);
    filters.push(filter);
    filter.update(cameraAt(0, 0, 5));
    expect(isDrawn(usual.points)).toBe(true);

    const broken = pointsOf(Float32Array.of(0, 0, NaN));
    const hiding = new HiddenPointNodesFilter(broken.group, { pending: "hide" });
    filters.push(hiding);
    hiding.addEventListener("error", () => undefined);
    hiding.update(cameraAt(0, 0, 5));
    await expect.poll(() => isDrawn(broken.points)).toBe(true);
    expect(() => new HiddenPointNodesFilter(broken.group, { pending: "no" as "hide" })).toThrow(/pending must be/);
  });
});
