// three.js: clicks and lassos that never pick a hidden point. They read the index of the geometry, as drawing does.
import * as THREE from "three";
import { HiddenPointFilter } from "hidden-point-removal/three";

const walls = Array.from({ length: 3200 }, (_, i) => [i % 40, Math.floor(i / 40) % 40, i < 1600 ? 0 : -20]);
const geometry = new THREE.BufferGeometry();
geometry.setAttribute("position", new THREE.Float32BufferAttribute(walls.flat(), 3));
const points = new THREE.Points(geometry, new THREE.PointsMaterial({ size: 0.5 }));
const camera = new THREE.PerspectiveCamera(60, 1);
camera.position.set(20, 20, 60);
camera.updateMatrixWorld();
points.updateMatrixWorld();

/** The points that a click hits; x and y are from -1 to 1. */
function pick(x, y) {
  const raycaster = new THREE.Raycaster();
  raycaster.params.Points.threshold = 0.7;
  raycaster.setFromCamera(new THREE.Vector2(x, y), camera);
  return raycaster.intersectObject(points).map((hit) => hit.index);
}

/** The drawn points inside a polygon on the screen. */
function lasso(polygon) {
  const { index, drawRange, attributes } = geometry;
  const count = index === null ? attributes.position.count : Math.min(drawRange.count, index.count);
  const drawn = Array.from({ length: count }, (_, i) => (index === null ? i : index.getX(i)));
  const place = new THREE.Vector3();
  return drawn.filter((i) => {
    place.fromBufferAttribute(attributes.position, i).applyMatrix4(points.matrixWorld).project(camera);
    return Math.abs(place.z) <= 1 && isInside(polygon, place);
  });
}

/** Even-odd rule: how often does a ray to the right cross the outline? */
function isInside(polygon, { x, y }) {
  return polygon.reduce((inside, [x1, y1], i) => {
    const [x2, y2] = polygon[(i + 1) % polygon.length];
    return y1 > y !== y2 > y && x < x1 + ((x2 - x1) * (y - y1)) / (y2 - y1) ? !inside : inside;
  }, false);
}

const triangle = [
  [-0.2, -0.2],
  [0.2, -0.2],
  [0, 0.3],
];
const isBehind = (i) => i >= 1600;
console.log(pick(0, 0).some(isBehind), lasso(triangle).some(isBehind)); // → true true

const filter = new HiddenPointFilter(points);
filter.update(camera);
await filter.ready;
console.log(pick(0, 0).some(isBehind), lasso(triangle).some(isBehind)); // → false false
console.log(pick(0, 0).length > 0, lasso(triangle).length > 50); // → true true
filter.dispose();
