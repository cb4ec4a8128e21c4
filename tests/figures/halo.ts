// The gaps that one hull leaves around silhouettes, and the same views with three looks, for docs/LOOKS.md.
import { count, type Maker, type Panel, sheet, small } from "./figure.js";
import type { Query, Size } from "./studio.js";

const WIDE: Size = { width: 480, height: 400 };
/** Furniture before walls. */
const ROOM: Query = { sample: "room", view: "-2.35,1.62,1.75", target: "-1.45,1.36,1", fov: 70 };

export const halo: Maker = async (studio) => {
  const panels: Panel[] = [];
  for (const looks of [0, 3]) {
    const { png, status } = await studio.shoot({ ...ROOM, looks, theme: "light" }, WIDE);
    const label = looks === 0 ? "one hull" : "three looks";
    panels.push({ label: `${label}: ${count(status["visible"])} points`, png });
  }
  const sheets = await sheet(studio, panels, 2, WIDE, "light");
  return [
    {
      name: "halo",
      folder: "docs",
      title: "Gaps around silhouettes",
      caption:
        "With one hull, a band of the wall is missing around the furniture before it. Three looks show the wall up to the silhouette.",
      png: await small(sheets),
    },
  ];
};
