// @ts-expect-error -- the projects' own JavaScript
import * as untyped from "./projects/app/answer.js";

const question = untyped as { positions: () => Float32Array; viewpoint: number[] };

/** The question of every project. */
export const points = question.positions();
export const viewpoint = question.viewpoint;
