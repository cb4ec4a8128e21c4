import { Color } from "three";

/** The colors of the canvas. The page around it has the same colors from styles/theme.css. */
export interface Theme {
  background: string;
  /** Two calm tones from low to high, for files without colors. The shading shows the shape. */
  low: string;
  high: string;
  /** The color of all points, if they are drawn in one color. */
  plain: string;
  /** Hidden points have their own hue. Dimmed points that nothing covers are nearer to the background. */
  hidden: string;
  hiddenDimmed: string;
  /** Selected points. */
  chosen: string;
  /**
   * The differences between our answer and a reference. Everybody can tell the two hues apart, also the color-blind, and
   * nothing else is drawn in them. The page's swatches have the same colors from styles/theme.css.
   */
  onlyOurs: string;
  onlyReference: string;
  /** The marker of a frozen viewpoint. */
  accent: string;
}

export type ThemeName = "dark" | "light";

export const THEMES: Record<ThemeName, Theme> = {
  dark: {
    background: "#14161a",
    low: "#6f8796",
    high: "#efe6d6",
    plain: "#ded8cc",
    hidden: "#a9599c",
    hiddenDimmed: "#4a515c",
    chosen: "#4fb3ff",
    onlyOurs: "#ff8c1a",
    onlyReference: "#1fc8e0",
    accent: "#e7b562",
  },
  light: {
    background: "#eef0f3",
    low: "#587990",
    high: "#c3a375",
    plain: "#8b877f",
    hidden: "#a3348f",
    hiddenDimmed: "#b4bbc4",
    chosen: "#0b6fc4",
    onlyOurs: "#c2570a",
    onlyReference: "#007f99",
    accent: "#8a5a0b",
  },
};

/** The attributes of the context. They are the same as in three.js. */
const CONTEXT: WebGLContextAttributes = { alpha: true, antialias: false, powerPreference: "high-performance" };

/** Whether this browser can draw. Ask it before three.js, which would log an error. three.js then uses this context. */
export function canDraw(canvas: HTMLCanvasElement): boolean {
  return canvas.getContext("webgl2", CONTEXT) !== null;
}

/** The display color for the shaders. The colors of three.js are linear. */
export function display(color: string): Color {
  return new Color(color).convertLinearToSRGB();
}
