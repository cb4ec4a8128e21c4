// Which boxes a tiled viewer need not load: `hidesBox` of the filter for nodes.
import * as THREE from "three";
import { init, PointCloud } from "hidden-point-removal";
import { HiddenPointNodesFilter, type HiddenPointNodesFilterOptions } from "hidden-point-removal/nodes";
import { afterEach, beforeAll, describe, expect, it } from "vitest";

import { dragon, split, whole } from "./nodes-support";
import { problemOf, randomNumbers } from "./support";

beforeAll(() => init());

const filters: HiddenPointNodesFilter[] = [];
afterEach(() => {
  for (const filter of filters.splice(0)) filter.dispose();
});

const points = dragon();
const low = [0, 1, 2].map((axis) =>
  points.reduce((least, x, i) => (i % 3 === axis ? Math.min(least, x) : least), Infinity),
);
const high = [0, 1, 2].map((axis) =>
  points.reduce((most, x, i) => (i % 3 === axis ? Math.max(most, x) : most), -Infinity),
);
const middle = low.map((x, axis) => (x + high[axis]!) / 2);
const size = high[0]! - low[0]!;

/** The dragon in tiles, and a camera in front of it, in a root that is turned and far away. */
function sceneOf(options?: HiddenPointNodesFilterOptions) {
  const nodes = split(points, 5);
  const root = new THREE.Group().add(...nodes);
  root.position.set(40, 7, -3);
  root.rotation.set(0.3, 0.2, 0.1);
  const camera = new THREE.PerspectiveCamera();
  const scene = new THREE.Scene().add(root, camera);
  const look = (x: number, y: number, z: number) => {
    root.updateMatrixWorld(true);
    camera.position.copy(
      root.localToWorld(new THREE.Vector3(middle[0]! + x * size, middle[1]! + y * size, middle[2]! + z * size)),
    );
    scene.updateMatrixWorld(true);
  };
  look(0, 0.2, 3);
  const filter = new HiddenPointNodesFilter(root, options);
  filters.push(filter);
  const changes: { viewpoint: number[] | null; radius: number }[] = [];
  filter.addEventListener("change", ({ viewpoint, radius }) => changes.push({ viewpoint, radius }));
  return { nodes, root, camera, filter, look, changes };
}

type Scene = ReturnType<typeof sceneOf>;

async function settle({ filter, camera }: Scene): Promise<void> {
  filter.update(camera);
  await expect.poll(() => filter.settled, { timeout: 60_000, interval: 5 }).toBe(true);
}

/** Small boxes everywhere around the dragon, the same ones each time. */
function boxes(count: number): [min: number[], max: number[]][] {
  const random = randomNumbers(9);
  return Array.from({ length: count }, () => {
    const min = low.map(
      (x, axis) => x + (1.4 * random() - 0.2) * (high[axis]! - x) - (axis === 2 ? size * random() : 0),
    );
    return [min, min.map((x) => x + 0.1 * size * random())];
  });
}

const proved = ({ filter }: Scene, count = 300) => boxes(count).filter(([min, max]) => filter.hidesBox(min, max));
/** A box behind the middle of the dragon, as the camera sees it. */
const behind = ({ filter }: Scene) =>
  filter.hidesBox(
    [middle[0]! - 0.01 * size, middle[1]! - 0.01 * size, low[2]! - size],
    [middle[0]!, middle[1]!, low[2]! - 0.9 * size],
  );

describe("hidesBox", () => {
  it.each<[string, HiddenPointNodesFilterOptions]>([
    ["with the automatic radius", {}],
    ["with an exponential inversion", { inversion: { exponential: 0.0005 } }],
    ["with a power", { inversion: { power: 4 } }],
    ["in a worker", { worker: true }],
  ])("is true only for boxes in which every point would be hidden, %s", async (_, options) => {
    const scene = sceneOf({ worker: false, ...options });
    expect(proved(scene)).toHaveLength(0);
    await settle(scene);
    const found = proved(scene);
    expect(found.length).toBeGreaterThan(20);
    const { viewpoint, radius } = scene.changes.at(-1)!;
    const cloud = new PointCloud(whole(scene.nodes));
    const { inversion } = options;
    const view = { ...(inversion && { inversion }), ...(radius > 0 && { radius }) };
    const random = randomNumbers(4);
    const samples = found.flatMap(([min, max]) =>
      Array.from({ length: 50 }, () => min.map((x, axis) => x + (max[axis]! - x) * random())).flat(),
    );
    expect(cloud.sees(viewpoint!, samples, view).some((seen) => seen === 1)).toBe(false);
    // The boxes on the side of the camera are not hidden.
    expect(
      scene.filter.hidesBox([middle[0]!, middle[1]!, high[2]! + size], [middle[0]!, middle[1]!, high[2]! + size]),
    ).toBe(false);
  });

  it("belongs to the present viewpoint", async () => {
    const scene = sceneOf({ worker: false });
    await settle(scene);
    expect(behind(scene)).toBe(true);
    scene.look(0, 0.2, -6);
    scene.filter.update(scene.camera);
    expect(behind(scene)).toBe(false);
    await settle(scene);
    expect(behind(scene)).toBe(false);
    scene.look(0, 0.2, 3);
    await settle(scene);
    expect(behind(scene)).toBe(true);
    scene.filter.enabled = false;
    expect(behind(scene)).toBe(false);
    scene.filter.enabled = true;
    expect(behind(scene)).toBe(true);
    scene.filter.dispose();
    expect(behind(scene)).toBe(false);
  });

  it("waits for the next answer when nodes come, unless the radius is a number", async () => {
    for (const [options, stays] of [
      [{}, false],
      [{ radius: 5000 }, true],
      [{ inversion: { exponential: 0.0005 } }, true],
    ] as const) {
      const scene = sceneOf({ worker: false, ...options });
      const [last] = scene.nodes.slice(-1);
      scene.root.remove(last!);
      await settle(scene);
      expect(behind(scene)).toBe(true);
      scene.root.add(last!);
      scene.filter.update(scene.camera);
      // The answer for the new node has not come yet.
      expect([options, behind(scene)]).toEqual([options, stays]);
      await settle(scene);
      expect(behind(scene)).toBe(true);
      // A node without a visible point may go, others may not.
      const unseen = scene.nodes.find((node) => scene.filter.visible.get(node)?.length === 0);
      scene.root.remove(unseen!);
      scene.filter.update(scene.camera);
      expect(behind(scene)).toBe(stays);
      await settle(scene);
      const seen = scene.nodes.find((node) => (scene.filter.visible.get(node)?.length ?? 0) > 0)!;
      scene.root.remove(seen);
      scene.filter.update(scene.camera);
      expect(behind(scene)).toBe(false);
      await settle(scene);
      expect(behind(scene)).toBe(true);
    }
  });

  it("has no answer for looks, noise and orthographic cameras", async () => {
    for (const options of [{ looks: 3 }, { vote: 6 }, { denoise: 6 }] as const) {
      const scene = sceneOf({ worker: false, ...options });
      await settle(scene);
      expect(proved(scene, 50)).toHaveLength(0);
    }
    const scene = sceneOf({ worker: false });
    const orthographic = new THREE.OrthographicCamera();
    orthographic.position.copy(scene.camera.position);
    orthographic.updateMatrixWorld();
    scene.filter.update(orthographic);
    await expect.poll(() => scene.filter.settled).toBe(true);
    expect(scene.filter.visibleCount).toBeGreaterThan(0);
    expect(proved(scene, 50)).toHaveLength(0);
  });

  it("keeps the operator's answer when looks settle", async () => {
    const scene = sceneOf({ worker: false, settle: { looks: 2 } });
    await settle(scene);
    expect(scene.filter.answer).toBe("looks");
    expect(behind(scene)).toBe(true);
  });

  it("refuses what is not a box", async () => {
    const { filter } = sceneOf({ worker: false });
    const loose = (value: unknown) => value as never;
    await expect(problemOf(() => filter.hidesBox([0, 0], [1, 1, 1]))).resolves.toMatchObject({ code: "option" });
    await expect(problemOf(() => filter.hidesBox([0, 0, 0], loose("box")))).resolves.toMatchObject({ code: "option" });
  });
});
