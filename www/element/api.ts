/*
 * What `hidden-point-cloud.js` gives a page. This file is published beside it as its types, so it depends on nothing.
 */

/** x, y, z in the file's own coordinates. */
export type Place = [number, number, number];

/** A point that was met in the picture. */
export interface PickedPoint {
  /** Of the point in the file, counted from 0. */
  index: number;
  position: Place;
  /** Whether it can be seen from the viewpoint. */
  visible: boolean;
}

/**
 * What went wrong. `attribute`: a value that cannot be used, or does not suit the cloud or the place; the usual one is
 * used instead. `source`: the file could not be had, or not be read. `webgl`: the browser cannot draw, or has taken the picture away for the time being. The others are
 * those of the package: `load` (the WebAssembly file or a worker), `too-large`, `internal`.
 */
export interface HiddenPointCloudError extends Error {
  readonly code: string;
  /** The attribute's name, where it is one. */
  readonly attribute?: string;
}

/** None of them bubbles. */
export interface HiddenPointCloudEventMap {
  /** A cloud is there, with its first answer. `notes`: sentences about the file, such as that not all of its points are shown. */
  load: CustomEvent<{ total: number; notes: string[] }>;
  /** Other points are visible; also after `load`. `radius` is 0 where the inversion has none. */
  change: CustomEvent<{ count: number; viewpoint: Place; radius: number; milliseconds: number }>;
  /** How far the loading is, from 0 to 1; `null` where nobody knows. */
  progress: CustomEvent<{ fraction: number | null }>;
  error: CustomEvent<{ error: HiddenPointCloudError }>;
  /** A visible point was clicked, or is in the middle of the picture when Enter is pressed. */
  pick: CustomEvent<PickedPoint>;
}

export type RadiusRule = "auto" | "search" | "opposite";

/** `<hidden-point-cloud>`. Each property up to `announce` is the attribute of its name; `null` stands for none. */
export interface HiddenPointCloudElement extends HTMLElement {
  /** Address of a LAS, LAZ, COPC, PLY, PCD, XYZ, TXT, CSV, OBJ, glTF or GLB file. */
  src: string | null;
  /** One of the demo page's own clouds, whose files are beside the module. `src` goes first. */
  sample: string | null;
  /** Of more points than these, only every so manyth is shown. */
  limit: number | null;
  /** Leaves points out whose coordinates are not finite; else such a file is refused. */
  skipNonFinite: boolean;
  /** log₁₀ of radius ÷ farthest distance, 0 to 6. Goes before `radius`. */
  exponent: number | null;
  /** How the flipping sphere's radius is chosen, or how large it is in the file's units. */
  radius: RadiusRule | number | null;
  /** `spherical`, `exponential`, `exponential:c` (c in spacings), `power` or `power:γ`. */
  inversion: string | null;
  hiddenPoints: "off" | "dimmed" | "shown";
  /** Whether the viewpoint stays where it is while the camera moves on. */
  frozen: boolean;
  /** Where the camera is, also when it has been moved; to be set with `target` for another first view. */
  viewpoint: Place | null;
  /** What the camera looks at. */
  target: Place | null;
  /** In multiples of the points' rough distance from one another, 0.05 to 50. */
  pointSize: number | null;
  /** The vertical field of view in degrees, 5 to 100. */
  fov: number | null;
  up: "y" | "z" | "-y" | null;
  /** `own`, `plain`, `height` or the name of an attribute of the file. */
  color: string | null;
  /** What the cloud is, for those who do not see it. */
  label: string | null;
  /** Whether screen readers hear how many points are visible when that has changed. */
  announce: boolean;

  /** `empty`: there is no `src`, or the element is in no document. */
  readonly state: "empty" | "loading" | "ready" | "error";
  /** Settled when the cloud of `src`, or of `sample`, is there or has failed; a new promise for each new one. */
  readonly ready: Promise<void>;
  /** How many points there are; 0 without a cloud. */
  readonly count: number;
  readonly visibleCount: number;
  /** A copy of the visible points' indices, ascending. */
  readonly visible: Uint32Array;

  /** Back to the first view. */
  reset(): void;
  /** The visible point there, or with `through` any; in client coordinates, as events of the mouse have them. `tolerance` in CSS pixels, 8. */
  pick(clientX: number, clientY: number, options?: { through?: boolean; tolerance?: number }): PickedPoint | null;
  /** Where a place is in the picture, in client coordinates; `null` where that is behind the camera. */
  project(position: ArrayLike<number>): { x: number; y: number } | null;
  /** The picture as it is, as a PNG file. */
  toBlob(): Promise<Blob>;

  addEventListener<Type extends keyof HiddenPointCloudEventMap>(
    type: Type,
    listener: (this: HiddenPointCloudElement, event: HiddenPointCloudEventMap[Type]) => unknown,
    options?: boolean | AddEventListenerOptions,
  ): void;
  addEventListener(
    type: string,
    listener: EventListenerOrEventListenerObject | null,
    options?: boolean | AddEventListenerOptions,
  ): void;
  removeEventListener<Type extends keyof HiddenPointCloudEventMap>(
    type: Type,
    listener: (this: HiddenPointCloudElement, event: HiddenPointCloudEventMap[Type]) => unknown,
    options?: boolean | EventListenerOptions,
  ): void;
  removeEventListener(
    type: string,
    listener: EventListenerOrEventListenerObject | null,
    options?: boolean | EventListenerOptions,
  ): void;
}

/** To be made by `document.createElement`, or with `new`. Importing the module defines the element. */
export declare const HiddenPointCloudElement: { new (): HiddenPointCloudElement; prototype: HiddenPointCloudElement };

declare global {
  interface HTMLElementTagNameMap {
    "hidden-point-cloud": HiddenPointCloudElement;
  }
}
