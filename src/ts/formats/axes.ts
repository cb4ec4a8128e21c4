import { FormatProblem, quoted } from "./problem.js";
import type { Axes } from "./rows.js";

/** The columns that the user has chosen for x, y and z: names, or numbers that count from 1. */
export type ChosenColumns = readonly [string, string, string];

/** The usual names of x, y and z. The best names come first. */
const CALLED = [
  ["x", "y", "z"],
  ["px", "py", "pz"],
  ["posx", "posy", "posz"],
];

/** Finds the fields x, y and z of a PLY or PCD file. */
export function axesOf(names: readonly string[], chosen?: ChosenColumns): Axes {
  if (chosen) return chosenAxes(names, chosen);
  const lower = names.map((name) => name.toLowerCase());
  for (const axes of CALLED) {
    if (!axes.every((axis) => lower.includes(axis))) continue;
    return axes.map((axis) => onlyPlace(lower, axis)) as unknown as Axes;
  }
  throw new FormatProblem(`its header names no x, y and z, but ${quoted(names.join(" "))}`);
}

/** @param names the names as they are written. If none matches, they are compared in lower case. */
export function chosenAxes(names: readonly string[], chosen: ChosenColumns): Axes {
  return chosen.map((choice) => {
    if (isNumber(choice)) {
      if (Number(choice) > names.length) throw new FormatProblem(`it has no column ${choice}, only ${names.length}`);
      return Number(choice) - 1;
    }
    if (names.includes(choice)) return onlyPlace(names, choice);
    const lower = names.map((name) => name.toLowerCase());
    if (lower.includes(choice.toLowerCase())) return onlyPlace(lower, choice.toLowerCase());
    throw new FormatProblem(`it has no column named ${quoted(choice)}, but ${quoted(names.join(" "))}`);
  }) as unknown as Axes;
}

export function isNumber(choice: string): boolean {
  return /^[1-9]\d*$/.test(choice);
}

function onlyPlace(names: readonly string[], name: string): number {
  const place = names.indexOf(name);
  if (names.includes(name, place + 1)) throw new FormatProblem(`its header names ${name} twice`);
  return place;
}

/** The direction that is up in a file's coordinates. */
export type Up = "y" | "z" | "-y";
