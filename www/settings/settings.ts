import type { Up } from "../cloud/cloud.ts";

/** x, y, z in the file's own coordinates. */
export type Viewpoint = [number, number, number];

/** What happens to the hidden points. */
export type HiddenMode = "off" | "dimmed" | "shown";

/** How the flipping sphere's radius R is chosen, or how large it is: in the file's units, or as log₁₀(R ÷ farthest distance). */
export type Radius = { rule: "auto" | "search" | "opposite" } | { exponent: number } | { length: number };

/** How points are flipped. The exponential's c is counted in the cloud's spacings, so that it suits clouds of any size. */
export type Inversion = "spherical" | { exponential: number | "auto" } | { power: number | "auto" };

/** In what colors the page is: those the system asks for, or one theme in any case. */
export type ThemeChoice = "system" | "dark" | "light";

/** One viewpoint, or it with a ring of four around it: what any of the five sees, or at least two. */
export type Viewpoints = "one" | "any" | "two";

/** What ours is compared with: nothing hidden at all, the z-buffer of the same picture, or what rays see of the true surface. */
export type Against = "all" | "zbuffer" | "surface";

/** Everything that can be set on the page. The panel and the address change it; the questions and the picture follow from it. */
export interface Settings {
  hidden: HiddenMode;
  radius: Radius;
  inversion: Inversion;
  viewpoints: Viewpoints;
  /** Nearest neighbors; 0 is off. */
  denoise: number;
  vote: number;
  show: "points" | "surface";
  /** The longest edge of the surface's triangles in spacings; Infinity keeps all. */
  edge: number;
  lights: readonly Viewpoint[];
  /** The radius of a light as a share of its distance from the middle of the cloud; 0 is a point. */
  soft: number;
  ambient: number;
  /** Rounds. */
  smoothing: number;
  /** Where the viewpoint stays while the camera moves on. */
  freeze: Viewpoint | null;
  /** Where the picture is divided, as a share of its width: what ours is compared with to the left, visible points to the right. */
  compare: number | null;
  against: Against;
  /** How wide the z-buffer draws a point, in pixels. */
  splat: number | "auto";
  /** "own" for the file's own colors (without any, two calm tones from low to high), "plain", "height", or the name of an attribute. */
  color: string;
  /** Of a point, in multiples of the points' rough distance from one another. */
  size: number;
  /** Vertical, in degrees. */
  fieldOfView: number;
  up: Up;
  theme: ThemeChoice;
}

/** The file's own colors. */
export const OWN_COLORS = "own";

/** The library's automatic c, in spacings. */
export const AUTOMATIC_C = 0.07;

/** The library's own default. */
export const USUAL_EDGE = 5;

export const USUAL_SETTINGS: Settings = {
  hidden: "off",
  radius: { rule: "auto" },
  inversion: "spherical",
  viewpoints: "one",
  denoise: 0,
  vote: 0,
  show: "points",
  edge: USUAL_EDGE,
  lights: [],
  soft: 0,
  // Where no light comes one still sees what is there.
  ambient: 0.3,
  smoothing: 1,
  freeze: null,
  compare: null,
  against: "all",
  splat: "auto",
  color: OWN_COLORS,
  size: 1,
  fieldOfView: 45,
  up: "y",
  theme: "system",
};

type Listener = (now: Settings, before: Settings) => void;

/** The settings as they are now. Each change makes a new object, so that a setting that is the same object is unchanged. */
export class Store {
  #settings: Settings;
  readonly #listeners: Listener[] = [];

  constructor(settings: Settings) {
    this.#settings = settings;
  }

  get current(): Settings {
    return this.#settings;
  }

  change(part: Partial<Settings>): void {
    const before = this.#settings;
    this.#settings = { ...before, ...part };
    for (const listener of this.#listeners) listener(this.#settings, before);
  }

  /** Tells of the settings now and of every change from now on. */
  follow(listener: Listener): void {
    this.#listeners.push(listener);
    listener(this.#settings, this.#settings);
  }
}
