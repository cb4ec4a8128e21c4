/** The attributes of the context. They are the same as in three.js. */
const CONTEXT: WebGLContextAttributes = { alpha: true, antialias: false, powerPreference: "high-performance" };

/** Whether this browser can draw. Ask it before three.js, which would log an error. three.js then uses this context. */
export function canDraw(canvas: HTMLCanvasElement): boolean {
  return canvas.getContext("webgl2", CONTEXT) !== null;
}
