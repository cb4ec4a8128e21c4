// Figures 2, 9 and 10 of the paper: all points, and the visible points.
import { bunny36k } from "../bench/clouds.js";
import { count, type Figure, from, type Maker, PANEL, radiusOf, sheet, small } from "./figure.js";
import { pointPly } from "./ply.js";
import type { Query, Studio } from "./studio.js";

interface Pair {
  name: string;
  title: string;
  look: string;
  query: Query;
}

export const beforeAfter: Maker = async (studio) => [
  ...(await bunny(studio)),
  await pair(studio, {
    name: "dragon",
    title: "Dense: the dragon (paper: Figs. 1 and 9)",
    look: "Before, the coils at the back shine through the coils in front. Afterwards each coil hides the next.",
    query: { sample: "dragon_res2", view: "0.07,0.194,0.21" },
  }),
  await pair(studio, {
    name: "room",
    title: "From inside: a furnished room (paper: Fig. 10, several objects)",
    look: "Before, one sees through walls and furniture. Afterwards the points behind the table, the sofa and the chairs are gone.",
    query: { sample: "room", view: "-2.35,1.62,1.75", target: "-1.45,1.36,1", fov: 70 },
  }),
];

async function bunny(studio: Studio): Promise<Figure[]> {
  const cloud = bunny36k();
  if (cloud !== undefined) studio.serve("bunny-36k.ply", pointPly(cloud.positions));
  return [
    await pair(studio, {
      name: "bunny",
      title: "A closed surface: the bunny (paper: Fig. 2)",
      look: "Before, one cannot tell whether the bunny looks at the viewer or away. Afterwards one can.",
      query: cloud === undefined ? { sample: "bunny" } : { src: "bunny-36k.ply", view: "0.1,0.195,0.215" },
    }),
  ];
}

async function pair(studio: Studio, { name, title, look, query }: Pair): Promise<Figure> {
  const [before, after] = [await studio.shoot({ ...query, compare: 1 }, PANEL), await studio.shoot(query, PANEL)];
  const [total, visible] = [count(after.status["total"]), count(after.status["visible"])];
  const panels = [
    { label: `all ${total} points`, png: before.png },
    { label: `the ${visible} that can be seen from here`, png: after.png },
  ];
  const caption = `${look} ${visible} of ${total} points are visible from ${from(after)}, automatic ${radiusOf(after)}.`;
  return { name, title, caption, png: await small(await sheet(studio, panels, 2, PANEL)) };
}
