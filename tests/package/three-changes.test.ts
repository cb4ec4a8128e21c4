// The adapter for three.js: refusals and changes of its points. tests/package/adapters.test.ts has what all adapters share.
import { init, PointCloud } from "hidden-point-removal";
import { HiddenPointNodesFilter } from "hidden-point-removal/nodes";
import { HiddenPointFilter } from "hidden-point-removal/three";
import * as THREE from "three";
import { afterEach, beforeAll, beforeEach, describe, expect, it, vi } from "vitest";

import { seeded } from "../bench/generators";
import { pointsOf } from "./adapters";
import { CountedWorker, OriginalWorker, replaceWorker, running } from "./node-workers";
import { bumpySphere, pointsAt, problemOf } from "./support";
import { type Adapter, adapterFor, drawn, type Filter, type Scene, sceneOf } from "./three-support";

const sphere = bumpySphere(1, 3000);
const loose = (value: unknown) => value as never;

beforeEach(() => {
  replaceWorker(CountedWorker);
});

afterEach(() => {
  replaceWorker(OriginalWorker);
});

describe("a filter", () => {
  let adapter: Adapter;
  const filters: Filter[] = [];

  beforeAll(async () => {
    adapter = await adapterFor(() => import("three"));
    await adapter.init();
  });

  afterEach(async () => {
    for (const filter of filters.splice(0)) filter.dispose();
    await expect.poll(() => running.size).toBe(0);
  });

  function filterFor(points: Scene["points"], options?: object): Filter {
    const filter = new adapter.HiddenPointFilter(points, { settle: false, ...options });
    filters.push(filter);
    return filter;
  }

  const visibleFrom = (viewpoint: ArrayLike<number>, positions: Float32Array | Float64Array = sphere) => [
    ...new adapter.PointCloud(positions).visibleFrom(viewpoint).indices,
  ];

  describe("refuses when it is made", () => {
    const attribute = (array: Float32Array, size = 3) => new adapter.THREE.BufferAttribute(array, size);
    it.each<[what: string, code: string, words: string, spoil: (scene: Scene) => unknown]>([
      ["a mesh", "option", "THREE.Points", () => new adapter.THREE.Mesh()],
      ["nothing", "option", "THREE.Points", () => undefined],
      [
        "morph targets",
        "option",
        "morphAttributes",
        ({ geometry }) => void (geometry.morphAttributes["position"] = [attribute(sphere)]),
      ],
      [
        "an instanced geometry",
        "option",
        "InstancedBufferGeometry",
        ({ points, geometry }) =>
          void (points.geometry = new adapter.THREE.InstancedBufferGeometry().copy(loose(geometry))),
      ],
      [
        "an instanced attribute",
        "option",
        '"offset"',
        ({ geometry }) => void geometry.setAttribute("offset", new adapter.THREE.InstancedBufferAttribute(sphere, 3)),
      ],
      ["a scale that is not uniform", "option", "scale", ({ points }) => void points.scale.set(1, 1, 1.01)],
      [
        "a shear",
        "option",
        "scale",
        ({ points, scene }) => {
          const parent = new adapter.THREE.Group();
          parent.scale.set(1, 2, 1);
          points.rotation.z = 0.5;
          scene.add(parent.add(points));
        },
      ],
      ["a scale of zero", "option", "scale", ({ points }) => void points.scale.setScalar(0)],
      ["no positions", "positions-type", "position", ({ geometry }) => void geometry.deleteAttribute("position")],
      [
        "positions of two numbers",
        "positions-type",
        "itemSize",
        ({ geometry }) => void geometry.setAttribute("position", attribute(sphere, 2)),
      ],
      [
        "positions that were given away",
        "positions-type",
        "array",
        ({ geometry }) => void ((geometry.attributes["position"] as { array: unknown }).array = null),
      ],
      ["an index beyond the points", "option", "index[1] is 3000", ({ geometry }) => void geometry.setIndex([1, 3000])],
    ])("%s", async (_, code, words, spoil) => {
      const scene = sceneOf(adapter, sphere);
      const points = (spoil(scene) as Scene["points"] | undefined) ?? scene.points;
      const target = words === "THREE.Points" ? spoil(scene) : points;
      for (const worker of [true, false]) {
        const problem = await problemOf(() => new adapter.HiddenPointFilter(loose(target), { worker }));
        expect(problem).toBeInstanceOf(adapter.HprError);
        expect(problem).toMatchObject({ code, message: expect.stringContaining(words) as string });
      }
    });

    it("a material that it cannot dim, but not one to dim with", () => {
      const { points, camera } = sceneOf(adapter, sphere);
      points.material = loose(new adapter.THREE.ShaderMaterial());
      expect(() => filterFor(points, { mode: "dim" })).toThrow(/dimMaterial.*ShaderMaterial/);
      filterFor(points, { mode: "dim", dimMaterial: new adapter.THREE.PointsMaterial(), worker: false }).update(camera);
      expect(points.children).toHaveLength(1);
    });

    it("a second filter of one geometry, as long as the first exists", () => {
      const { points } = sceneOf(adapter, sphere);
      const filter = filterFor(points, { worker: false });
      expect(() => filterFor(points)).toThrow(/already/);
      filter.dispose();
      filterFor(points, { worker: false });
    });
  });

  it("does not take a filtered geometry over from another filter, which goes on", () => {
    const [one, other] = [sceneOf(adapter, sphere), sceneOf(adapter, sphere.slice(0, 3000))];
    const [filter, owner] = [filterFor(one.points, { worker: false }), filterFor(other.points, { worker: false })];
    const errors: string[] = [];
    filter.addEventListener("error", ({ error }) => errors.push(error.message));
    const update = () => {
      filter.update(one.camera);
      owner.update(other.camera);
    };
    update();
    const before = drawn(other.geometry);
    one.points.geometry = other.geometry;
    for (let i = 0; i < 3; i++) update();
    expect(errors).toEqual([expect.stringMatching(/already/)]);
    expect(drawn(other.geometry)).toEqual(before);
    expect(one.geometry.index).toBeNull();
    owner.dispose();
    expect(other.geometry.index).toBeNull();
    update();
    expect(drawn(other.geometry)).toEqual(before);
  });

  describe("says once", () => {
    function heard(filter: Filter): string[] {
      const codes: string[] = [];
      filter.addEventListener("error", ({ error }) => codes.push((error as { code?: string }).code ?? error.name));
      return codes;
    }

    it("that a scale has become uneven", async () => {
      const { points, camera } = sceneOf(adapter, sphere);
      const filter = filterFor(points);
      const codes = heard(filter);
      points.scale.x = 2;
      for (let i = 0; i < 5; i++) filter.update(camera);
      expect((await problemOf(() => filter.ready)).code).toBe("option");
      expect(codes).toEqual(["option"]);
    });

    it("a refusal of the core", async () => {
      const broken = sphere.slice().fill(NaN, 30, 31);
      const scene = sceneOf(adapter, broken);
      const filter = filterFor(scene.points);
      const codes = heard(filter);
      filter.update(scene.camera);
      expect((await problemOf(() => filter.ready)).code).toBe("non-finite");
      for (let i = 0; i < 5; i++) filter.update(scene.camera);
      expect(codes).toEqual(["non-finite"]);
      expect(drawn(scene.geometry)).toHaveLength(3000);
      filter.dispose();

      expect(() => filterFor(scene.points, { worker: false })).toThrow(/NaN/);
      const skipping = filterFor(scene.points, { nonFinite: "skip", worker: false });
      skipping.update(scene.camera);
      const visible = [...new adapter.PointCloud(broken, { nonFinite: "skip" }).visibleFrom([0, 0, 5]).indices];
      expect(drawn(scene.geometry)).toEqual(visible);

      const far = sceneOf(adapter, sphere);
      const sighted = filterFor(far.points, { exponent: -1 });
      const said = heard(sighted);
      sighted.update(far.camera);
      expect((await problemOf(() => sighted.ready)).code).toBe("option");
      expect(said).toEqual(["option"]);
      sighted.update(loose({}));
      expect(said).toEqual(["option"]);
    });
  });

  describe("takes up changes of", () => {
    it.each([true, false])("positions, with worker: %s", async (worker) => {
      const { points, camera, geometry } = sceneOf(adapter, sphere.slice());
      const filter = filterFor(points, { worker });
      filter.update(camera);
      await filter.ready;
      const position = geometry.attributes["position"]!;
      for (const factor of [-0.5, 2]) {
        position.array.forEach((_, i, array) => {
          array[i]! *= factor;
        });
        const before = drawn(geometry);
        filter.update(camera);
        expect(drawn(geometry)).toEqual(before);
        position.needsUpdate = true;
        filter.update(camera);
        const expected = visibleFrom([0, 0, 5], position.array as Float32Array);
        await expect.poll(() => drawn(geometry)).toEqual(expected);
      }
      filter.dispose();
      expect(geometry.index).toBeNull();
    });

    // Whatever changes, in any order: at rest the picture is that of the points as they are.
    it.each([1, 2, 3, 4, 5, 6])("all of these in any order, with two cameras: %i", async (seed) => {
      const { THREE } = adapter;
      const random = seeded(seed);
      const upTo = (end: number) => Math.floor(random() * end);
      const made = (count: number) => new THREE.BufferAttribute(bumpySphere(seed, count), 3);
      const { points, camera } = sceneOf(adapter, bumpySphere(seed, 300));
      const cameras = [camera, new THREE.PerspectiveCamera()];
      cameras[1]!.position.set(4, 1, 1);
      const filter = filterFor(points, {
        mode: seed % 2 === 0 ? "dim" : "hide",
        stale: seed % 3 === 0 ? "all" : "keep",
      });
      filter.addEventListener("error", ({ error }) => expect(error).toMatchObject({ code: "non-finite" }));
      const left: [geometry: Scene["geometry"], drawn: number[]][] = [];
      /** The user's own index and draw range. */
      let own = { index: null as number[] | null, start: 0, count: Infinity };
      const setOwn = (geometry: Scene["geometry"], changed: Partial<typeof own>) => {
        own = { ...own, ...changed };
        if ("index" in changed) geometry.setIndex(own.index);
        else geometry.setDrawRange(own.start, own.count);
      };
      const numbers = () => {
        const { count } = points.geometry.attributes["position"]!;
        return (own.index ?? Array.from({ length: count }, (_, i) => i)).slice(own.start, own.start + own.count);
      };
      const changes: ((geometry: Scene["geometry"]) => unknown)[] = [
        (geometry) => setOwn(geometry, { index: Array.from({ length: 1 + upTo(200) }, () => upTo(5)) }),
        (geometry) => setOwn(geometry, { index: null }),
        (geometry) => setOwn(geometry, { start: upTo(9), count: 1 + upTo(300) }),
        (geometry) => geometry.setAttribute("position", made(5 + upTo(400))),
        ({ attributes }) => {
          attributes["position"]!.setXYZ(0, random(), random(), upTo(2) ? 1 : NaN);
          attributes["position"]!.needsUpdate = true;
        },
        (geometry) => {
          left.push([geometry, numbers()]);
          points.geometry = new THREE.BufferGeometry().setAttribute("position", made(200));
          own = { index: null, start: 0, count: Infinity };
        },
        () => (filter.mode = filter.mode === "dim" ? "hide" : "dim"),
        () => (filter.enabled = !filter.enabled),
        () => (filter.frozen = !filter.frozen),
        () => new Promise((resolve) => setTimeout(resolve, upTo(9))),
      ];
      for (let step = 1; step <= 40; step++) {
        await changes[upTo(changes.length)]!(points.geometry);
        const seen = cameras[upTo(2)]!;
        if (random() < 0.6) filter.update(seen);
        if (step % 5 > 0) continue;
        Object.assign(filter, { enabled: true, frozen: false });
        const position = points.geometry.attributes["position"]!;
        position.setZ(0, position.getZ(0) || 1);
        position.needsUpdate = true;
        // No later frame comes than this one.
        filter.update(seen);
        const place = new THREE.Vector3(random() * 2 - 1, random() * 2 - 1, random() * 2 - 1);
        const sees = await filter.sees(place);
        await expect.poll(() => filter.settled).toBe(true);
        const ids = [...new Set(numbers())];
        const present = pointsAt(position.array as Float32Array, ids);
        expect(sees).toBe(new adapter.PointCloud(present).sees(seen.position, place.toArray())[0] === 1);
        const visible = visibleFrom(seen.position.toArray(), present);
        expect(drawn(points.geometry)).toEqual(visible.map((i) => ids[i]));
        expect(filter.visibleCount).toBe(visible.length);
      }
      filter.dispose();
      for (const [geometry, before] of [...left, [points.geometry, numbers()] as const]) {
        expect(drawn(geometry)).toEqual(before);
      }
      expect(points.children).toHaveLength(0);
    });

    it("positions that move in every frame, without starving", async () => {
      const { points, camera, geometry } = sceneOf(adapter, sphere.slice());
      const filter = filterFor(points);
      let answers = 0;
      filter.addEventListener("change", () => answers++);
      for (let frame = 0; answers < 5; frame++) {
        const position = geometry.attributes["position"]!;
        position.array[frame % 9000]! += 0.01;
        position.needsUpdate = true;
        filter.update(camera);
        await new Promise((resolve) => setTimeout(resolve, 1));
      }
      await expect
        .poll(() => {
          filter.update(camera);
          return drawn(geometry);
        })
        .toEqual(visibleFrom([0, 0, 5], geometry.attributes["position"]!.array as Float32Array));
    });
  });

  describe("with mode dim", () => {
    it("draws hidden points as a child that rays do not hit", async () => {
      const { THREE } = adapter;
      const { points, camera, geometry } = sceneOf(adapter, sphere);
      const filter = filterFor(points, { mode: "dim" });
      expect(points.children).toHaveLength(0);
      filter.update(camera);
      await filter.ready;
      const child = points.children[0] as Scene["points"];
      const visible = drawn(geometry);
      expect(visible).toEqual(visibleFrom([0, 0, 5]));
      const hidden = drawn(child.geometry);
      expect([...visible, ...hidden].sort((a, b) => a - b)).toEqual(Array.from({ length: 3000 }, (_, i) => i));
      expect(child.geometry.attributes["position"]).toBe(geometry.attributes["position"]);
      expect(child.material).toMatchObject({ transparent: true, depthWrite: false, size: points.material.size });

      // It follows the points.
      points.material.size = 3;
      points.material.color.set("red");
      points.renderOrder = 7;
      geometry.setAttribute("color", new THREE.BufferAttribute(sphere, 3));
      filter.update(camera);
      expect(child.material).toMatchObject({ size: 3, color: new THREE.Color("red") });
      expect(child.renderOrder).toBe(7);
      expect(child.geometry.attributes["color"]).toBe(geometry.attributes["color"]);
      Object.assign(points, { material: new THREE.PointsMaterial({ opacity: 0.5 }) });
      filter.update(camera);
      expect(child.material.opacity).toBeCloseTo(0.075);

      filter.enabled = false;
      expect(child.visible).toBe(false);
      filter.enabled = true;
      expect(child.visible).toBe(true);
      filter.dispose();
      expect(points.children).toHaveLength(0);
      expect(Object.keys(child.geometry.attributes)).toEqual([]);
    });

    it("says once that it copies no hook of a material", () => {
      const said = vi.spyOn(console, "info").mockReturnValue(undefined);
      for (let k = 0; k < 3; k++) {
        const { points } = sceneOf(adapter, sphere);
        if (k > 0) points.material.onBeforeCompile = () => undefined;
        filterFor(points, { mode: "dim", worker: false });
        expect(said).toHaveBeenCalledTimes(Math.min(k, 1));
      }
      expect(said).toHaveBeenCalledWith(expect.stringContaining("give dimMaterial"));
      said.mockRestore();
    });

    it("lists the hidden points of an index in its order", () => {
      const { points, camera, geometry } = sceneOf(adapter, sphere);
      const ids = Array.from({ length: 1000 }, (_, i) => (i * 7919) % 3000);
      geometry.setIndex(ids);
      filterFor(points, { mode: "dim", worker: false }).update(camera);
      const visible = new Set(drawn(geometry));
      expect(drawn(geometry)).toEqual(ids.filter((id) => visible.has(id)));
      expect(drawn((points.children[0] as Scene["points"]).geometry)).toEqual(ids.filter((id) => !visible.has(id)));
    });
  });
});

describe.each([
  ["HiddenPointFilter", (points: THREE.Points, options: object) => new HiddenPointFilter(points, options)],
  [
    "HiddenPointNodesFilter",
    (points: THREE.Points, options: object) => new HiddenPointNodesFilter(points.parent!, options),
  ],
] as const)("%s", (_, make) => {
  beforeAll(() => init());

  type Wrong = [of: (points: THREE.Points) => object, name: string, value: unknown, code: string, words: string];
  const itself = (points: THREE.Points) => points;
  const geometryOf = ({ geometry }: THREE.Points) => geometry;
  const attributesOf = ({ geometry }: THREE.Points) => geometry.attributes;
  it.each<Wrong>([
    ...[undefined, null, {}, 7].map((value): Wrong => [itself, "geometry", value, "option", "geometry"]),
    ...[undefined, null, {}, [1, 2, 3], 7].map((value): Wrong => [
      attributesOf,
      "position",
      value,
      "positions-type",
      "position",
    ]),
    [geometryOf, "attributes", undefined, "positions-type", "position"],
    [geometryOf, "index", [1, 2, 3], "option", "index"],
    [geometryOf, "index", undefined, "option", "index"],
    [geometryOf, "index", new THREE.Float32BufferAttribute([0, NaN], 1), "option", "index[1]"],
    [geometryOf, "drawRange", undefined, "option", "drawRange"],
    [geometryOf, "drawRange", { start: NaN, count: 7 }, "option", "drawRange"],
    [itself, "material", undefined, "option", "dimMaterial"],
    [itself, "material", new THREE.ShaderMaterial(), "option", "ShaderMaterial"],
  ])("%s.%s = %s: refuses it once, and goes on after it is restored", async (of, name, value, code, words) => {
    const { points, camera, geometry } = pointsOf(sphere);
    const filter = make(points, { settle: false, worker: false, mode: "dim" });
    const errors: Error[] = [];
    filter.addEventListener("error", ({ error }: { error: Error }) => errors.push(error));
    const visible = () => [...new PointCloud(sphere).visibleFrom(camera.position.toArray()).indices];
    const update = async () => {
      filter.update(camera);
      await new Promise((resolve) => setTimeout(resolve, 1));
    };
    filter.update(camera);
    await expect.poll(() => drawn(geometry)).toEqual(visible());
    const mend = replaced(of(points) as Record<string, unknown>, name, value);
    for (let frame = 0; frame < 4; frame++) await update();
    expect(errors).toHaveLength(1);
    expect(errors[0]).toMatchObject({ name: "HprError", code, message: expect.stringContaining(words) as string });
    mend();
    camera.position.set(3, 4, 0);
    await update();
    await expect
      .poll(async () => {
        await update();
        return drawn(geometry);
      })
      .toEqual(visible());
    expect(errors).toHaveLength(1);
    filter.dispose();
    expect([geometry.index, geometry.drawRange]).toEqual([null, { start: 0, count: Infinity }]);
  });
});

/** Gives a property another value. Returns a function that restores the old value. */
function replaced(object: Record<string, unknown>, name: string, value: unknown): () => void {
  const before = object[name];
  object[name] = value;
  return () => {
    object[name] = name === "index" ? null : name === "drawRange" ? { start: 0, count: Infinity } : before;
  };
}
