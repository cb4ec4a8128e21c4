/** x, y, z in the file's own coordinates. */
export type Viewpoint = [number, number, number];

/** What happens to the hidden points. */
export type HiddenMode = "off" | "dimmed" | "shown";

/**
 * The radius R of the flipping sphere: chosen automatically, or its length in the file's units, or its exponent
 * log₁₀(R ÷ farthest distance).
 */
export type Radius = { rule: "auto" } | { exponent: number } | { length: number };

/** How many looks make the answer when the camera rests (docs/LOOKS.md). 0: the operator of the paper. */
export type Looks = 0 | 2 | 3;

/** How points are flipped. The exponential's c is counted in spacings, so that it suits clouds of any size. */
export type Inversion = "spherical" | { exponential: number | "auto" };

/** The colors of the page: those that the system asks for, or always one theme. */
export type ThemeChoice = "system" | "dark" | "light";
