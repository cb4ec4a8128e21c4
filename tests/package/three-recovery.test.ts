// Tests both filters for three.js: their worker dies, or their objects get wrong values.
import { init, PointCloud } from "hidden-point-removal";
import { HiddenPointNodesFilter } from "hidden-point-removal/nodes";
import * as THREE from "three";
import { beforeAll, describe, expect, it, vi } from "vitest";

import { BOTH, filters, pointsOf } from "./both-filters";
import { watchedWorkers } from "./node-workers";
import { bumpySphere, problemOf } from "./support";
import { drawn } from "./three-support";

const sphere = bumpySphere(1, 3000);

beforeAll(() => init());

describe.each(BOTH)("%s", (_, make) => {
  function filterFor(points: THREE.Points, options: object = {}) {
    const filter = make(points, { settle: false, ...options });
    filters.push(filter);
    const errors: Error[] = [];
    const listener = ({ error }: { error: Error }) => {
      errors.push(error);
    };
    filter.addEventListener("error", listener);
    return { filter, errors, listener };
  }

  const visibleFrom = (camera: THREE.Camera, positions = sphere) => [
    ...new PointCloud(positions).visibleFrom(camera.position.toArray()).indices,
  ];
  const next = () => new Promise((resolve) => setTimeout(resolve, 1));

  describe("with workers that die as soon as they run", () => {
    let dying = 0;
    const started = watchedWorkers((worker, number) => {
      if (number <= dying) worker.once("message", () => void worker.terminate());
    });

    it("recovers from several deaths in a row without a report", async () => {
      dying = 3;
      const { points, camera, geometry } = pointsOf(sphere);
      const { filter, errors } = filterFor(points);
      filter.update(camera);
      await expect.poll(() => drawn(geometry)).toEqual(visibleFrom(camera));
      expect(started).toHaveLength(4);
      expect(errors).toEqual([]);
    });

    it("reports once that its workers keep dying, and tries again from another viewpoint", async () => {
      dying = 4;
      const { points, camera, geometry } = pointsOf(sphere);
      const { filter, errors } = filterFor(points);
      filter.update(camera);
      await expect.poll(() => errors).toHaveLength(1);
      expect(errors[0]).toMatchObject({ name: "HprError", code: "internal" });
      for (let frame = 0; frame < 100; frame++) {
        filter.update(camera);
        await next();
      }
      expect(started).toHaveLength(4);
      expect(drawn(geometry)).toHaveLength(3000);
      camera.position.set(5, 1, 0);
      await expect
        .poll(() => {
          filter.update(camera);
          return drawn(geometry);
        })
        .toEqual(visibleFrom(camera));
      expect(started).toHaveLength(5);
      expect(errors).toHaveLength(1);
    });
  });

  it("reports an error without a listener as an unhandled rejection", async () => {
    const { points, camera } = pointsOf(sphere);
    const { filter, errors, listener } = filterFor(points, { radius: 1 });
    filter.removeEventListener("error", listener);
    if (filter instanceof HiddenPointNodesFilter) {
      filter.update(camera);
      expect((await problemOf(() => filter.ready)).code).toBe("radius");
      return;
    }
    await filter.ready;
    const reject = vi.spyOn(Promise, "reject").mockReturnValue(Promise.resolve());
    filter.update(camera);
    await expect.poll(() => reject.mock.calls).toHaveLength(1);
    expect(reject.mock.calls[0]![0]).toMatchObject({ code: "radius" });
    reject.mockRestore();
    expect(errors).toEqual([]);
  });

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
    const { filter, errors } = filterFor(points, { worker: false, mode: "dim" });
    const update = async () => {
      filter.update(camera);
      await next();
    };
    filter.update(camera);
    await expect.poll(() => drawn(geometry)).toEqual(visibleFrom(camera));
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
      .toEqual(visibleFrom(camera));
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
