// Objects of this package in Vue's reactive state: Vue leaves them as they are.
import { reactive, ref, shallowRef } from "@vue/reactivity";
import { BufferAttribute, BufferGeometry, PerspectiveCamera, Points } from "three";
import { expect, it } from "vitest";

import { HiddenPointFilter } from "hidden-point-removal/three";
import { readyPackage } from "./support";

const { Horizon, PointCloud, WorkerPointCloud } = await readyPackage();
const POSITIONS = [0, 0, 1, 0, 0, 2, 1, 0, 0];

it("a cloud and its answers work in reactive, ref and a property of a state", () => {
  const cloud = new PointCloud(POSITIONS);
  const state = reactive<{ cloud: unknown }>({ cloud });
  for (const held of [reactive(cloud), ref(cloud).value, shallowRef(cloud).value, state.cloud]) {
    expect(held).toBe(cloud);
  }
  const answer = ref(reactive(cloud).visibleFrom([0, 0, 5])).value;
  expect([...answer.mask()]).toEqual([0, 1, 1]);
  expect(reactive(new Horizon([0, 0, 5], { radius: 50 })).screen(new Float32Array(POSITIONS))).toHaveLength(3);
});

it("a cloud in a worker and its stream", async () => {
  const cloud = ref(await WorkerPointCloud.create(POSITIONS)).value;
  expect((await cloud.visibleFrom([0, 0, 5])).count).toBe(2);
  const stream = reactive(cloud.follow());
  stream.look([0, 0, 5]);
  for await (const { visibility } of stream) {
    expect(visibility.count).toBe(2);
    break;
  }
  await cloud.dispose();
});

it("a filter for three.js", async () => {
  const geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array(POSITIONS), 3));
  const camera = new PerspectiveCamera();
  camera.position.set(0, 0, 5);
  camera.updateMatrixWorld();
  const filter = reactive(new HiddenPointFilter(new Points(geometry), { worker: false, settle: false }));
  filter.update(camera);
  await filter.ready;
  expect(filter.visibleCount).toBe(2);
  filter.dispose();
});
