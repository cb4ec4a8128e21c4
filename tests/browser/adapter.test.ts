// The oldest three.js with the adapter: the points on the screen, and those that a ray meets. maps.test and webgpu.test have
// the newest one, with each renderer.
import { afterAll, expect, it } from "vitest";
import { modulesPage } from "./modules-page.js";

/** The modules that the page has imported. */
interface Modules {
  three: typeof import("three");
  "hidden-point-removal": typeof import("hidden-point-removal");
  "hidden-point-removal/three": typeof import("hidden-point-removal/three");
}

const MODULES = {
  three: "/node_modules/three-oldest/build/three.module.js",
  "hidden-point-removal": "/dist/index.js",
  "hidden-point-removal/three": "/dist/three.js",
};
const shared = modulesPage(MODULES);

afterAll(() => {
  expect(shared.said).toEqual([]);
});

// A red disc of points in front of a green disc. Both are equally large on the screen; green points lie between red ones.
it("draws and picks only visible points, and then all points again", async () => {
  const seen = await shared.page.evaluate(async () => {
    const { modules } = globalThis as unknown as { modules: Modules };
    const { three: THREE, "hidden-point-removal": hpr, "hidden-point-removal/three": adapter } = modules;
    const renderer = new THREE.WebGLRenderer({ preserveDrawingBuffer: true });
    renderer.setSize(200, 200);
    document.body.append(renderer.domElement);

    const [positions, colors]: number[][] = [[], []];
    for (let i = 0; i < 4000; i++) {
      const [r, turn] = [Math.sqrt((i + 0.5) / 4000), 2.399963 * i];
      positions!.push(
        r * Math.cos(turn),
        r * Math.sin(turn),
        0,
        1.4 * r * Math.cos(turn + 1),
        1.4 * r * Math.sin(turn + 1),
        -2,
      );
      colors!.push(1, 0, 0, 0, 1, 0);
    }
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(positions!), 3));
    geometry.setAttribute("color", new THREE.BufferAttribute(new Float32Array(colors!), 3));
    const points = new THREE.Points(
      geometry,
      new THREE.PointsMaterial({ size: 1, sizeAttenuation: false, vertexColors: true }),
    );
    const scene = new THREE.Scene().add(points);
    const camera = new THREE.PerspectiveCamera(40, 1, 0.1, 100);
    camera.position.set(0, 0, 5);
    camera.updateMatrixWorld();

    /** Counts pixels with some red, pixels with some green, and pixels with nearly full green. */
    const count = () => {
      renderer.render(scene, camera);
      const canvas = document.createElement("canvas");
      canvas.width = canvas.height = 200;
      const context = canvas.getContext("2d")!;
      context.drawImage(renderer.domElement, 0, 0, 200, 200);
      const { data } = context.getImageData(0, 0, 200, 200);
      let [red, green] = [0, 0];
      for (let i = 0; i < data.length; i += 4) {
        if (data[i]! > 8) red++;
        if (data[i + 1]! > 8) green++;
      }
      return { red, green };
    };
    /** Counts the red and green points that rays through the middle of the picture meet. */
    const pick = () => {
      const raycaster = new THREE.Raycaster();
      raycaster.params.Points.threshold = 0.05;
      const met = { red: 0, green: 0 };
      for (let x = -0.3; x <= 0.3; x += 0.1) {
        raycaster.setFromCamera(new THREE.Vector2(x, x / 2), camera);
        for (const { index } of raycaster.intersectObject(scene)) met[index! % 2 === 0 ? "red" : "green"]++;
      }
      return met;
    };

    const found = [{ drawn: count(), picked: pick() }];
    for (const mode of ["hide", "dim"] as const) {
      const filter = new adapter.HiddenPointFilter(points, { mode, settle: false });
      filter.update(camera);
      await filter.ready;
      found.push({ drawn: count(), picked: pick() });
      camera.position.z = -7;
      camera.lookAt(0, 0, 0);
      const changed = new Promise((resolve) => {
        filter.addEventListener("change", resolve);
      });
      filter.update(camera);
      await changed;
      found.push({ drawn: count(), picked: pick() });
      camera.position.z = 5;
      camera.lookAt(0, 0, 0);
      camera.updateMatrixWorld();
      filter.dispose();
      found.push({ drawn: count(), picked: pick() });
    }
    await hpr.init();
    const { indices } = new hpr.PointCloud(positions!).visibleFrom([0, 0, 5]);
    return { found, visibleRed: indices.filter((i) => i % 2 === 0).length };
  });

  const [before, hide, hideBehind, afterHide, dim, dimBehind, afterDim] = seen.found;
  expect(seen.visibleRed).toBe(4000);
  expect(before!.drawn.red).toBeGreaterThan(2000);
  expect(before!.drawn.green).toBeGreaterThan(1000);
  expect(before!.picked.green).toBeGreaterThan(0);
  // The remaining green points lie at the border. No red point is in front of them.
  expect(hide!.drawn.red).toBe(before!.drawn.red);
  expect(hide!.drawn.green).toBeLessThan(before!.drawn.green / 4);
  expect(hide!.picked).toEqual({ red: before!.picked.red, green: 0 });
  expect(hideBehind!.drawn.red).toBe(0);
  expect(hideBehind!.picked.red).toBe(0);
  expect(hideBehind!.picked.green).toBeGreaterThan(0);
  // Dimmed points are drawn, but cannot be picked.
  expect(dim!.drawn.green).toBeGreaterThan(hide!.drawn.green * 2);
  expect(dim!.picked).toEqual(hide!.picked);
  expect(dimBehind!.picked).toEqual(hideBehind!.picked);
  expect([afterHide, afterDim]).toEqual([before, before]);
});
