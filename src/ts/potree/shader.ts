import { withTest } from "../three/map-shader.js";
import { DIMMED } from "../three/options.js";

/**
 * What `hprMode` is: all points are drawn; the map decides; the last answer does, which has one byte for each point.
 * Potree numbers the points of a node in its attribute `indices`.
 */
export const MODE = { all: 0, map: 1, answer: 2 } as const;

/** A point that is left out is moved out of the picture. A dimmed one cannot be picked either. */
const MAIN = `
uniform highp sampler2D hprAnswer;
uniform highp vec2 hprSize;
uniform highp float hprFirst;
bool hprLeftOut() {
  if (hprMode < 1.5) return hprHidden(hprTurn * (position - hprEye));
  highp float i = hprFirst + dot(floor(indices * 255.0 + 0.5), vec4(1.0, 256.0, 65536.0, 16777216.0));
  highp float row = floor((i + 0.5) / hprSize.x);
  return texture2D(hprAnswer, (vec2(i - hprSize.x * row, row) + 0.5) / hprSize).r < 0.5;
}
void main() {
  bool isLeftOut = hprMode > 0.5 && hprLeftOut();
#if defined(color_type_indices) || !defined(hpr_dim)
  if (isLeftOut) {
    gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
    return;
  }
#endif
  hprMain();
#if defined(hpr_dim)
  if (isLeftOut) vColor *= ${DIMMED};
#endif
}
`;

/** The vertex shaders that were changed, by their text before. Potree compiles each once. */
const changed = new Map<string, string | undefined>();

/** Potree's vertex shader with the test. Undefined if it has no `main`. */
export function withAnswer(vertexShader: string, dims: boolean): string | undefined {
  const key = `${dims} ${vertexShader}`;
  if (!changed.has(key)) changed.set(key, withTest(vertexShader, (dims ? "\n#define hpr_dim" : "") + MAIN));
  return changed.get(key);
}
