// The first view of clouds of all shapes: everything is in the picture, and fills it.
import { PerspectiveCamera, Vector3 } from "three";
import { expect, test } from "vitest";
import { prepareCloud } from "../../www/cloud/prepare.js";
import { findHome } from "../../www/view/framing.js";
import { seeded } from "../bench/generators.js";

const random = seeded(7);
const many = (place: () => number[]) => Float64Array.from(Array.from({ length: 3000 }, place).flat());
const CLOUDS = {
  tower: many(() => {
    const turn = 2 * Math.PI * random();
    return [3 * Math.cos(turn), 3 * Math.sin(turn), 60 * random()];
  }),
  plate: many(() => [100 * random(), 60 * random(), random()]),
  wall: many(() => [40 * random(), 0.2 * random(), 12 * random()]),
  "a map tile in UTM": many(() => [512_000 + 400 * random(), 5_403_000 + 250 * random(), 300 + 20 * random()]),
  line: many(() => [random(), 0, 0]),
};
/** A phone, a window beside the panel, and a wide screen. */
const ASPECTS = [0.46, 1.35, 2.2];

test.for(Object.entries(CLOUDS))("%s fills the picture", ([, positions]) => {
  const { cloud } = prepareCloud({ positions, colors: null });
  for (const up of ["y", "z", "-y"] as const) {
    for (const aspect of ASPECTS) {
      const { pose } = findHome(cloud, up, null, null, { fov: 45, aspect, free: 1 });
      const camera = new PerspectiveCamera(45, aspect, 1e-3, 1e6);
      camera.position.copy(pose.at);
      camera.up.copy(pose.up);
      camera.lookAt(pose.target);
      camera.updateMatrixWorld();
      const at = new Vector3();
      let [reach, behind] = [0, 0];
      for (let i = 0; i < cloud.count; i++) {
        at.fromArray(cloud.local, 3 * i).project(camera);
        if (at.z > 1) behind++;
        reach = Math.max(reach, Math.abs(at.x), Math.abs(at.y));
      }
      expect(behind).toBe(0);
      expect(reach, `up ${up}, ${aspect}`).toBeLessThan(1);
      expect(reach, `up ${up}, ${aspect}`).toBeGreaterThan(0.85);
    }
  }
});

test("points that lie far away from all others are not framed, unless the whole cloud is asked for", () => {
  const body = CLOUDS.plate;
  const { cloud } = prepareCloud({ positions: Float64Array.of(...body, 90_000, -40_000, 7e5), colors: null });
  const lens = { fov: 45, aspect: 1.35, free: 1 };
  const near = findHome(cloud, "z", null, null, lens);
  const alone = findHome(prepareCloud({ positions: body, colors: null }).cloud, "z", null, null, lens);
  for (const axis of [0, 1, 2]) expect(near.viewpoint[axis]!).toBeCloseTo(alone.viewpoint[axis]!, -1);
  expect(near.extent.radius).toBeLessThan(200);
  const whole = findHome(cloud, "z", null, null, lens, true);
  expect(whole.extent.radius).toBe(cloud.radius);
  expect(whole.pose.at.length()).toBeGreaterThan(1e5);
});
