import { VisibilityMap } from "hidden-point-removal";
import { TINT_SHADER } from "./attributes.ts";

/** The greatest width of a point in pixels, of points that touch and of small ones. */
export const MOST_PIXELS = { touching: 160, small: 5 };

export const vertexShader = /* glsl */ `
  ${TINT_SHADER}
  /* The width of a point in the cloud's units, and the length of a unit at distance 1 in pixels. */
  uniform float width, pixels;
  /* The least width of a point in pixels: a smaller one flickers. The greatest one: a wider one would be a balloon. */
  uniform float least, most;
  uniform vec3 cover;
  uniform float coverage;
  /* 0: all points are drawn. 1: those that the map does not hide. -1: those that it hides. */
  uniform float byMap;
  /* The part of the picture that is shown, from left to right in clip space, and the width of a pixel there. */
  uniform vec3 part;
  ${VisibilityMap.prototype.glsl}
  varying vec3 tint;
  varying float size;

  void main() {
    if (byMap != 0.0 && (byMap > 0.0) == hidden(position)) {
      gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
      gl_PointSize = 0.0;
      return;
    }
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
    size = clamp(width * pixels / gl_Position.w, least, max(least, most));
    gl_PointSize = size;
    // Far beyond the dividing line, nobody sees the point, nor its shade.
    float x = gl_Position.x / gl_Position.w;
    float near = (size + 16.0) * part.z;
    if (gl_Position.w > 0.0 && (x < part.x - near || x > part.y + near)) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    tint = chosenOr(mix(ownTint(), cover, coverage));
  }
`;

export const fragmentShader = /* glsl */ `
  varying vec3 tint;
  varying float size;

  void main() {
    // Below three pixels a disc and a square look alike.
    if (size > 3.0 && length(gl_PointCoord - 0.5) > 0.5) discard;
    gl_FragColor = vec4(tint, 1.0);
  }
`;
