// Figures 12, 13 and 14 of the paper: the hull's triangles as a surface.
import { bunny36k } from "../bench/clouds.js";
import { count, type Figure, from, type Maker, PANEL, radiusOf, sheet, small } from "./figure.js";
import { pointPly } from "./ply.js";
import type { Query, Studio } from "./studio.js";

interface Subject {
  name: string;
  title: string;
  cloud: Query;
  viewpoint: string;
  /** A second view of the surface, from the side: its camera and target. The cloud and the viewpoint are in the picture. */
  aside: Query;
}

export const reconstruction: Maker = async (studio) => {
  const made = [
    await surface(studio, {
      name: "surface-dragon",
      title: "The visible surface of the dragon (paper: Figs. 12 to 14)",
      cloud: { sample: "dragon_res2" },
      viewpoint: "0.077,0.2,0.232",
      aside: { view: "-0.42,0.2,0.3", target: "0.03,0.135,0.09", fov: 30 },
    }),
  ];
  const bunny = bunny36k();
  if (bunny === undefined) return made;
  studio.serve("bunny-36k.ply", pointPly(bunny.positions));
  const another = await surface(studio, {
    name: "surface-bunny",
    title: "The visible surface of the bunny (paper: Figs. 12 to 14)",
    cloud: { src: "bunny-36k.ply" },
    viewpoint: "0.1,0.195,0.215",
    aside: { view: "-0.3,0.2,0.27", target: "0.01,0.128,0.075", fov: 40 },
  });
  return [...made, another];
};

async function surface(studio: Studio, { name, title, cloud, viewpoint, aside }: Subject): Promise<Figure> {
  const shoot = (edge: string, query: Query) => studio.shoot({ ...cloud, show: "surface", edge, ...query }, PANEL);
  const all = await shoot("all", { view: viewpoint });
  const kept = await shoot("5", { view: viewpoint });
  const [allTriangles, keptTriangles] = [all, kept].map(({ status }) => count(status["triangles"]));
  const panels = [
    { label: `all ${allTriangles} triangles of the hull`, png: all.png },
    { label: `the ${keptTriangles} with edges up to 5 spacings`, png: kept.png },
    { label: "all, from the side", png: (await shoot("all", { freeze: viewpoint, ...aside })).png },
    { label: "without long edges, from the side", png: (await shoot("5", { freeze: viewpoint, ...aside })).png },
  ];
  const caption =
    "The hull's triangles, drawn between the points at their original places. Long edges span silhouettes like webs. Without them the parts that the viewpoint " +
    "cannot see stay open, as the view from the side shows (the viewpoint is marked). " +
    `${count(kept.status["visible"])} of ${count(kept.status["total"])} points are visible from ${from(kept)}, automatic ${radiusOf(kept)}; ` +
    `${allTriangles} triangles, ${keptTriangles} without an edge longer than 5 spacings.`;
  return { name, title, caption, png: await small(await sheet(studio, panels, 2, PANEL)) };
}
