// Draws docs/street.png and docs/room.png: node tests/figures/cameras.mjs (after npm run build).
import sharp from "sharp";
import { cameraFromPose, init, PointCloud } from "hidden-point-removal";

await init();
await street();
await room();

/** A street as a spinning lidar scans it from five places, and the image of one camera. */
async function street() {
  const boxes = [
    ...[-1, 1].flatMap((side) =>
      [0, 18, 36, 54].map((x, i) => box(x - 4, x + 10 + 2 * (i % 2), side > 0 ? 9 : -15, side > 0 ? 15 : -9, 0, 9)),
    ),
    box(30, 34.2, 2.6, 4.4, 0, 1.5),
    box(14, 18.3, -5.4, -3.6, 0, 1.6),
    box(22, 26.5, -5.4, -3.6, 0, 2.2),
    box(20, 20.5, 5, 5.6, 0, 1.8),
    ...[10, 25, 40].map((x) => box(x, x + 0.2, 6, 6.2, 0, 6)),
  ];
  const positions = [];
  for (const place of [0, 8, 16, 24, 32]) {
    for (let beam = 0; beam < 64; beam++) {
      const down = ((2 - (26.8 * beam) / 63) * Math.PI) / 180;
      for (let turn = 0; turn < 1800; turn += 2) {
        const angle = (turn * Math.PI) / 900;
        const ahead = [Math.cos(down) * Math.cos(angle), Math.cos(down) * Math.sin(angle), Math.sin(down)];
        const eye = [place, 0, 1.73];
        const distance = hit(eye, ahead, boxes);
        if (distance < 80) positions.push(...eye.map((x, axis) => x + distance * ahead[axis]));
      }
    }
  }
  const [width, height] = [1242, 375];
  // x to the right is -y of the street, y down is -z, z forward is x.
  const camera = cameraFromPose([0.27, 0, 1.65], [0.5, -0.5, 0.5, -0.5], {
    fx: 721.5, fy: 721.5, cx: 609.6, cy: 172.9, width, height,
  }); // prettier-ignore
  const cloud = new PointCloud(positions);
  const everything = Uint32Array.from({ length: cloud.length }, (_, i) => i);
  const all = inImage(positions, everything, camera);
  const seen = cloud.visibleFromCamera(camera, { looks: 3 });
  const visible = Array.from(seen.indices, (_, i) => [seen.pixels[2 * i], seen.pixels[2 * i + 1], seen.depths[i]]);
  const picture = canvas(width, 2 * height + 4);
  for (const [top, points] of [
    [0, all],
    [height + 4, visible],
  ]) {
    for (const [u, v, depth] of points) dot(picture, u, v + top, byDepth(depth), [top, top + height]);
  }
  await save(picture, "docs/street.png", [
    [12, 24, `All ${all.length.toLocaleString("en")} points in the image: walls show through cars and other walls`],
    [12, height + 28, `The ${visible.length.toLocaleString("en")} visible points (looks: 3)`],
  ]);
  console.log(`street: ${cloud.length} points, ${all.length} in the image, ${visible.length} of them visible`);
}

/** A room, the three scanners that placeViewpoints chooses for it, and what each adds. */
async function room() {
  const furniture = [
    box(2, 4, 2, 3.2, 0.7, 0.8), box(6.6, 8, 0, 2, 0, 2.1), box(0, 0.6, 3, 6, 0, 2.2), box(4.8, 5.1, 3, 6, 0, 2.6),
    box(6, 7.6, 4.6, 6, 0, 0.6), box(1.4, 2, 0.2, 0.8, 0, 0.9),
  ]; // prettier-ignore
  const shell = box(0, 8, 0, 6, 0, 2.6);
  const positions = [shell, ...furniture].flatMap((one) => surface(one, 0.05));
  const cloud = new PointCloud(positions);
  const candidates = [];
  for (let x = 0.75; x < 8; x += 0.75) {
    for (let y = 0.75; y < 6; y += 0.75) {
      if (
        furniture.every(
          ([low, high]) => !(x > low[0] - 0.3 && x < high[0] + 0.3 && y > low[1] - 0.3 && y < high[1] + 0.3),
        )
      ) {
        candidates.push([x, y, 1.6]);
      }
    }
  }
  const options = { looks: 3 };
  const { chosen, gains } = cloud.placeViewpoints(candidates, { ...options, count: 3 });
  const first = new Uint8Array(cloud.length).fill(3);
  chosen.toReversed().forEach((candidate, i) => {
    for (const index of cloud.visibleFrom(candidates[candidate], options).indices) first[index] = 2 - i;
  });
  const colors = [[77, 171, 247], [255, 169, 77], [105, 219, 124], [70, 70, 78]]; // prettier-ignore
  const [width, height] = [440, 330];
  const picture = canvas(3 * width, height);
  const project = (x, y, z) => [20 + 40 * x + 12 * y, 300 - 24 * y - 38 * z];
  for (let step = 0; step < 3; step++) {
    for (let i = 0; i < cloud.length; i++) {
      const [x, y, z] = positions.slice(3 * i, 3 * i + 3);
      // The ceiling and the two near walls are left out, so that one looks into the room.
      if (z > 2.59 || y < 0.01 || x > 7.99) continue;
      const [u, v] = project(x, y, z);
      dot(picture, u + step * width, v, colors[first[i] <= step ? first[i] : 3], [0, height]);
    }
  }
  const labels = chosen.map((candidate, step) => {
    for (let before = 0; before <= step; before++) {
      const [u, v] = project(...candidates[chosen[before]]);
      for (let a = -5; a <= 5; a++) {
        for (let b = -5; b <= 5; b++) dot(picture, u + step * width + a, v + b, [255, 255, 255], [0, height]);
      }
    }
    const sum = gains.slice(0, step + 1).reduce((all, gain) => all + gain, 0);
    const share = (count) => `${((100 * count) / cloud.length).toFixed(1)} %`;
    return [step * width + 20, 24, `${step + 1}: adds ${share(gains[step])}, together ${share(sum)}`];
  });
  await save(picture, "docs/room.png", labels);
  console.log(`room: ${cloud.length} points, ${candidates.length} candidates, gains ${gains.join(", ")}`);
}

function box(x0, x1, y0, y1, z0, z1) {
  return [[x0, y0, z0], [x1, y1, z1]]; // prettier-ignore
}

/** The distance to the first box, or to the ground. */
function hit(eye, ahead, boxes) {
  let nearest = ahead[2] < 0 ? -eye[2] / ahead[2] : Infinity;
  for (const [low, high] of boxes) {
    let [enter, leave] = [0, Infinity];
    for (let axis = 0; axis < 3; axis++) {
      const [a, b] = [(low[axis] - eye[axis]) / ahead[axis], (high[axis] - eye[axis]) / ahead[axis]];
      [enter, leave] = [Math.max(enter, Math.min(a, b)), Math.min(leave, Math.max(a, b))];
    }
    if (enter < leave && enter > 0) nearest = Math.min(nearest, enter);
  }
  return nearest;
}

/** Points on the six faces of a box. */
function surface([low, high], gap) {
  const points = [];
  for (let axis = 0; axis < 3; axis++) {
    const [s, t] = [(axis + 1) % 3, (axis + 2) % 3];
    for (const side of [low[axis], high[axis]]) {
      for (let a = low[s] + gap / 2; a < high[s]; a += gap) {
        for (let b = low[t] + gap / 2; b < high[t]; b += gap) {
          const point = [0, 0, 0];
          [point[axis], point[s], point[t]] = [side, a, b];
          points.push(...point);
        }
      }
    }
  }
  return points;
}

/** The pixels and depths of points, hidden or not. */
function inImage(positions, indices, { cameraToWorld: m, fx, fy, cx, cy, width, height }) {
  const found = [];
  for (const i of indices) {
    const from = [0, 1, 2].map((axis) => positions[3 * i + axis] - m[12 + axis]);
    const [x, y, z] = [0, 4, 8].map((row) => m[row] * from[0] + m[row + 1] * from[1] + m[row + 2] * from[2]);
    const [u, v] = [(fx * x) / z + cx, (fy * y) / z + cy];
    if (z > 0 && u >= 0 && u < width && v >= 0 && v < height) found.push([u, v, z]);
  }
  return found;
}

/** From yellow (near) over red to blue (far). */
function byDepth(depth) {
  const t = Math.min(1, Math.log(depth / 4) / Math.log(15));
  return t < 0.5 ? [255, 220 - 320 * t, 60] : [255 - 380 * (t - 0.5), 60 + 160 * (t - 0.5), 60 + 390 * (t - 0.5)];
}

function canvas(width, height) {
  return { width, height, data: Buffer.alloc(3 * width * height, 18) };
}

function dot({ width, data }, u, v, color, [top, bottom]) {
  for (const [a, b] of [[0, 0], [1, 0], [0, 1], [1, 1]]) {
    const [x, y] = [Math.floor(u) + a, Math.floor(v) + b];
    if (x >= 0 && x < width && y >= top && y < bottom) color.forEach((value, i) => (data[3 * (y * width + x) + i] = value));
  } // prettier-ignore
}

async function save({ width, height, data }, file, labels) {
  const words = labels
    .map(
      ([x, y, text]) =>
        `<text x="${x}" y="${y}" fill="#fff" stroke="#121212" stroke-width="4" paint-order="stroke">${text}</text>`,
    )
    .join("");
  const svg = `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" font-family="sans-serif" font-size="17">${words}</svg>`;
  await sharp(data, { raw: { width, height, channels: 3 } })
    .composite([{ input: Buffer.from(svg) }])
    .png({ palette: true, colors: 64, compressionLevel: 9 })
    .toFile(file);
}
