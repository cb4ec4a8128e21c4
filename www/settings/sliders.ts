import { FIELD_OF_VIEW, MOST_EXPONENT } from "./limits.ts";

/** The track of a slider of the panel. The address may allow values beyond the ends of the track. */
export interface Slider {
  least: number;
  most: number;
  step: number;
  /** The words beside the slider for a place on its track. */
  text: (at: number) => string;
  /** The place of a value on the track, and the value at a place, if these are not the same number. */
  at?: (value: number) => number;
  from?: (at: number) => number;
}

/** The end of the track stands for all edges. */
const ALL_EDGES = 21;

/** The sliders, by the name of their setting or parameter. */
export const SLIDERS = {
  edge: {
    least: 1,
    most: ALL_EDGES,
    step: 0.5,
    text: (at) => (at >= ALL_EDGES ? "all" : `${at} spacings`),
    at: (edge) => (edge === Infinity ? ALL_EDGES : edge),
    from: (at) => (at >= ALL_EDGES ? Infinity : at),
  },
  soft: { least: 0, most: 0.5, step: 0.01, text: (at) => (at === 0 ? "point lights" : at.toFixed(2)) },
  ambient: { least: 0, most: 1, step: 0.01, text: (at) => at.toFixed(2) },
  smoothing: { least: 0, most: 10, step: 1, text: (at) => `${at} ${at === 1 ? "round" : "rounds"}` },
  size: { least: 0.1, most: 5, step: 0.05, text: (at) => `${Number(at.toFixed(2))} ×` },
  fieldOfView: { ...FIELD_OF_VIEW, step: 1, text: (at) => `${Math.round(at)}°` },
  exponent: { least: 0, most: MOST_EXPONENT, step: 0.05, text: (at) => at.toFixed(2) },
} satisfies Record<string, Slider>;
