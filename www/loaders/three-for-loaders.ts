import { BufferAttribute, BufferGeometry as Geometry } from "three";

/** What three's loaders get as "three" on this page (see build/three-for-loaders-plugin.ts): the same but for two things. */
export * from "three";

/** The loaders read numbers in f64 and round them to f32, which costs a georeferenced cloud its millimeters; here they stay. */
export class Float32BufferAttribute extends BufferAttribute {
  constructor(array: ArrayLike<number>, itemSize: number, normalized?: boolean) {
    super(new Float64Array(array), itemSize, normalized);
  }
}

/** Two loaders ask for the bounding sphere, which complains in the console about points that the page refuses in words. */
export class BufferGeometry extends Geometry {
  override computeBoundingSphere(): void {
    this.boundingSphere = null;
  }
}
