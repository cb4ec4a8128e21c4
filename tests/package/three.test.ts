// The adapter for three.js: the points that it draws, its viewpoint, and what it restores.
import { afterEach, beforeAll, describe, expect, it } from "vitest";

import { bumpySphere, randomNumbers } from "./support";
import { type Adapter, adapterFor, drawn, type Filter, type Scene, sceneOf, VERSIONS } from "./three-support";

const sphere = bumpySphere(1, 3000);

describe.each(VERSIONS)("with %s", (name, load) => {
  let adapter: Adapter;
  const filters: Filter[] = [];

  beforeAll(async () => {
    adapter = await adapterFor(load);
    await adapter.init();
  });

  afterEach(() => {
    for (const filter of filters.splice(0)) filter.dispose();
  });

  function filterFor(
    points: Scene["points"],
    options?: ConstructorParameters<Adapter["HiddenPointFilter"]>[1],
  ): Filter {
    // What is asked at rest comes 0.1 s after the last answer, on a slow machine in the middle of a test.
    const filter = new adapter.HiddenPointFilter(points, { settle: false, ...options });
    filters.push(filter);
    return filter;
  }

  const visibleFrom = (viewpoint: ArrayLike<number>, options = {}, positions: Float32Array | Float64Array = sphere) => [
    ...new adapter.PointCloud(positions).visibleFrom(viewpoint, options).indices,
  ];

  it("runs with the expected version of three.js", () => {
    const { points, camera } = sceneOf(adapter, sphere);
    expect(adapter.THREE.REVISION).toMatch(name === "three" ? /^1[89]\d/ : /^159$/);
    filterFor(points, { worker: false }).update(camera);
    expect(points.geometry.index).toBeInstanceOf(adapter.THREE.BufferAttribute);
  });

  it("is ready without a view, too, and answers at once without a worker", async () => {
    const inWorker = filterFor(sceneOf(adapter, sphere).points);
    await inWorker.ready;
    expect(inWorker.visibleCount).toBe(3000);

    const { points, camera, geometry } = sceneOf(adapter, sphere);
    const filter = filterFor(points, { worker: false });
    filter.update(camera);
    expect(drawn(geometry)).toEqual(visibleFrom([0, 0, 5]));
  });

  it("loads the wasm by itself", async () => {
    const fresh = await adapterFor(load);
    const { points, camera, geometry } = sceneOf(fresh, sphere);
    const filter = new fresh.HiddenPointFilter(points, { worker: false, settle: false });
    filter.update(camera);
    await filter.ready;
    expect(drawn(geometry)).toEqual(visibleFrom([0, 0, 5]));
    filter.dispose();
    expect(drawn(geometry)).toHaveLength(3000);
  });

  describe("asks again", () => {
    /** How many answers the last change made. */
    function answersAfter({ points }: Scene, camera: Scene["points"]["parent"], change: () => void): number {
      // Without a worker, because then it answers at once.
      const filter = filterFor(points, { worker: false });
      let answers = 0;
      filter.addEventListener("change", () => answers++);
      filter.update(camera as never);
      expect(answers).toBe(1);
      change();
      filter.update(camera as never);
      filter.update(camera as never);
      return answers - 1;
    }

    const group = () => new adapter.THREE.Group();

    it.each<[name: string, answers: number, change: (scene: Scene) => void]>([
      ["nothing happens", 0, () => undefined],
      ["a perspective camera turns", 0, ({ camera }) => camera.rotation.set(1, 2, 3)],
      [
        "its field of view changes",
        0,
        ({ camera }) => {
          Object.assign(camera, { fov: 20, zoom: 3 }).updateProjectionMatrix();
        },
      ],
      ["it moves", 1, ({ camera }) => camera.position.setX(0.1)],
      ["it moves a little", 1, ({ camera }) => camera.position.setX(1e-3)],
      ["it moves too little to be seen", 0, ({ camera }) => camera.position.setX(1e-6)],
      ["the points move", 1, ({ points }) => points.position.set(0, 1, 0)],
      ["the points turn", 1, ({ points }) => points.rotation.set(0.1, 0, 0)],
      ["the points shrink", 1, ({ points }) => points.scale.setScalar(0.5)],
      [
        "a group moves that holds both",
        0,
        ({ scene, points, camera }) => {
          const both = group().add(points, camera);
          both.position.set(1e4, 77.3, 1 / 3);
          both.rotation.set(0.3, 1.2, 2);
          both.scale.setScalar(3.7);
          scene.add(both);
        },
      ],
      ["the camera's group moves", 1, ({ scene, camera }) => scene.add(group().add(camera).translateX(1))],
    ])("when %s: %i", (_, answers, change) => {
      const scene = sceneOf(adapter, sphere);
      expect(answersAfter(scene, scene.camera, () => change(scene))).toBe(answers);
    });

    it.each<
      [name: string, answers: number, change: (camera: InstanceType<Adapter["THREE"]["OrthographicCamera"]>) => void]
    >([
      ["pans", 0, (camera) => camera.position.set(3, 4, 5)],
      [
        "zooms",
        0,
        (camera) => {
          Object.assign(camera, { zoom: 3 }).updateProjectionMatrix();
        },
      ],
      ["rolls about its own axis", 0, (camera) => camera.rotateZ(1)],
      ["turns", 1, (camera) => camera.rotateX(0.1)],
    ])("when an orthographic camera %s: %i", (_, answers, change) => {
      const scene = sceneOf(adapter, sphere);
      const camera = new adapter.THREE.OrthographicCamera(-2, 2, 2, -2);
      scene.scene.add(camera);
      camera.rotation.set(0.4, 0.5, 0.6);
      expect(answersAfter(scene, camera, () => change(camera))).toBe(answers);
    });
  });

  it("takes the camera into the points' own space, through all parents", async () => {
    const { THREE } = adapter;
    const { scene, points, camera, geometry } = sceneOf(adapter, sphere);
    const outer = new THREE.Group();
    const inner = new THREE.Group();
    scene.add(outer.add(inner.add(points)));
    // A quarter turn, a power of two and whole numbers, so that rounding errors are small.
    outer.position.set(10, 20, -30);
    inner.rotation.z = Math.PI / 2;
    inner.scale.setScalar(4);
    points.scale.x = -1;
    points.scale.y = points.scale.z = 1;
    const filter = filterFor(points);
    camera.position.set(10 + 4, 20 + 8, -30 + 12);
    filter.update(camera);
    await filter.ready;
    const local = points.worldToLocal(camera.position.clone()).toArray();
    [-2, -1, 3].forEach((x, axis) => {
      expect(local[axis]).toBeCloseTo(x, 12);
    });
    expect(drawn(geometry)).toEqual(visibleFrom(local));
  });

  it("reads the positions of every kind of attribute like three.js", () => {
    const { THREE } = adapter;
    const random = randomNumbers(7);
    const integers = (range: number, signed = true) =>
      Float64Array.from({ length: 3 * 500 }, () => Math.floor((random() - (signed ? 0.5 : 0)) * range));
    const doubles = Float64Array.from(sphere, (x, i) => x + (i % 3 === 0 ? 500_000 : 4_500_000) + 1e-7);
    const interleaved = new THREE.InterleavedBuffer(
      Float32Array.from({ length: 7 * 1000 }, () => random() - 0.5),
      7,
    );
    type Attribute = InstanceType<Adapter["THREE"]["BufferAttribute" | "InterleavedBufferAttribute"]>;
    const attributes: Attribute[] = [
      new THREE.BufferAttribute(doubles, 3),
      new THREE.InterleavedBufferAttribute(interleaved, 3, 2),
      new THREE.InterleavedBufferAttribute(
        new THREE.InterleavedBuffer(Int16Array.from(integers(60_000)), 3),
        3,
        0,
        true,
      ),
      new THREE.BufferAttribute(Int16Array.from(integers(60_000)), 3, true),
      new THREE.BufferAttribute(Uint16Array.from(integers(60_000, false)), 3, true),
      new THREE.BufferAttribute(Uint8Array.from(integers(250, false)), 3),
      new THREE.BufferAttribute(Int32Array.from(integers(2 ** 31)), 3),
      new THREE.Float16BufferAttribute(
        Uint16Array.from({ length: 1500 }, () => THREE.DataUtils.toHalfFloat(random())),
        3,
      ),
      new THREE.BufferAttribute(
        Float32Array.from({ length: 4 * 1000 }, () => random() - 0.5),
        4,
      ),
    ];
    for (const attribute of attributes) {
      const { points, camera, geometry } = sceneOf(adapter, sphere);
      geometry.setAttribute("position", attribute);
      const at = new THREE.Vector3();
      const expected = Float64Array.from(
        Array.from({ length: attribute.count }, (_, i) => at.fromBufferAttribute(attribute, i).toArray()).flat(),
      );
      const filter = filterFor(points, { worker: false });
      const viewpoint = [expected[0]! + 3, expected[1]! - 5e5, expected[2]! + 5];
      camera.position.fromArray(viewpoint);
      filter.update(camera);
      expect(drawn(geometry)).toEqual(visibleFrom(viewpoint, {}, expected));
      expect(filter.visibleCount).toBeGreaterThan(20);
    }
  });

  describe("with an index and a draw range", () => {
    const some = Uint16Array.from({ length: 3000 }, (_, i) => (i * 7919) % 3000).subarray(0, 2000);

    it("filters only the points that they draw, in that order, and restores both", async () => {
      for (const [index, start, count] of [
        [some, 0, Infinity],
        [some, 300, 900],
        [some, 1500, 1e9],
        [undefined, 1000, 1500],
      ] as const) {
        const { points, camera, geometry } = sceneOf(adapter, sphere);
        const original = index === undefined ? null : new adapter.THREE.BufferAttribute(index, 1);
        geometry.setIndex(original);
        geometry.setDrawRange(start, count);
        const before = drawn(geometry);
        const filter = filterFor(points);
        filter.update(camera);
        await filter.ready;
        const taking = Float32Array.from(before.flatMap((i) => [...sphere.subarray(3 * i, 3 * i + 3)]));
        expect(drawn(geometry)).toEqual(visibleFrom([0, 0, 5], {}, taking).map((i) => before[i]));
        expect(filter.visibleCount).toBeLessThan(before.length);
        filter.dispose();
        expect(geometry.index).toBe(original);
        expect(geometry.drawRange).toEqual({ start, count });
        expect(index?.every((id, i) => id === (i * 7919) % 3000)).not.toBe(false);
      }
    });

    it("takes each point once, as of a mesh whose faces share corners", () => {
      const { points, camera, geometry } = sceneOf(adapter, sphere);
      const faces = [...some, ...some.toReversed(), ...some];
      geometry.setIndex(faces);
      const filter = filterFor(points, { worker: false });
      expect(filter.visibleCount).toBe(some.length);
      filter.update(camera);
      const once = sceneOf(adapter, sphere);
      once.geometry.setIndex([...some]);
      filterFor(once.points, { worker: false }).update(camera);
      expect(drawn(geometry)).toEqual(drawn(once.geometry));
      expect([...filter.visible]).toEqual(drawn(geometry));
      filter.dispose();
      expect(drawn(geometry)).toEqual(faces);
    });

    it("may draw nothing", async () => {
      const { points, camera, geometry } = sceneOf(adapter, sphere);
      geometry.setDrawRange(7, 0);
      const filter = filterFor(points);
      filter.update(camera);
      await filter.ready;
      expect(filter.visibleCount).toBe(0);
      expect(drawn(geometry)).toEqual([]);
    });
  });

  it("lets rays pick visible points only", () => {
    const { THREE } = adapter;
    const { points, camera, scene } = sceneOf(adapter, sphere);
    scene.updateMatrixWorld(true);
    const raycaster = new THREE.Raycaster();
    raycaster.params.Points.threshold = 0.1;
    raycaster.setFromCamera(new THREE.Vector2(0, 0), camera);
    const picked = () => raycaster.intersectObject(scene).map(({ index, point }) => ({ index: index!, z: point.z }));
    expect(picked().some(({ z }) => z < 0)).toBe(true);
    for (const mode of ["hide", "dim"] as const) {
      const filter = filterFor(points, { worker: false, mode });
      filter.update(camera);
      const visible = new Set(visibleFrom([0, 0, 5]));
      expect(picked().length).toBeGreaterThan(0);
      expect(picked().every(({ index, z }) => z > 0 && visible.has(index))).toBe(true);
      filter.dispose();
      expect(picked().some(({ z }) => z < 0)).toBe(true);
    }
  });

  it("leaves colors, sizes and the material alone, and everything as it was after dispose()", async () => {
    const { THREE } = adapter;
    for (const mode of ["hide", "dim"] as const) {
      const { points, camera, geometry } = sceneOf(adapter, sphere);
      geometry.setAttribute("color", new THREE.BufferAttribute(new Uint8Array(9000).fill(200), 3, true));
      const { material } = points;
      const state = () => ({
        attributes: { ...geometry.attributes },
        versions: Object.values(geometry.attributes).map((attribute) => (attribute as { version: number }).version),
        material: material.toJSON(),
        children: [...points.children],
        index: geometry.index,
        range: { ...geometry.drawRange },
      });
      const before = state();
      const filter = filterFor(points, { mode });
      filter.update(camera);
      await filter.ready;
      const { attributes, versions } = state();
      expect({ attributes, versions }).toEqual({ attributes: before.attributes, versions: before.versions });
      expect(points.material).toBe(material);
      expect(material.toJSON()).toEqual(before.material);
      filter.dispose();
      filter.dispose();
      expect(state()).toEqual(before);
      camera.position.set(1, 2, 3);
      filter.update(camera);
      expect(state()).toEqual(before);
    }
  });
});
