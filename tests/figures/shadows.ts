// Figures 15 and 16 of the paper: shadows by hidden-point removal from the lights, beside
// exact shadows. Also soft lights and several lights.
import { PointCloud, ringOfViewpoints } from "hidden-point-removal";

import type { Point } from "../bench/measure.js";
import { bounds } from "../bench/views.js";
import { dragonMesh, RayTracer } from "../fidelity/rays.js";
import { errorsOf } from "../fidelity/score.js";
import { soften } from "../fidelity/soften.js";
import { count, type Figure, type Maker, PANEL, sheet, small } from "./figure.js";
import { pointPly } from "./ply.js";
import type { Studio } from "./studio.js";

const DRAGON = "dragon_res2";
const VIEWPOINT: Point = [0.077, 0.2, 0.232];
const LEFT: Point = [-0.17, 0.36, 0.14];
const RIGHT: Point = [0.24, 0.3, 0.12];
const AMBIENT = 0.3;
const SMOOTHING = 2;
/** The number of points on the rim of a soft light, as on the page. */
const RIM = 8;
/** The shade of gray of fully lit points. */
const LIT = 0.92;

interface Lighting {
  name: string;
  title: string;
  look: string;
  lights: Point[];
  soft: number;
}

const LIGHTINGS: Lighting[] = [
  {
    name: "shadows",
    title: "Shadows of one light (paper: Figs. 15 and 16)",
    look:
      "The shadow of the head on the neck and the shadows between the coils are in the right places. The operator's shadows are a little larger and more ragged. " +
      "The specks on the right are rays that start in a dent of the mesh.",
    lights: [LEFT],
    soft: 0,
  },
  {
    name: "shadows-soft",
    title: "A large light",
    look: "The same light as a disc: its middle and eight points on its rim. Shadows fade towards their edges.",
    lights: [LEFT],
    soft: 0.12,
  },
  {
    name: "shadows-two",
    title: "Two lights",
    look: "Shadows are half dark where one of the lights does not reach, and dark where neither does.",
    lights: [LEFT, RIGHT],
    soft: 0,
  },
];

export const shadows: Maker = async (studio) => {
  const scene = new Scene();
  studio.serve("lit.ply", pointPly(scene.positions, new Float32Array(scene.cloud.length).fill(LIT)));
  const made: Figure[] = [];
  for (const lighting of LIGHTINGS) made.push(await compare(studio, scene, lighting));
  scene.cloud.dispose();
  return made;
};

async function compare(studio: Studio, scene: Scene, { name, title, look, lights, soft }: Lighting): Promise<Figure> {
  const all = lights.flatMap((light) => [light, ...(soft > 0 ? scene.rim(light, soft) : [])]);
  const exact = scene.exact(all);
  studio.serve(
    "exact.ply",
    pointPly(
      scene.positions,
      exact.brightness.map((x) => LIT * x),
    ),
  );
  const query = { show: "surface", view: VIEWPOINT.join(","), light: lights.map((light) => light.join(",")) };
  // With only ambient light the page shows the file's own shades.
  const panels = [
    {
      label: "by hidden-point removal",
      png: (await studio.shoot({ ...query, src: "lit.ply", soft, ambient: AMBIENT, smoothing: SMOOTHING }, PANEL)).png,
    },
    {
      label: "by rays against the mesh",
      png: (await studio.shoot({ ...query, src: "exact.ply", ambient: 1 }, PANEL)).png,
    },
  ];
  const places = lights.map((light) => `(${light.join(", ")})`).join(" and ");
  const caption =
    `${look} ${count(scene.cloud.length)} vertices of the dragon, light at ${places}, ambient ${AMBIENT}, ${SMOOTHING} rounds of smoothing on ` +
    `both sides, seen from (${VIEWPOINT.join(", ")}). Before smoothing, ${exact.differing.toFixed(1)} % of all vertices are lit differently from ` +
    `what rays say${all.length > 1 ? ` (mean over ${all.length} light points)` : ""}: ${exact.dark.toFixed(1)} % should be lit and are dark, ` +
    `${exact.bright.toFixed(1)} % should be dark and are lit.`;
  return { name, title, caption, png: await small(await sheet(studio, panels, 2, PANEL)) };
}

class Scene {
  readonly cloud: PointCloud;
  readonly positions: Float32Array;
  readonly #tracer: RayTracer;
  /** The mesh that the page shows and spreads the light over. */
  readonly #surface: Uint32Array;

  constructor() {
    const mesh = dragonMesh(DRAGON);
    this.positions = mesh.positions;
    this.#tracer = new RayTracer(mesh);
    this.cloud = new PointCloud(mesh.positions);
    this.#surface = this.cloud.reconstruct(VIEWPOINT).triangles;
  }

  /** The rim of a light. Its radius is `soft` times the light's distance from the middle, as on the page. */
  rim(light: Point, soft: number): Point[] {
    const { center } = bounds({ positions: this.positions });
    return ringOfViewpoints(light, center, { count: RIM, fraction: soft }) as Point[];
  }

  /**
   * The brightness by rays, softened as the library softens its shadows. Also the errors of the library's light before
   * softening.
   */
  exact(lights: Point[]) {
    const reached = new Float32Array(this.cloud.length);
    const errors = lights.map((light) => {
      const seen = this.#tracer.visibleFrom(light);
      seen.forEach((one, i) => (reached[i]! += one));
      return errorsOf(this.cloud.visibleFrom(light).mask(), seen);
    });
    const mean = (key: "total" | "falseNegatives" | "falsePositives") =>
      errors.reduce((sum, error) => sum + error[key], 0) / errors.length;
    const brightness = reached.map((lit) => AMBIENT + ((1 - AMBIENT) * lit) / lights.length);
    return {
      brightness: soften(brightness, this.#surface, SMOOTHING),
      differing: mean("total"),
      dark: mean("falseNegatives"),
      bright: mean("falsePositives"),
    };
  }
}
