// The filters for three's WebGPU renderer, on both of its backends: what is drawn, read from pixels.
import { afterAll, expect, it } from "vitest";
import { modulesPage } from "./modules-page.js";

interface Modules {
  "three/webgpu": typeof import("three/webgpu");
  "hidden-point-removal": typeof import("hidden-point-removal");
  "hidden-point-removal/three/webgpu": typeof import("hidden-point-removal/three/webgpu");
}

declare const modules: Modules;

const shared = modulesPage({
  three: "/node_modules/three/build/three.module.js",
  "three/webgpu": "/node_modules/three/build/three.webgpu.js",
  "three/tsl": "/node_modules/three/build/three.tsl.js",
  "hidden-point-removal": "/dist/index.js",
  "hidden-point-removal/three/webgpu": "/dist/three-webgpu.js",
});

afterAll(() => {
  expect(shared.said).toEqual([]);
});

it.each([
  ["WebGPU", false],
  ["WebGL 2", true],
] as const)("draw by maps while the camera moves, with %s", async (_, forceWebGL) => {
  const found = await shared.page.evaluate(async (forceWebGL) => {
    const THREE = modules["three/webgpu"];
    const { HiddenPointFilter, HiddenPointNodesFilter } = modules["hidden-point-removal/three/webgpu"];
    const { init, PointCloud } = modules["hidden-point-removal"];
    await init();
    const [SIZE, COUNT] = [300, 20_000];
    THREE.ColorManagement.enabled = false;
    const renderer = new THREE.WebGPURenderer({ forceWebGL });
    await renderer.init();
    const { isWebGPUBackend = false } = renderer.backend as { isWebGPUBackend?: boolean };
    if (isWebGPUBackend === forceWebGL) return null;
    const target = new THREE.RenderTarget(SIZE, SIZE);
    renderer.setRenderTarget(target);

    const positions = new Float32Array(3 * COUNT);
    const bytes = new Uint8Array(3 * COUNT);
    for (let i = 0; i < COUNT; i++) {
      const up = 1 - (2 * (i + 0.5)) / COUNT;
      const radius = (2 + 0.2 * Math.sin(16.8 * i)) * Math.sqrt(1 - up * up);
      positions.set([radius * Math.cos(2.399963 * i), 2 * up, radius * Math.sin(2.399963 * i)], 3 * i);
      bytes.set([(i + 1) & 255, ((i + 1) >> 8) & 255, 255], 3 * i);
    }
    const cloud = new PointCloud(positions);
    const make = (first: number, last: number, material: InstanceType<typeof THREE.Material>) => {
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute("position", new THREE.BufferAttribute(positions.slice(3 * first, 3 * last), 3));
      geometry.setAttribute("color", new THREE.BufferAttribute(bytes.slice(3 * first, 3 * last), 3, true));
      return new THREE.Points(geometry, material);
    };
    const frame = () => new Promise((resolve) => requestAnimationFrame(resolve));
    const reports = [];
    for (const [name, material, options] of [
      ["node", new THREE.PointsNodeMaterial({ vertexColors: true }), {}],
      ["plain", new THREE.PointsMaterial({ vertexColors: true, size: 1, sizeAttenuation: false }), {}],
      ["dim", new THREE.PointsNodeMaterial({ vertexColors: true }), { mode: "dim" as const }],
      ["nodes", new THREE.PointsNodeMaterial({ vertexColors: true }), {}],
    ] as const) {
      const group = new THREE.Group();
      if (name === "nodes") {
        for (let k = 0; k < 4; k++) {
          const node = make(5000 * k, 5000 * (k + 1), material);
          node.geometry.translate(0, 0, -k);
          node.position.z = k;
          group.add(node);
        }
      } else {
        group.add(make(0, COUNT, material));
      }
      // The same material, without a filter.
      const other = make(0, COUNT, material);
      other.position.x = 100;
      const scene = new THREE.Scene().add(group, other);
      const camera = new THREE.PerspectiveCamera(40, 1, 0.1, 1000);
      const at = (degrees: number) => {
        const turn = (degrees * Math.PI) / 180;
        camera.position.set(9 * Math.sin(turn), 1, 9 * Math.cos(turn));
        camera.lookAt(0, 0, 0);
        camera.updateMatrixWorld();
      };
      const pixels = async () => {
        renderer.render(scene, camera);
        const data = (await renderer.readRenderTargetPixelsAsync(target, 0, 0, SIZE, SIZE)) as Uint8Array;
        const seen = { drawn: new Set<number>(), faint: 0 };
        for (let i = 0; i < data.length; i += 4) {
          if (data[i + 2] === 255) seen.drawn.add(data[i]! + 256 * data[i + 1]! - 1);
          else if (data[i + 2]! > 20) seen.faint++;
        }
        return seen;
      };
      const filter =
        name === "nodes"
          ? new HiddenPointNodesFilter(group)
          : new HiddenPointFilter(group.children[0] as never, options);
      const kinds: string[] = [];
      let viewpoint: number[] = [];
      filter.addEventListener("change", ({ answer, camera: { position } }) => {
        kinds.push(answer);
        viewpoint = position.toArray();
      });
      at(0);
      do {
        filter.update(camera);
        await pixels();
        await frame();
      } while (!filter.settled || filter.answer !== "looks");
      const settled = await pixels();
      kinds.length = 0;
      let [maps, mismatched, wrong] = [0, 0, 0];
      let moving = settled;
      for (let degrees = 2; degrees <= 12; degrees += 2) {
        const before = kinds.length;
        at(degrees);
        for (let tries = 0; kinds.length === before && tries < 300; tries++) {
          filter.update(camera);
          await frame();
        }
        maps += Number(kinds[before] === "map");
        // The answer at rest may come while the pixels are read.
        const { visible } = filter;
        moving = await pixels();
        const listed = new Set(
          visible instanceof Map
            ? group.children.flatMap((node, k) => Array.from(visible.get(node as never)!, (i) => i + 5000 * k))
            : visible,
        );
        for (const id of moving.drawn) if (!listed.has(id)) mismatched++;
        for (const id of cloud.visibleFrom(viewpoint, { looks: 3 }).indices) if (!listed.has(id)) wrong++;
      }
      filter.dispose();
      const all = await pixels();
      reports.push({
        name,
        settled: settled.drawn.size,
        moving: moving.drawn.size,
        faint: [settled.faint, moving.faint],
        all: all.drawn.size,
        maps,
        mismatched,
        wrong,
        isOwn: (material as { vertexNode?: unknown }).vertexNode == null,
      });
    }
    cloud.dispose();
    return reports;
  }, forceWebGL);
  console.table(found);
  for (const { name, settled, moving, faint, all, maps, mismatched, wrong, isOwn } of found!) {
    expect(maps).toBe(6);
    // The card tests nodes that are elsewhere with wider borders of cells, and a dimmed point may be as bright as a visible one.
    expect(mismatched).toBeLessThan(100);
    // Of 8,000 points that three looks show, at most one in a hundred is left out in a frame.
    expect(wrong).toBeLessThan(6 * 80);
    expect(moving).toBeGreaterThan(0.9 * settled);
    expect(moving).toBeLessThan(1.3 * settled);
    expect(all).toBeGreaterThan(1.7 * settled);
    expect(isOwn).toBe(true);
    if (name === "dim") expect(faint[1]!).toBeGreaterThan(0.6 * faint[0]!);
  }
});
