import { Matrix4, type Object3D } from "three";

/**
 * Where an object is in the space of another one above it. Not by way of the world, whose
 * rounding would move points apart that are equal in two nodes.
 */
export interface Place {
  readonly object: Object3D;
  readonly matrix: Matrix4;
  /** Grows when the object moves, or whatever it is in. */
  version: number;
  frame: number;
  readonly local: Matrix4;
  parent: Object3D | null;
  above: Place | undefined;
  aboveVersion: number;
}

/** The places of objects, each looked at once a frame, however many are in it. */
export class Places {
  readonly #root: Object3D;
  readonly #known = new WeakMap<Object3D, Place>();
  #frame = 0;

  constructor(root: Object3D) {
    this.#root = root;
  }

  /** Another frame: things may have moved. */
  next(): void {
    this.#frame += 1;
  }

  of(object: Object3D): Place {
    let place = this.#known.get(object);
    if (place === undefined) {
      const above = { parent: null, above: undefined, aboveVersion: 0 };
      place = { object, matrix: new Matrix4(), local: new Matrix4(), version: 0, frame: -1, ...above };
      this.#known.set(object, place);
    }
    return place;
  }

  /** What its version is now. */
  versionOf(place: Place): number {
    if (place.frame === this.#frame || place.object === this.#root) {
      return place.version;
    }
    place.frame = this.#frame;
    const { object, local } = place;
    const isMoved = place.parent !== object.parent;
    if (isMoved) {
      place.parent = object.parent;
      place.above = object.parent === null || object.parent === this.#root ? undefined : this.of(object.parent);
    }
    const { above } = place;
    const aboveVersion = above === undefined ? 0 : this.versionOf(above);
    if (object.matrixAutoUpdate) {
      object.updateMatrix();
    }
    if (isMoved || aboveVersion !== place.aboveVersion || !object.matrix.equals(local)) {
      place.aboveVersion = aboveVersion;
      place.version += 1;
      local.copy(object.matrix);
      place.matrix.copy(local);
      if (above !== undefined) place.matrix.premultiply(above.matrix);
    }
    return place.version;
  }
}
