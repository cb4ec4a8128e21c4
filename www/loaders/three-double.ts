import { BufferAttribute } from "three";

/**
 * What PCDLoader, XYZLoader and OBJLoader get as "three" (see vite.config.ts): they read numbers in f64 and then round
 * them to f32, which costs a georeferenced cloud its millimeters. Here the same name keeps f64.
 */
export * from "three";

export class Float32BufferAttribute extends BufferAttribute {
  constructor(array: ArrayLike<number>, itemSize: number, normalized?: boolean) {
    super(new Float64Array(array), itemSize, normalized);
  }
}
