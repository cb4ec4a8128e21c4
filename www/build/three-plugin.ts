import { createRequire } from "node:module";
import type { Plugin } from "vite";

/** The renderer puts these pieces into every program. */
const USED = ["colorspace_pars_fragment", "tonemapping_pars_fragment"];
const PIECE = /three\/src\/renderers\/shaders\/Shader(Chunk|Lib)\/(\w+)\.glsl\.js$/;

/**
 * Leaves out the shaders of three.js's own materials: the page draws only with its own ones. This makes the first
 * download smaller by 27 kB. A file of three.js's single module cannot be left out, so its sources are bundled instead.
 */
export function ownShadersOnly(): Plugin {
  const require = createRequire(import.meta.url);
  return {
    name: "own-shaders-only",
    apply: "build",
    enforce: "pre",
    resolveId: (id) => (id === "three" ? require.resolve("three/src/Three.js") : null),
    load: (id) => {
      const [, kind, name] = PIECE.exec(id) ?? [];
      if (kind === "Lib") return 'export const vertex = "", fragment = "";';
      return kind === "Chunk" && !USED.includes(name!) ? 'export default "";' : null;
    },
  };
}
