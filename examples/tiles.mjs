// Tiled viewers hold many Points. The filter takes all of them as one cloud, also where two of them meet.
import * as THREE from "three";
import { HiddenPointNodesFilter } from "hidden-point-removal/nodes";

/** A node of 20 by 20 points with a spacing of 1, at its own position. */
function node(x, y, z) {
  const positions = Float32Array.from(
    { length: 1200 },
    (_, i) => [Math.floor(i / 3) % 20, Math.floor(i / 60), 0][i % 3],
  );
  const geometry = new THREE.BufferGeometry().setAttribute("position", new THREE.BufferAttribute(positions, 3));
  const points = new THREE.Points(geometry, new THREE.PointsMaterial());
  points.position.set(x, y, z);
  return points;
}

const octree = new THREE.Group();
octree.add(node(0, 0, 0), node(20, 0, 0), node(10, 0, -40)); // the third is behind the seam
const camera = new THREE.PerspectiveCamera();
camera.position.set(20, 10, 100);
camera.updateMatrixWorld();

const filter = new HiddenPointNodesFilter(octree);
filter.addEventListener("error", ({ error }) => console.error(error));
/** Draws frames, as renderer.setAnimationLoop does, until the answer is drawn. */
async function draw() {
  do {
    octree.updateMatrixWorld();
    filter.update(camera);
    await new Promise((next) => setTimeout(next, 16));
  } while (!filter.settled);
  return `${filter.visibleCount} of ${400 * octree.children.length}`;
}

console.log(await draw()); // → 800 of 1200
octree.remove(octree.children[0]); // half of the points that hid the third node
console.log(await draw()); // → 600 of 800
filter.dispose();
