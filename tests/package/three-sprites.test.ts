// Sprites and instances that show the visible points: their buffers, as three's WebGPU renderer reads them.
import { instancedDynamicBufferAttribute } from "three/tsl";
import * as THREE from "three/webgpu";
import { expect, it } from "vitest";

import { HprError } from "hidden-point-removal";
import { HiddenPointFilter } from "hidden-point-removal/three";
import { bumpySphere, readyPackage } from "./support";

const { PointCloud } = await readyPackage();
const COUNT = 800;
const positions = bumpySphere(3, COUNT);
const cloud = new PointCloud(positions);

function scene() {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
  const filter = new HiddenPointFilter(new THREE.Points(geometry), { worker: false, settle: false });
  const camera = new THREE.PerspectiveCamera();
  const lookFrom = (...place: [number, number, number]) => {
    camera.position.set(...place);
    camera.updateMatrixWorld();
    filter.update(camera);
    return [...cloud.visibleFrom(place).indices];
  };
  return { filter, lookFrom };
}

it("a sprite with a count shows the visible points, and later those of another place", async () => {
  const { filter, lookFrom } = scene();
  const seen = new THREE.InstancedBufferAttribute(positions.slice(), 3);
  const material = new THREE.SpriteNodeMaterial();
  material.positionNode = instancedDynamicBufferAttribute(seen);
  const sprites = new THREE.Sprite(material);
  filter.addEventListener("change", () => {
    filter.visible.forEach((index, i) => seen.set(positions.subarray(3 * index, 3 * index + 3), 3 * i));
    seen.needsUpdate = true;
    sprites.count = filter.visible.length;
  });
  const shown = () => [...seen.array.slice(0, 3 * sprites.count)];
  const of = (indices: number[]) => indices.flatMap((i) => [...positions.subarray(3 * i, 3 * i + 3)]);
  const front = lookFrom(0, 0, 4);
  await filter.ready;
  expect(shown()).toEqual(of(front));
  const { version } = seen;
  const back = lookFrom(0, 1, -4);
  expect(shown()).toEqual(of(back));
  expect(seen.version).toBeGreaterThan(version);
  expect(back).not.toEqual(front);
  filter.dispose();
});

it("an InstancedMesh draws the matrices of the visible points", async () => {
  const { filter, lookFrom } = scene();
  const mesh = new THREE.InstancedMesh(new THREE.BoxGeometry(), new THREE.MeshBasicNodeMaterial(), COUNT);
  const matrix = new THREE.Matrix4();
  filter.addEventListener("change", () => {
    filter.visible.forEach((index, i) => {
      mesh.setMatrixAt(i, matrix.makeTranslation(...(positions.subarray(3 * index) as unknown as [number, number, number]))); // prettier-ignore
    });
    mesh.instanceMatrix.needsUpdate = true;
    mesh.count = filter.visible.length;
  });
  const visible = lookFrom(3, 0, 2);
  await filter.ready;
  expect(mesh.count).toBe(visible.length);
  visible.forEach((index, i) => {
    mesh.getMatrixAt(i, matrix);
    expect(matrix.elements.slice(12, 15)).toEqual([...positions.subarray(3 * index, 3 * index + 3)]);
  });
  filter.dispose();
});

it.each([
  [new THREE.Mesh(), "a THREE.Mesh"],
  [new THREE.Sprite(), "a THREE.Sprite"],
  [3, "3"],
])("another object is refused by its name, with the way out", (object, name) => {
  const refused = () => new HiddenPointFilter(object as unknown as THREE.Points);
  expect(refused).toThrow(HprError);
  expect(refused).toThrow(`points must be a THREE.Points, got ${name}. The vertices of a mesh: new THREE.Points(`);
});
