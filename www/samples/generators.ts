import type { LoadedCloud } from "../cloud/cloud.ts";
import type { Generator } from "./generator.ts";

/*
 * The generators of samples. Each is downloaded when it is needed. Only workers import this file. In the page's own
 * script, each import would add Vite's code for loading ahead.
 */
const GENERATORS = {
  room: () => import("./living-room.ts"),
  street: () => import("./street.ts"),
  tile: () => import("./tile.ts"),
} satisfies Record<string, () => Promise<Generator>>;

export type GeneratorName = keyof typeof GENERATORS;

export async function makeSample(name: GeneratorName): Promise<LoadedCloud> {
  return (await GENERATORS[name]()).make();
}

export function generatorOf(name: GeneratorName): Promise<Generator> {
  return GENERATORS[name]();
}
