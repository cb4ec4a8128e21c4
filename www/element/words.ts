import { shownKeys } from "../controls/keys.ts";
import { SAMPLES } from "../samples/samples.ts";
import { FORMATS, listed } from "../settings/formats.ts";
import { PARAMETER_WORDS, SETTING_WORDS, type Words } from "../settings/words.ts";
import type { AttributeName } from "./attributes.ts";

const SAMPLE_NAMES = SAMPLES.map(({ name }) => name);

/** The words of the document about the attributes; no script that is downloaded needs them. */
export const ATTRIBUTE_WORDS: Record<AttributeName, Words> = {
  src: {
    is: `the address of a ${listed(FORMATS, "or")} file; COPC is LAZ. If another file is being loaded, setting it stops that`,
    without: "",
  },
  sample: {
    is: `a cloud of the demo page, instead of \`src\`: ${listed(SAMPLE_NAMES, "or")}. The clouds of the dragon and the bunny need the folder \`samples/\` beside the module`,
    without: "",
  },
  limit: PARAMETER_WORDS.points,
  "skip-non-finite": {
    is: "leaves out points that have no position; the other points get new numbers",
    without: "such a file is refused",
  },
  exponent: PARAMETER_WORDS.exponent,
  radius: SETTING_WORDS.radius,
  looks: SETTING_WORDS.looks,
  inversion: SETTING_WORDS.inversion,
  "hidden-points": { is: `${SETTING_WORDS.hidden.is}; follows the key ${keyOf("hidden")}` },
  frozen: {
    is: `the viewpoint stays where it is while the camera moves on; follows the key ${keyOf("freeze")}`,
    without: "the viewpoint goes with the camera",
  },
  viewpoint: {
    ...PARAMETER_WORDS.view,
    is: "the first place of the camera. If it is set again, the camera moves there again",
  },
  target: { ...PARAMETER_WORDS.target, is: "the place that the camera looks at from the `viewpoint`" },
  "point-size": SETTING_WORDS.size,
  fov: SETTING_WORDS.fieldOfView,
  up: { ...SETTING_WORDS.up, is: `${SETTING_WORDS.up.is}. Changing it goes back to the first view` },
  color: SETTING_WORDS.color,
  label: { is: "the name of the cloud, for people who do not see it", without: "“Point cloud”" },
  announce: {
    is: "screen readers hear how many points are visible, after that number has stopped changing",
    without: "they do not",
  },
};

function keyOf(action: "hidden" | "freeze"): string {
  return `\`${shownKeys(action).join()}\``;
}
