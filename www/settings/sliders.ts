import { FIELD_OF_VIEW, MOST_EXPONENT } from "./limits.ts";

/** The track of a slider of the panel. The address may allow values beyond the ends of the track. */
export interface Slider {
  least: number;
  most: number;
  step: number;
  /** The words beside the slider for a place on its track. */
  text: (at: number) => string;
}

/** The sliders, by the name of their setting or parameter. */
export const SLIDERS = {
  size: { least: 0.1, most: 5, step: 0.05, text: (at) => `${Number(at.toFixed(2))} ×` },
  fieldOfView: { ...FIELD_OF_VIEW, step: 1, text: (at) => `${Math.round(at)}°` },
  exponent: { least: 0, most: MOST_EXPONENT, step: 0.05, text: (at) => at.toFixed(2) },
} satisfies Record<string, Slider>;
