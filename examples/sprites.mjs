// three.js: sprites show the visible points. WebGPURenderer draws each of a Points with one pixel; sprites can be larger.
import * as THREE from "three/webgpu";
import { instancedDynamicBufferAttribute } from "three/tsl";
import { HiddenPointFilter } from "hidden-point-removal/three";

const positions = new Float32Array([0, 0, 1, 0, 0, 2, 1, 0, 0]);
const geometry = new THREE.BufferGeometry();
geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
const filter = new HiddenPointFilter(new THREE.Points(geometry));

const seen = new THREE.InstancedBufferAttribute(positions.slice(), 3);
const material = new THREE.SpriteNodeMaterial();
material.positionNode = instancedDynamicBufferAttribute(seen);
const sprites = new THREE.Sprite(material);
filter.addEventListener("change", () => {
  filter.visible.forEach((index, i) => seen.set(positions.subarray(3 * index, 3 * index + 3), 3 * i));
  seen.needsUpdate = true;
  sprites.count = filter.visible.length;
});

const camera = new THREE.PerspectiveCamera();
camera.position.set(0, 0, 5);
camera.updateMatrixWorld();
filter.update(camera); // in every frame
await filter.ready;
console.log(sprites.count, seen.getZ(0)); // → 2 2
filter.dispose();
