/** What the canvas is drawn in. The page around it has the same colors from theme.css. */
export interface Theme {
  background: string;
  /** Where a file has no colors: from low to high, two calm tones that leave the shape to the shading. */
  low: string;
  high: string;
  /** All points alike. */
  plain: string;
  /** Hidden points have a hue of their own; dimmed ones are nearer the background where nothing stands before them. */
  hidden: string;
  hiddenDimmed: string;
  /** Selected points. */
  chosen: string;
  /**
   * Where ours and a reference differ. Apart in hue for everyone, also for eyes that do not tell red from green or blue
   * from yellow, and in neither color are points drawn else. The page's swatches have them from theme.css.
   */
  onlyOurs: string;
  onlyReference: string;
  /** The inside of a surface, seen from behind. */
  inside: string;
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
    inside: "#59616b",
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
    inside: "#929aa4",
    accent: "#8a5a0b",
  },
};
