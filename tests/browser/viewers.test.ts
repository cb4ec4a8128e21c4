// Published viewers of tiles. Through the filter they must draw the same points as one cloud.
import type { Page } from "playwright-core";
import type { BufferAttribute, Object3D, Points } from "three";
import { afterAll, beforeAll, describe, expect, it } from "vitest";

import { newPage } from "./browser.js";
import { serveModules } from "./modules.js";
import { cloud, type Files, potreeFiles, tilesFiles } from "./tiles.js";

interface Modules {
  three: typeof import("three");
  "hidden-point-removal": typeof import("hidden-point-removal");
  "hidden-point-removal/nodes": typeof import("hidden-point-removal/nodes");
  "potree-core": typeof import("potree-core");
  "3d-tiles-renderer/three": typeof import("3d-tiles-renderer/three");
}

const MODULES = {
  three: "/node_modules/three/build/three.module.js",
  "three/addons/": "/node_modules/three/examples/jsm/",
  "hidden-point-removal": "/dist/index.js",
  "hidden-point-removal/nodes": "/dist/nodes.js",
  "potree-core": "/node_modules/potree-core/dist/index.js",
  "3d-tiles-renderer/three": "/node_modules/3d-tiles-renderer/build/index.three.js",
};

let site: Awaited<ReturnType<typeof serveModules>>;

beforeAll(async () => {
  site = await serveModules(MODULES);
});

afterAll(() => {
  site.close();
});

async function pageWith(files: Files): Promise<Page> {
  const page = await newPage({ viewport: { width: 400, height: 400 } });
  await page.route("**/tiles/*", (route) => {
    const body = files.get(new URL(route.request().url()).pathname.split("/").at(-1)!)!;
    const [, from, to] = /^bytes=(\d+)-(\d+)$/.exec(route.request().headers()["range"] ?? "") ?? [];
    return from === undefined
      ? route.fulfill({ body })
      : route.fulfill({ status: 206, body: body.subarray(Number(from), Number(to) + 1) });
  });
  await page.goto(site.address);
  await page.waitForFunction(() => "modules" in globalThis);
  return page;
}

describe.each([
  ["potree-core", potreeFiles],
  ["3d-tiles-renderer", tilesFiles],
] as const)("%s", (viewer, files) => {
  it("draws the same points as one cloud, and then all points again", async () => {
    const page = await pageWith(files());
    const errors: string[] = [];
    page.on("pageerror", (error) => errors.push(String(error)));
    const found = await page.evaluate(async (name) => {
      const { modules } = globalThis as unknown as { modules: Modules };
      const { three: THREE, "hidden-point-removal": hpr, "hidden-point-removal/nodes": adapter } = modules;
      const renderer = new THREE.WebGLRenderer();
      renderer.setSize(200, 200);
      document.body.append(renderer.domElement);
      const scene = new THREE.Scene();
      scene.rotation.set(0.2, 0.3, 0.1);
      const camera = new THREE.PerspectiveCamera(60, 1, 0.1, 1000);

      /** The object whose space the cloud is in, and the viewer that chooses its nodes. */
      async function open(): Promise<{ root: Object3D; choose: () => void }> {
        if (name === "potree-core") {
          const potree = new modules["potree-core"].Potree();
          const octree = await potree.loadPointCloud("metadata.json", `${location.href}tiles/`);
          octree.minNodePixelSize = 0;
          return {
            root: octree,
            choose: () => {
              potree.updatePointClouds([octree], camera, renderer);
            },
          };
        }
        const tiles = new modules["3d-tiles-renderer/three"].TilesRenderer(`${location.href}tiles/tileset.json`);
        tiles.errorTarget = 1e-6;
        tiles.setCamera(camera);
        tiles.setResolutionFromRenderer(camera, renderer);
        return {
          root: tiles.group,
          choose: () => {
            tiles.update();
          },
        };
      }
      const { root, choose } = await open();
      scene.add(root);
      const place = (x: number, y: number, z: number) => {
        const center = new THREE.Vector3(...(name === "potree-core" ? [2, 2, 2] : [100, -20, 3]));
        scene.updateMatrixWorld(true);
        camera.position.copy(root.localToWorld(center.clone().add(new THREE.Vector3(x, y, z))));
        camera.lookAt(root.localToWorld(center));
        camera.updateMatrixWorld();
      };

      const filter = new adapter.HiddenPointNodesFilter(root, {
        settle: false,
        mode: "dim",
        dimMaterial: new THREE.PointsMaterial({ color: "red", size: 1, sizeAttenuation: false }),
      });
      const errors: string[] = [];
      filter.addEventListener("error", ({ error }) => errors.push(error.message));
      const asked: (number[] | null)[] = [];
      filter.addEventListener("change", ({ viewpoint }) => asked.push(viewpoint));
      const frame = async () => {
        choose();
        filter.update(camera);
        await new Promise((resolve) => setTimeout(resolve));
      };
      const isDimmed = ({ name: own }: Object3D) => own === "hidden points";
      const shown = () => {
        const nodes: Points[] = [];
        root.traverseVisible((object) => {
          if ("isPoints" in object && !isDimmed(object)) nodes.push(object as Points);
        });
        return nodes;
      };
      const total = () => shown().reduce((sum, { geometry }) => sum + geometry.attributes["position"]!.count, 0);

      /** The points in the root's space, at the places where the renderer draws them, and which of them are drawn. */
      const drawn = () => {
        const inverse = root.matrixWorld.clone().invert();
        const [positions, ids]: number[][] = [[], []];
        for (const { geometry, matrixWorld } of shown()) {
          const offset = new THREE.Vector3()
            .setFromMatrixPosition(inverse.clone().multiply(matrixWorld))
            .toArray()
            .map((x) => Math.round(x * 1024) / 1024);
          const first = positions!.length / 3;
          const { array, count } = geometry.attributes["position"] as BufferAttribute;
          for (let i = 0; i < 3 * count; i++) positions!.push(array[i]! + offset[i % 3]!);
          const { index, drawRange } = geometry;
          for (let i = 0; i < Math.min(drawRange.count, index?.count ?? count); i++) {
            ids!.push(first + (index?.getX(i) ?? i));
          }
        }
        return { positions: positions!, ids: ids! };
      };
      await hpr.init();
      const views = [];
      for (const [x, y, z] of [
        [0, 0, 6],
        [5, 2, -1],
      ] as const) {
        place(x, y, z);
        const before = asked.length;
        do await frame();
        while (total() < 6000 || !filter.settled || asked.length === before);
        await frame();
        renderer.render(scene, camera);
        const { positions, ids } = drawn();
        const expected = [...new hpr.PointCloud(positions).visibleFrom(asked.at(-1)!).indices];
        const children = shown().flatMap((node) =>
          node.children
            .filter((child) => isDimmed(child))
            .map((child) => child.visible && child.matrixWorld.equals(node.matrixWorld)),
        );
        views.push({
          count: filter.visibleCount,
          isSame: String(ids) === String(expected),
          positions: positions.length / 3,
          first: positions.slice(0, 3),
          nodes: shown().length,
          children,
        });
      }
      const all = drawn().positions;

      /** The pixels on which the viewer draws its own points, one pixel each. The background is blue, hidden points are red. */
      const pixels = () => {
        renderer.setClearColor("blue");
        for (const { material } of shown()) {
          Object.assign(material, { size: 1, sizeAttenuation: false, pointSizeType: 0, needsUpdate: true });
        }
        renderer.render(scene, camera);
        const data = new Uint8Array(4 * 200 * 200);
        renderer.getContext().readPixels(0, 0, 200, 200, 6408, 5121, data);
        const is = (i: number, [r, , b]: number[]) => Math.abs(data[i]! - r!) + Math.abs(data[i + 2]! - b!) < 40;
        const all = Array.from({ length: 200 * 200 }, (_, i) => 4 * i).filter((i) => !is(i, [0, 0, 255]));
        return { red: all.filter((i) => is(i, [255, 0, 0])), own: all.filter((i) => !is(i, [255, 0, 0])) };
      };
      const filtered = pixels();
      filter.dispose();
      const unfiltered = pixels();
      const own = new Set(unfiltered.own);
      const picture = {
        own: filtered.own.length,
        red: filtered.red.length,
        back: filtered.red.filter((i) => own.has(i)).length,
        lost: filtered.own.filter((i) => !own.has(i)).length,
        redAfterwards: unfiltered.red.length,
      };
      return { views, errors, all, picture, afterwards: drawn().ids.length };
    }, viewer);

    expect(errors).toEqual([]);
    expect(found.errors).toEqual([]);
    for (const { count, isSame, positions, nodes, children } of found.views) {
      expect(positions).toBe(6000);
      expect(nodes).toBeGreaterThan(20);
      expect(count).toBeGreaterThan(500);
      expect(count).toBeLessThan(4000);
      expect(isSame).toBe(true);
      // Hidden points are drawn at the node's place.
      expect(children).toEqual(Array(nodes).fill(true));
    }
    // Where hidden points were, the viewer draws its own points again.
    const { own, red, ...picture } = found.picture;
    expect(own).toBeGreaterThan(500);
    expect(red).toBeGreaterThan(100);
    expect(picture).toEqual({ back: red, lost: 0, redAfterwards: 0 });
    // All points are at the places in the file, except for the viewer's own offset.
    const offset = viewer === "potree-core" ? [-2, -2, -2] : [100, -20, 3];
    const sorted = (points: number[][]) => points.map(String).sort();
    const positions = Array.from({ length: 6000 }, (_, i) => found.all.slice(3 * i, 3 * i + 3));
    expect(
      sorted(
        positions.map((point) =>
          point.map((x, axis) => (viewer === "potree-core" ? x + offset[axis]! : x - offset[axis]!)),
        ),
      ),
    ).toEqual(sorted(cloud()));
    expect(found.afterwards).toBe(6000);
    await page.close();
  });
});
