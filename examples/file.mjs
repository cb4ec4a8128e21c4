// The visible points of a PLY file, in another file. The command does it for all kinds of files:
// npx hidden-point-removal in.ply --from 0,0,5 -o out.ply
import { mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { init, PointCloud } from "hidden-point-removal";

await init();
const folder = mkdtempSync(join(tmpdir(), "hpr-"));
const [input, output] = [join(folder, "in.ply"), join(folder, "out.ply")];
writeWalls(input);

// ASCII, with vertices that begin with x, y and z.
const text = readFileSync(input, "latin1");
const start = text.indexOf("end_header\n") + "end_header\n".length;
const count = Number(/^element vertex (\d+)/m.exec(text)[1]);
const lines = text.slice(start).split("\n", count);
const positions = lines.flatMap((line) => line.split(" ", 3).map(Number));

const { indices } = new PointCloud(positions).visibleFrom([20, 20, 60]);
const header = text.slice(0, start).replace(/^(element vertex) \d+/m, `$1 ${indices.length}`);
writeFileSync(output, header + Array.from(indices, (i) => `${lines[i]}\n`).join(""));
console.log(`${indices.length} of ${count} points`); // → 1600 of 3200 points

/** Two walls of 40 by 40 points, one behind the other. The last number is the intensity. */
function writeWalls(file) {
  const points = Array.from({ length: 3200 }, (_, i) => [i % 40, Math.floor(i / 40) % 40, i < 1600 ? 0 : -20, i % 256]);
  const properties = ["float x", "float y", "float z", "uchar intensity"].map((one) => `property ${one}\n`).join("");
  const header = `ply\nformat ascii 1.0\nelement vertex 3200\n${properties}end_header\n`;
  writeFileSync(file, header + points.map((point) => `${point.join(" ")}\n`).join(""));
}
