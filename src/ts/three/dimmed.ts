import { type BufferAttribute, BufferGeometry, Material, Points, type PointsMaterial } from "three";

import { describe, HprError } from "../base/errors.js";
import type { Order } from "./drawn-points.js";
import { isPatched } from "./map-material.js";
import { MappedPoints, type MapTexture } from "./mapped-points.js";
import { DIMMED, type FilterSettings } from "./options.js";

const dimmed = new WeakSet<Points>();
let hasSaid = false;

/** Says once that a copy of a material does not take its hook over. */
function sayHook(material: Material): void {
  const isOwn = material.onBeforeCompile !== Material.prototype.onBeforeCompile && !isPatched(material);
  if (isOwn && !hasSaid) {
    hasSaid = true;
    console.info(
      'hidden-point-removal: mode "dim" copies the points\' material without its onBeforeCompile; give dimMaterial',
    );
  }
}

/** Whether this object only draws the hidden points of another one. */
export function isDimmed(points: Points): boolean {
  return dimmed.has(points);
}

/**
 * Draws the hidden points faintly. For this, the points get a child with the same attributes and
 * the rest of the index. Rays do not hit the child.
 */
export class DimmedPoints {
  readonly #points: Points;
  readonly #child: Points;
  readonly #given: Material | undefined;
  readonly #mapped: MappedPoints;
  #copied: { from: Material; version: number } | undefined;
  #refused: { material: unknown } | undefined;
  #isShown = false;

  /** @throws HprError `option` if the material cannot be dimmed. */
  constructor(points: Points, { dimMaterial, patch }: FilterSettings) {
    this.#points = points;
    this.#given = dimMaterial;
    this.#child = new Points(new BufferGeometry(), dimMaterial ?? this.#copy());
    if (dimMaterial === undefined) sayHook(points.material as Material);
    this.#mapped = new MappedPoints(this.#child, patch!, -1);
    dimmed.add(this.#child);
    this.#child.name = "hidden points";
    this.#child.raycast = () => undefined;
    this.#child.visible = false;
  }

  /**
   * Draws the points that the order lists after the visible ones: `total` in all.
   *
   * @throws HprError `option` in the same case as `follow`.
   */
  show({ attribute, indices: { length } }: Order, total: number): void {
    this.#mapped.show(undefined);
    this.#draw(attribute, length, total - length);
  }

  /** Draws the points that a map hides. Throws as `show`. */
  showBy(texture: MapTexture, matrix?: readonly number[]): void {
    const { index, drawRange } = this.#points.geometry;
    this.#mapped.follow();
    this.#mapped.show(texture, matrix);
    this.#draw(index, drawRange.start, drawRange.count);
  }

  #draw(index: BufferAttribute | null, start: number, count: number): void {
    if (this.#refused !== undefined && this.#refused.material === this.#points.material) return;
    const { geometry } = this.#child;
    if (geometry.index !== index) geometry.setIndex(index);
    geometry.setDrawRange(start, count);
    this.#isShown = true;
    if (this.#child.parent !== this.#points) this.#points.add(this.#child);
    this.follow();
  }

  hide(): void {
    this.#isShown = this.#child.visible = false;
  }

  /**
   * Copies all changes of the points since the last frame.
   *
   * @throws HprError `option`, only once, if the material cannot be dimmed. Then hidden points are
   *   not drawn until there is an answer with another material.
   */
  follow(): void {
    const [points, child] = [this.#points, this.#child];
    const { attributes, boundingSphere = null } = (points.geometry as Partial<BufferGeometry> | undefined) ?? {};
    if (!this.#isShown || attributes === undefined) return;
    // Tile viewers hide all objects before they show some of them. They do not update the place of
    // children that they have not added themselves.
    child.visible = true;
    child.matrixWorld.copy(points.matrixWorld);
    child.layers.mask = points.layers.mask;
    child.renderOrder = points.renderOrder;
    child.frustumCulled = points.frustumCulled;
    this.#share(attributes);
    child.geometry.boundingSphere = boundingSphere;
    if (this.#given !== undefined) return;
    const material = points.material as PointsMaterial;
    if (this.#copied?.from !== material || this.#copied.version !== material.version) {
      this.#copyAgain();
      return;
    }
    const copy = child.material as PointsMaterial;
    copy.opacity = DIMMED * material.opacity;
    copy.size = material.size;
    copy.color.copy(material.color);
  }

  dispose(): void {
    this.#mapped.dispose();
    this.#child.removeFromParent();
    const { geometry, material } = this.#child;
    // Shared resources must stay on the graphics card.
    for (const name of Object.keys(geometry.attributes)) geometry.deleteAttribute(name);
    geometry.dispose();
    if (this.#given === undefined) (material as Material).dispose();
  }

  #share(attributes: BufferGeometry["attributes"]): void {
    const own = this.#child.geometry;
    for (const name in attributes) {
      if (own.attributes[name] !== attributes[name]) own.setAttribute(name, attributes[name]!);
    }
    for (const name in own.attributes) {
      if (!(name in attributes)) own.deleteAttribute(name);
    }
  }

  #copyAgain(): void {
    const { material } = this.#points;
    try {
      const copy = this.#copy();
      (this.#child.material as Material).dispose();
      this.#child.material = copy;
    } catch (error) {
      this.#refused = { material };
      this.hide();
      throw error;
    }
  }

  /** Copies the material, and makes it faint. Other hidden points are seen through such points. */
  #copy(): Material {
    const material = requireDimmable(this.#points.material);
    this.#copied = { from: material, version: material.version };
    const copy = material.clone();
    copy.transparent = true;
    copy.depthWrite = false;
    copy.opacity = DIMMED * material.opacity;
    return copy;
  }
}

/** Accepts only three's own materials for points. It is known that these use `opacity` and `size`. */
function requireDimmable(material: unknown): PointsMaterial {
  const {
    type = describe(material),
    isPointsMaterial,
    isPointsNodeMaterial,
  } = (material ?? {}) as Record<string, string | undefined>;
  if (!isPointsMaterial && !isPointsNodeMaterial) {
    throw new HprError(
      "option",
      `mode "dim" needs dimMaterial for points with ${type}, which it does not know how to dim`,
    );
  }
  return material as PointsMaterial;
}
