// Figure 8 of the paper: R too small, as chosen, too large.
import { count, type Maker, NARROW, radiusOf, sheet, small } from "./figure.js";
import type { Query } from "./studio.js";

const VIEWPOINT = "0.077,0.2,0.232";
const BEHIND = "-0.04,0.225,-0.24";
const CHOICES: [label: string, query: Query][] = [
  ["too small", { exponent: 1.8 }],
  ["automatic", {}],
  ["too large", { exponent: 4.4 }],
];

export const radius: Maker = async (studio) => {
  const front = [];
  const behind = [];
  const words = [];
  for (const [label, choice] of CHOICES) {
    const query = { sample: "dragon_res2", ...choice };
    const shot = await studio.shoot({ ...query, view: VIEWPOINT }, NARROW);
    const back = await studio.shoot({ ...query, freeze: VIEWPOINT, view: BEHIND }, NARROW);
    front.push({ label: `${label}: ${count(shot.status["visible"])} visible`, png: shot.png });
    behind.push({ label: "the same from behind", png: back.png });
    words.push(`${label} ${radiusOf(shot)}, ${count(shot.status["visible"])} visible`);
  }
  return [
    {
      name: "radius",
      title: "Too small, automatic, too large (paper: Fig. 8)",
      caption:
        "If the sphere is too small, deep parts are missing: the neck behind the jaw, the far side of the coils. If it is too large, " +
        "they are there, but the view from behind shows that points of the back count as visible, too, through gaps between the points in front. " +
        `${count(100_250)} points of the dragon from (${VIEWPOINT.replaceAll(",", ", ")}), marked in the lower row: ${words.join("; ")}.`,
      png: await small(await sheet(studio, [...front, ...behind], CHOICES.length, NARROW)),
    },
  ];
};
