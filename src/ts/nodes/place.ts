import { Matrix4, type Object3D } from "three";

/**
 * The place of an object in the space of another object above it. It is not computed through world
 * coordinates: their rounding would separate points that are equal in two nodes.
 */
export class Place {
  readonly object: Object3D;
  readonly matrix = new Matrix4();
  /** Grows when the object or one of its parents moves. */
  version = 0;
  frame = -1;
  parent: Object3D | null = null;
  above: Place | undefined;
  aboveVersion = 0;
  readonly #local = new Matrix4();
  /** The parts that the object's matrix was made of: position, quaternion, scale. */
  readonly #made = new Float64Array(10).fill(NaN);

  constructor(object: Object3D) {
    this.object = object;
  }

  /** Whether the object has moved in its parent since the last call. */
  isMoved(): boolean {
    const { object } = this;
    if (object.matrixAutoUpdate) {
      if (this.#isMadeOfTheSame()) {
        return false;
      }
      object.updateMatrix();
    } else {
      this.#made[0] = NaN;
    }
    if (object.matrix.equals(this.#local)) {
      return false;
    }
    this.#local.copy(object.matrix);
    return true;
  }

  place(): void {
    this.matrix.copy(this.#local);
    if (this.above !== undefined) this.matrix.premultiply(this.above.matrix);
  }

  /**
   * Whether the object's matrix would be composed of the same parts as before. Composing a matrix
   * takes longer than all other work of a frame.
   */
  #isMadeOfTheSame(): boolean {
    const { position, quaternion, scale } = this.object;
    // Older versions of three have no pivot.
    const { pivot = null } = this.object as { pivot?: unknown };
    const made = this.#made;
    const isSame =
      position.x === made[0] &&
      position.y === made[1] &&
      position.z === made[2] &&
      quaternion.x === made[3] &&
      quaternion.y === made[4] &&
      quaternion.z === made[5] &&
      quaternion.w === made[6] &&
      scale.x === made[7] &&
      scale.y === made[8] &&
      scale.z === made[9];
    if (!isSame) {
      position.toArray(made);
      quaternion.toArray(made, 3);
      scale.toArray(made, 7);
    }
    return isSame && pivot === null;
  }
}

/** The places of objects. Each object is checked once a frame, even if many nodes are below it. */
export class Places {
  readonly #root: Object3D;
  readonly #known = new WeakMap<Object3D, Place>();
  #frame = 0;

  constructor(root: Object3D) {
    this.#root = root;
  }

  /** Begins another frame: objects may have moved. */
  next(): void {
    this.#frame += 1;
  }

  of(object: Object3D): Place {
    let place = this.#known.get(object);
    if (place === undefined) {
      place = new Place(object);
      this.#known.set(object, place);
    }
    return place;
  }

  /** The present version of a place. */
  versionOf(place: Place): number {
    const { object } = place;
    if (place.frame === this.#frame || object === this.#root) {
      return place.version;
    }
    place.frame = this.#frame;
    const isElsewhere = place.parent !== object.parent;
    if (isElsewhere) {
      place.parent = object.parent;
      const holder = this.#holderOf(object);
      place.above = holder === undefined ? undefined : this.of(holder);
    }
    const aboveVersion = place.above === undefined ? 0 : this.versionOf(place.above);
    const isMoved = place.isMoved();
    if (isElsewhere || isMoved || aboveVersion !== place.aboveVersion) {
      place.aboveVersion = aboveVersion;
      place.version += 1;
      place.place();
    }
    return place.version;
  }

  /**
   * Returns the object that the matrix of `object` is relative to. Returns undefined if this is the
   * root. In the octrees of potree-core, nodes are children of nodes, but each node is drawn
   * relative to the octree.
   */
  #holderOf(object: Object3D): Object3D | undefined {
    for (let at = object.parent; at !== null; at = at.parent) {
      if ("pcoGeometry" in at) {
        return at === this.#root ? undefined : at;
      }
      if (at === this.#root) {
        break;
      }
    }
    return object.parent === null || object.parent === this.#root ? undefined : object.parent;
  }
}
