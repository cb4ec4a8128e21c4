// Imports no three: the script for pages without a bundler has it, too.
import { GLSL } from "../cloud/visibility-shader.js";

const TEXEL = "  return texelFetch(hprDepths, ivec2(i & 255, i >> 8), 0).r;";

/** Version 1 of the language reads no single texels: `hprRow` is the height of one. */
const ANY_TEXEL = `#if __VERSION__ >= 300
${TEXEL}
#else
  highp float row = floor((float(i) + 0.5) / 256.0);
  return texture2D(hprDepths, vec2((float(i) - 256.0 * row + 0.5) / 256.0, (row + 0.5) * hprRow)).r;
#endif`;

/**
 * The test of a point. `hprEye` is the viewpoint in the space of the points, `hprTurn` goes from there to the space of
 * the map.
 */
const TEST = `
uniform highp float hprMode;
uniform highp float hprRow;
uniform highp vec3 hprEye;
uniform highp mat3 hprTurn;
${GLSL.replace("bool hidden(", "bool hprHidden(").replace(TEXEL, ANY_TEXEL)}`;

const MAIN_HEAD = /\bvoid\s+main\s*\(\s*(?:void)?\s*\)/;

/**
 * A vertex shader in any version of the language whose `main` does this, with its own one as `hprMain`. Undefined if it
 * has no `main`.
 */
export function withTest(vertexShader: string, main: string): string | undefined {
  if (!MAIN_HEAD.test(vertexShader)) return undefined;
  return `${vertexShader.replace(MAIN_HEAD, "void hprMain()")}${TEST}${main}`;
}
