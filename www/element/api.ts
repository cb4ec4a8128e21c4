/*
 * The interface of `hidden-point-cloud.js`. This file is published beside it as its types, so it imports nothing.
 */

/** x, y, z in the file's own coordinates. */
export type Place = [number, number, number];

/** A point of the picture. */
export interface PickedPoint {
  /** The number of the point in the file, counted from 0. */
  index: number;
  position: Place;
  /** Whether it can be seen from the viewpoint. */
  visible: boolean;
}

/**
 * What went wrong. `attribute`: a value cannot be used, or does not suit the cloud or the place, and the usual one is used.
 * `source`: the file could not be downloaded, or not be read. `webgl`: the browser cannot draw, or has taken the picture
 * away for a while. The package's own codes are `load` (the WebAssembly file or a worker), `too-large` and `internal`.
 */
export interface HiddenPointCloudError extends Error {
  readonly code: string;
  /** The name of the attribute, if a single one is to blame. */
  readonly attribute?: string;
}

/** The events. None of them bubbles. */
export interface HiddenPointCloudEventMap {
  /** A cloud is there, with its first answer. `notes`: sentences about the file, e.g. that only a share of it is shown. */
  load: CustomEvent<{ total: number; notes: string[] }>;
  /**
   * Other points are visible; also after `load`. `radius` is 0 if the inversion or the looks have none. While the camera
   * moves, a cloud of 10,000 points and more is drawn by maps, which have no event. When it rests, the answer comes.
   */
  change: CustomEvent<{
    count: number;
    viewpoint: Place;
    radius: number;
    milliseconds: number;
    answer: "operator" | "looks";
  }>;
  /** The progress of the loading, from 0 to 1; `null` if it is not known. */
  progress: CustomEvent<{ fraction: number | null }>;
  error: CustomEvent<{ error: HiddenPointCloudError }>;
  /** A visible point was clicked, or was in the middle of the picture when Enter was pressed. */
  pick: CustomEvent<PickedPoint>;
}

/** `<hidden-point-cloud>`. Each property up to `label` is the attribute of its name; `null` without the attribute. */
export interface HiddenPointCloudElement extends HTMLElement {
  /** Address of a LAS, LAZ, COPC, PLY, PCD, XYZ, TXT, CSV, OBJ, glTF or GLB file. */
  src: string | null;
  /** One of the demo page's own clouds, whose files are beside the module. `src` goes first. */
  sample: string | null;
  /** How many points of a file are shown at most; of a larger file an even share is shown. */
  limit: number | null;
  /** Leaves points out whose coordinates are not finite. Otherwise such a file is refused. */
  skipNonFinite: boolean;
  /** log₁₀ of radius ÷ farthest distance, 0 to 6. With it, `radius` is not used. */
  exponent: number | null;
  /** How the flipping sphere's radius is chosen, or how large it is in the file's units. */
  radius: "auto" | number | null;
  /** How many looks make the answer when the camera rests; 0 is one hull. Only without the three around it. */
  looks: 0 | 2 | 3 | null;
  /** `spherical`, `exponential` or `exponential:c` (c in spacings). */
  inversion: string | null;
  hiddenPoints: "off" | "dimmed" | "shown";
  /** Whether the viewpoint stays where it is while the camera moves on. */
  frozen: boolean;
  /** Where the camera is now. Setting it, alone or with `target`, makes another first view. */
  viewpoint: Place | null;
  /** What the camera looks at. */
  target: Place | null;
  /** The size of a point, in multiples of the points' rough distance from one another, 0.05 to 50. */
  pointSize: number | null;
  /** The vertical field of view in degrees, 5 to 100. */
  fov: number | null;
  up: "y" | "z" | "-y" | null;
  /** `own`, `plain`, `height` or the name of an attribute of the file. */
  color: string | null;
  /** What the cloud is, for people who do not see it. */
  label: string | null;

  /** `empty`: there is no `src`, or the element is in no document. */
  readonly state: "empty" | "loading" | "ready" | "error";
  /** Settled when the cloud of `src` or `sample` is there, or has failed. Each new one has a new promise. */
  readonly ready: Promise<void>;
  /** How many points there are; 0 without a cloud. */
  readonly count: number;
  readonly visibleCount: number;
  /** A copy of the visible points' indices, ascending. */
  readonly visible: Uint32Array;

  /** Back to the first view. */
  reset(): void;
  /**
   * The visible point at a place, or with `through` any point. In client coordinates, as mouse events have them;
   * `tolerance` is 8 CSS pixels by default.
   */
  pick(clientX: number, clientY: number, options?: { through?: boolean; tolerance?: number }): PickedPoint | null;
  /** The place of a position in the picture, in client coordinates; `null` behind the camera. */
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

/** Make one by `document.createElement` or with `new`. Importing the module defines the element. */
export declare const HiddenPointCloudElement: { new (): HiddenPointCloudElement; prototype: HiddenPointCloudElement };

declare global {
  interface HTMLElementTagNameMap {
    "hidden-point-cloud": HiddenPointCloudElement;
  }
}
