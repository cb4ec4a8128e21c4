import type { Points } from "three";
import { OBJLoader } from "three/addons/loaders/OBJLoader.js";
import type { LoadedCloud } from "../cloud.ts";
import { pointsOf } from "./geometry.ts";
import { checkPointCount } from "./limits.ts";
import { LoadProblem } from "./problem.ts";

/** OBJLoader, given the vertex lines alone: with faces it would repeat a vertex in every face and drop the ones in none. */
export function readObj(name: string, text: string): LoadedCloud {
  const vertices = text.match(/^[ \t]*v[ \t].*$/gm) ?? [];
  if (vertices.length === 0) throw new LoadProblem(`${name} holds no points: it has no vertex lines (“v x y z”).`);
  checkPointCount(name, vertices.length);
  const short = vertices.find((line) => line.trim().split(/\s+/).length < 4);
  if (short !== undefined) throw new LoadProblem(`${name} is broken: a vertex line has fewer than three numbers (“${short.trim().slice(0, 40)}”).`);
  const points = new OBJLoader().parse(vertices.join("\n")).children[0] as Points;
  return pointsOf(points.geometry, "double");
}
