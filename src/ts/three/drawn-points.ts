import { BufferAttribute, type BufferGeometry, DynamicDrawUsage, type Points } from "three";

import { allocating, describe, HprError } from "../base/errors.js";
import type { VisibilityMap } from "../cloud/visibility-map.js";
import { type PositionAttribute, readPositions, type ReadPositions, requirePositions, versionOf } from "./attribute.js";

/** The state of a geometry before it got a filter. */
interface Taken {
  geometry: BufferGeometry;
  position: PositionAttribute;
  positionVersion: number;
  index: BufferAttribute | null;
  indexVersion: number;
  start: number;
  count: number;
}

/** The visible points in the answer for one camera. */
export interface Order {
  readonly attribute: BufferAttribute;
  /** Their ascending indices among the points that were read. */
  indices: Uint32Array;
  /** One byte for each position: 1 for a visible point. Made when it is asked for. */
  mask?: Uint8Array | undefined;
}

/** The geometries that have a filter. A second filter would take the first one's index for the user's own. */
const taken = new WeakSet<BufferGeometry>();

/**
 * The points that a geometry draws. To draw fewer points, the geometry gets another index and another
 * draw range.
 *
 *      order   [ visible …… | hidden …… ]     numbers of points, in the user's own order
 *                draw range ──
 *
 * Hidden points are listed only if they are drawn, too (see `dimmed.ts`). Each camera has an order of
 * its own.
 */
export class DrawnPoints {
  readonly #points: Points;
  /** Whether orders also list the hidden points. */
  listsHidden: boolean;
  #taken: Taken | undefined;
  /** The numbers of the points that were drawn without a filter. Undefined if all were drawn, in their order. */
  #ids: Uint32Array | undefined;
  #total = 0;
  /** The mask of all points that are drawn without a filter. */
  #whole: Pick<Order, "mask"> | undefined;
  /** The order that the geometry draws. Undefined while it draws all points. */
  #shown: Order | undefined;

  constructor(points: Points, listsHidden: boolean) {
    this.#points = points;
    this.listsHidden = listsHidden;
  }

  /** How many points are drawn without a filter. */
  get total(): number {
    return this.#total;
  }

  /** The numbers of the points that are drawn. */
  get drawn(): Uint32Array {
    const order = this.#shown;
    if (order !== undefined) return (order.attribute.array as Uint32Array).slice(0, order.indices.length);
    return this.#ids?.slice() ?? Uint32Array.from({ length: this.#total }, (_, i) => i);
  }

  /** The numbers of all points, without those that a map hides. `place`: from the points' space to the map's. */
  drawnBy(map: VisibilityMap, place?: readonly number[]): Uint32Array {
    const hidden = map.hides(readPositions(this.#position, this.#ids, place).numbers);
    const numbers = this.#ids ?? Uint32Array.from(hidden, (_, i) => i);
    return numbers.filter((_, i) => hidden[i] === 0);
  }

  /**
   * Whether the point with this number is among those that the geometry draws.
   *
   * @throws HprError `option` if there is no such point.
   */
  isDrawn(index: number): boolean {
    const { count } = this.#position;
    if (!(Number.isInteger(index) && index >= 0 && index < count)) {
      throw new HprError("option", `index must be the number of one of ${count} points, got ${describe(index)}`);
    }
    if (this.#shown === undefined && this.#ids === undefined) return true;
    const order = this.#shown ?? (this.#whole ??= {});
    order.mask ??= maskOf(this.drawn, count);
    return order.mask[index] === 1;
  }

  /** Where a point is. `place`: from the points' space to another one. */
  placeOf(index: number, place?: readonly number[]): Float32Array | Float64Array {
    return readPositions(this.#position, Uint32Array.of(index), place).numbers;
  }

  get #position(): PositionAttribute {
    return this.#taken?.position ?? requirePositions(this.#points.geometry.attributes["position"]);
  }

  /** Whether the geometry still draws the points that were read last. Their positions may have changed. */
  get isSame(): boolean {
    const last = this.#taken;
    if (last === undefined || this.#points.geometry !== last.geometry) return false;
    const { index, drawRange, attributes } = last.geometry as Partial<BufferGeometry>;
    const own = this.#shown;
    return (
      attributes?.["position"] === last.position &&
      index === (own?.attribute ?? last.index) &&
      (last.index === null || last.index.version === last.indexVersion) &&
      drawRange?.start === (own === undefined ? last.start : 0) &&
      drawRange.count === (own?.indices.length ?? last.count)
    );
  }

  /** Whether no change has been announced since the points were read. */
  get isUnchanged(): boolean {
    return this.isSame && versionOf(this.#taken!.position) === this.#taken!.positionVersion;
  }

  /**
   * Reads the points as they are now, and returns their positions in their own space. If `place` is
   * given (the elements of a matrix), the positions are transformed by it. If the points are the
   * same as before, only the visible ones stay drawn.
   *
   * @throws HprError `positions-type`, `option`, `too-large`. Then nothing has been read.
   */
  take(place?: readonly number[]): ReadPositions {
    const same = this.isSame;
    if (!same) this.release();
    const { geometry } = this.#points;
    if (!same) requireUnfiltered(geometry);
    const position = requireFilterable(geometry);
    if (!same) {
      const { index, drawRange } = geometry;
      this.#ids = drawnIds(position.count, index, drawRange);
      this.#total = this.#ids?.length ?? position.count;
      const { start, count } = drawRange;
      const indexVersion = index?.version ?? 0;
      this.#taken = { geometry, position, positionVersion: 0, index, indexVersion, start, count };
      taken.add(geometry);
    }
    this.#taken!.positionVersion = versionOf(position);
    return readPositions(position, this.#ids, place);
  }

  /**
   * Writes the points that a camera sees into its order, or into a new one. `indices` are their ascending indices among
   * the points that `take` returned.
   */
  list(indices: Uint32Array, known: Order | undefined): Order {
    const order = known ?? this.#newOrder();
    const isDrawn = this.#shown === order && this.isSame;
    const { attribute } = order;
    const numbers = attribute.array as Uint32Array;
    numbers.set(indices);
    if (this.listsHidden) listHidden(numbers, indices.length);
    const [ids, end] = [this.#ids, this.listsHidden ? this.#total : indices.length];
    if (ids !== undefined) {
      for (let i = 0; i < end; i++) numbers[i] = ids[numbers[i]!]!;
    }
    order.indices = indices;
    order.mask = undefined;
    attribute.clearUpdateRanges();
    attribute.addUpdateRange(0, end);
    attribute.needsUpdate = true;
    if (isDrawn) this.#taken!.geometry.setDrawRange(0, indices.length);
    return order;
  }

  #newOrder(): Order {
    const attribute = allocating(`${this.#total} indices`, () => {
      return new BufferAttribute(new Uint32Array(this.#total), 1).setUsage(DynamicDrawUsage);
    });
    return { attribute, indices: new Uint32Array() };
  }

  /** Draws the points of this order. What the user has set since is left, and is read later. */
  show(order: Order): void {
    if (this.#shown === order || !this.isSame) return;
    this.#shown = order;
    this.#taken!.geometry.setIndex(order.attribute);
    this.#taken!.geometry.setDrawRange(0, order.indices.length);
  }

  /** Restores the index and the draw range from before the filter, except where others have changed them. */
  showAll(): void {
    const shown = this.#shown;
    if (shown === undefined) return;
    this.#shown = undefined;
    const { geometry, index, start, count } = this.#taken!;
    if (geometry.index === shown.attribute) geometry.setIndex(index);
    const range = geometry.drawRange as BufferGeometry["drawRange"] | undefined;
    if (range?.start === 0 && range.count === shown.indices.length) geometry.setDrawRange(start, count);
  }

  /** Leaves the geometry as if there had been no filter. */
  release(): void {
    this.showAll();
    if (this.#taken !== undefined) taken.delete(this.#taken.geometry);
    this.#taken = this.#ids = this.#whole = undefined;
    this.#total = 0;
  }
}

export function isFiltered(geometry: unknown): boolean {
  return taken.has(geometry as BufferGeometry);
}

/** Refuses a value that is not a geometry, and a geometry that has a filter. */
export function requireUnfiltered(geometry: unknown): asserts geometry is BufferGeometry {
  if (typeof geometry !== "object" || geometry === null || !("isBufferGeometry" in geometry)) {
    throw new HprError("option", `points: geometry must be a THREE.BufferGeometry, got ${describe(geometry)}`);
  }
  if (isFiltered(geometry)) throw new HprError("option", "points: this geometry has a HiddenPointFilter already");
}

/** Refuses geometries whose points are drawn elsewhere than at their positions. */
function requireFilterable(geometry: BufferGeometry): PositionAttribute {
  const { attributes = {}, morphAttributes = {} } = geometry as Partial<BufferGeometry>;
  if (Object.values(morphAttributes).some((list) => (list as unknown[] | undefined)?.length)) {
    throw new HprError(
      "option",
      "points: morphAttributes are not supported: only the graphics card knows where such points are",
    );
  }
  const position = requirePositions(attributes["position"]);
  const instanced = Object.keys(attributes).find(
    (name) => (attributes[name] as { isInstancedBufferAttribute?: true } | null)?.isInstancedBufferAttribute,
  );
  if ("isInstancedBufferGeometry" in geometry || instanced !== undefined) {
    const what =
      instanced === undefined ? "an InstancedBufferGeometry" : `the instanced attribute ${describe(instanced)}`;
    throw new HprError("option", `points: ${what} is not supported: an index cannot leave out single instances`);
  }
  return position;
}

/**
 * Returns the numbers of the points that an index and a draw range draw, in the order of drawing, each of them once.
 * Returns undefined if there is no index and all points are drawn.
 */
function drawnIds(
  length: number,
  index: BufferAttribute | null,
  range: { start: number; count: number },
): Uint32Array | undefined {
  requireDrawable(index, range);
  const start = Math.max(0, range.start);
  const end = Math.min(index?.count ?? length, range.start + range.count);
  const count = Math.max(0, end - start);
  if (index === null && count === length) return undefined;
  const ids = allocating(`${count} indices`, () => new Uint32Array(count));
  const known = allocating(`${length} bytes`, () => new Uint8Array(length));
  let found = 0;
  for (let i = 0; i < count; i++) {
    const id = index?.getX(start + i) ?? start + i;
    if (!(id >= 0 && id < length)) {
      throw new HprError("option", `points: index[${start + i}] is ${id}, but there are ${length} positions`);
    }
    if (known[id] === 0) ids[found++] = id;
    known[id] = 1;
  }
  return found === count ? ids : ids.slice(0, found);
}

function maskOf(indices: Uint32Array, length: number): Uint8Array {
  const mask = allocating(`${length} bytes`, () => new Uint8Array(length));
  for (const index of indices) mask[index] = 1;
  return mask;
}

/** Refuses values that three itself could not draw, although it would report no error. */
function requireDrawable(index: unknown, range: unknown): void {
  if (index !== null && typeof ((index ?? {}) as { getX?: unknown }).getX !== "function") {
    throw new HprError("option", `points: index must be a THREE.BufferAttribute or null, got ${describe(index)}`);
  }
  const { start, count } = (range ?? {}) as { start?: unknown; count?: unknown };
  for (const [name, value] of Object.entries({ start, count })) {
    if (typeof value !== "number" || Number.isNaN(value)) {
      throw new HprError("option", `points: drawRange.${name} must be a number, got ${describe(value)}`);
    }
  }
}

/** Completes `order` to a list of all indices below its length. Its first `visible` numbers are given, ascending. */
function listHidden(order: Uint32Array, visible: number): void {
  let at = visible;
  let next = 0;
  for (let i = 0; i <= visible; i++) {
    const end = i < visible ? order[i]! : order.length;
    while (next < end) order[at++] = next++;
    next++;
  }
}
