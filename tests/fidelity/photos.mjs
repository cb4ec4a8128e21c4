// node tests/fidelity/photos.mjs: how right are the colors that `transfer` takes from real photos? After `npm run build`.
// It reads 20 photos of 7-Scenes, their cameras and the colors of the points from HPR_SHARED/real (default ../shared).
import { existsSync, readFileSync } from "node:fs";
import { resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { gunzipSync } from "node:zlib";

import { init, PointCloud, transfer } from "hidden-point-removal";
import sharp from "sharp";

const root = fileURLToPath(new URL("../..", import.meta.url));
const folder = resolve(root, process.env["HPR_SHARED"] ?? "../shared", "real");
const file = (name) => readFileSync(resolve(folder, name));

if (existsSync(resolve(folder, "photos/cameras.json"))) await main();
else console.log(`Left out: ${folder}/photos is missing (set HPR_SHARED to the directory that holds it).`);

async function main() {
  await init();
  const { fx, fy, cx, cy, width, height, ...given } = JSON.parse(file("photos/cameras.json").toString());
  // The file puts the center of the first pixel at 0.
  const lens = { fx, fy, cx: cx + 0.5, cy: cy + 0.5, width, height };
  const cameras = given.cameras.map(({ cameraToWorld }) => ({ ...lens, cameraToWorld }));
  const images = await Promise.all(
    given.cameras.map(async ({ image }) => ({
      data: new Uint8Array(
        await sharp(file(`photos/${image}`))
          .removeAlpha()
          .raw()
          .toBuffer(),
      ),
      width,
      height,
    })),
  );
  const cloud = new PointCloud(new Float32Array(Uint8Array.from(gunzipSync(file("7s_2.f32.gz"))).buffer));
  const truth = gunzipSync(file("photos/colors.u8.gz"));
  console.log("| merge | weights | colored, % (even, odd indices) | of them wrong by more than 30 of 255, % |");
  console.log("|---|---|---:|---:|");
  for (const [merge, weights] of [["mean"], ["mean", "score"], ["median"], ["best"]]) {
    const { values, seen } = transfer(cloud, cameras, images, { merge, weights });
    const halves = [0, 1].map((half) => shares(values, seen, truth, half));
    const column = (name) => halves.map((shares) => (100 * shares[name]).toFixed(1)).join(", ");
    console.log(`| ${merge} | ${weights ?? "none"} | ${column("colored")} | ${column("wrong")} |`);
  }
  const { mean, median } = leftOut(cloud.seenBy(cameras, { looks: 3 }), images);
  console.log(`A photo that was left out, predicted by at least 3 others: mean ${mean}, median ${median} (RMS).`);
}

/** How far the colors of each photo are from those that the other photos give its points. */
function leftOut({ offsets, cameras, pixels }, images) {
  const squares = { mean: 0, median: 0 };
  let count = 0;
  const value = (k, c) => {
    const { data, width } = images[cameras[k]];
    return data[3 * (Math.floor(pixels[2 * k + 1]) * width + Math.floor(pixels[2 * k])) + c];
  };
  for (let i = 0; i + 1 < offsets.length; i++) {
    if (offsets[i + 1] - offsets[i] < 4) continue;
    for (let c = 0; c < 3; c++) {
      const values = Array.from({ length: offsets[i + 1] - offsets[i] }, (_, k) => value(offsets[i] + k, c));
      const sum = values.reduce((a, b) => a + b);
      const sorted = values.toSorted((a, b) => a - b);
      for (const own of values) {
        const others = sorted.toSpliced(sorted.indexOf(own), 1);
        const half = (others.length - 1) / 2;
        squares.mean += (own - (sum - own) / others.length) ** 2;
        squares.median += (own - (others[Math.floor(half)] + others[Math.ceil(half)]) / 2) ** 2;
        count += 1;
      }
    }
  }
  return Object.fromEntries(Object.entries(squares).map(([name, sum]) => [name, Math.sqrt(sum / count).toFixed(1)]));
}

/** The shares of every other point, of those whose color is known. */
function shares(values, seen, truth, half) {
  let [judged, colored, wrong] = [0, 0, 0];
  for (let i = half; i < seen.length; i += 2) {
    if (truth[3 * seen.length + i] === 0) continue;
    judged += 1;
    if (seen[i] === 0) continue;
    colored += 1;
    wrong += [0, 1, 2].some((c) => Math.abs(values[3 * i + c] - truth[3 * i + c]) > 30);
  }
  return { colored: colored / judged, wrong: wrong / colored };
}
