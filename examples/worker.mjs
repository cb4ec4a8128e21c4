// Labels that hide with the place that they name. The cloud is in a worker, so the page never waits.
import { WorkerPointCloud } from "hidden-point-removal/worker";

const positions = new Float32Array(3 * 5000); // a sphere
for (let i = 0; i < 5000; i++) {
  const z = 1 - (2 * i + 1) / 5000;
  const r = Math.sqrt(1 - z * z);
  const turn = 2.399963 * i;
  positions.set([r * Math.cos(turn), r * Math.sin(turn), z], 3 * i);
}
const labels = [
  { text: "north", anchor: [0, 0, 1], hidden: false },
  { text: "south", anchor: [0, 0, -1], hidden: false },
];

const cloud = await WorkerPointCloud.create(positions);
// The anchors are points of the cloud, too. Their indices follow those of the sphere.
const first = cloud.length;
await cloud.append(labels.flatMap(({ anchor }) => anchor));

/** Call whenever the camera has moved. A newer call overtakes one that waits; that one is rejected with an AbortError. */
async function hideLabels(viewpoint) {
  const mask = (await cloud.visibleFrom(viewpoint, { latest: true })).mask();
  labels.forEach((label, i) => {
    label.hidden = mask[first + i] === 0;
  });
}

const shown = () => labels.filter(({ hidden }) => !hidden).map(({ text }) => text);
await hideLabels([0, 0, 5]);
console.log(shown().join()); // → north
await hideLabels([0, 0.5, -5]);
console.log(shown().join()); // → south
await cloud.dispose();
