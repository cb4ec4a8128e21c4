import type { Points } from "three";

import { DimmedPoints } from "./dimmed.js";
import { DrawnPoints } from "./drawn-points.js";
import { MappedPoints, type MapTexture, MapTextures } from "./mapped-points.js";
import type { VisibilityMap } from "../cloud/visibility-map.js";
import type { FilterSettings } from "./options.js";

/** A map, and the way from the points' space to the map's. */
interface Mapped {
  texture: MapTexture;
  matrix: readonly number[] | undefined;
}

/** Draws either all points or only the visible ones. The hidden points may be drawn, too, but dimmed. */
export class Display {
  readonly drawn: DrawnPoints;
  readonly #points: Points;
  readonly #dimmed: DimmedPoints | undefined;
  /** Undefined if no maps are asked. */
  readonly #mapped: MappedPoints | undefined;
  readonly #maps = new Map<unknown, Mapped>();
  readonly #textures: MapTextures;
  readonly #ownTextures: MapTextures | undefined;
  #camera: unknown;
  #enabled = true;
  /** The layers of the points, while they are not drawn because they wait for their first answer. */
  #layers: number | undefined;

  /**
   * `textures` are shared with other displays.
   *
   * @throws HprError `option` if the material cannot be dimmed.
   */
  constructor(points: Points, settings: FilterSettings, textures?: MapTextures) {
    const { dim, mapped, patch } = settings;
    this.#points = points;
    this.#dimmed = dim ? new DimmedPoints(points, settings) : undefined;
    this.#mapped = mapped && new MappedPoints(points, patch!);
    this.drawn = new DrawnPoints(points, dim);
    this.#ownTextures = textures === undefined ? new MapTextures() : undefined;
    this.#textures = textures ?? this.#ownTextures!;
  }

  /** While false, everything is drawn. */
  get enabled(): boolean {
    return this.#enabled;
  }

  set enabled(enabled: boolean) {
    this.#enabled = enabled;
    if (enabled) {
      this.#show();
    } else {
      this.isPending = false;
      this.showAll();
    }
  }

  /** How many points are drawn, without the dimmed ones. */
  get count(): number {
    if (this.#shownMap !== undefined) {
      return this.drawnIndices.length;
    }
    return this.#enabled ? this.drawn.visible : this.drawn.total;
  }

  /**
   * Takes up the points that a camera sees, and draws them if the camera is selected. `indices` are
   * their ascending indices among the points that `drawn` has read. With `isListed`, the indices of
   * the hidden points follow in memory already.
   *
   * @returns the number of points that are drawn as visible.
   * @throws HprError `too-large`, `option`.
   */
  answer(camera: unknown, indices: Uint32Array, isListed = false): number {
    this.drawn.setVisible(camera, indices, isListed);
    this.#maps.delete(camera);
    this.isPending = false;
    this.#show();
    return indices.length;
  }

  /** Draws what this camera sees. Called in every frame. */
  select(camera: unknown): void {
    const before = this.drawn.order;
    const isMapped = this.#maps.has(this.#camera) || this.#maps.has(camera);
    this.#camera = camera;
    this.drawn.select(camera);
    if (this.drawn.order !== before || isMapped) {
      this.#show();
    }
  }

  /** Whether maps can be drawn. Undefined until the points were drawn once. */
  get isAble(): boolean | undefined {
    return this.#mapped?.isAble;
  }

  /** Draws by a map for this camera until its next answer. `matrix`: from the points' space to the map's. */
  map(camera: unknown, map: VisibilityMap, matrix?: readonly number[]): void {
    this.#maps.set(camera, { texture: this.#textures.of(camera, map), matrix });
    this.isPending = false;
    this.#show();
  }

  /** Draws all points for this camera until its next answer. */
  setStale(camera: unknown): void {
    this.drawn.setStale(camera);
    this.#maps.delete(camera);
    this.#show();
  }

  /** Forgets the answers for this camera. */
  drop(camera: unknown): void {
    this.drawn.drop(camera);
    this.#maps.delete(camera);
    this.#textures.drop(camera);
  }

  /** The indices of the points that are drawn, without the dimmed ones. */
  get drawnIndices(): Uint32Array {
    if (this.#layers !== undefined) {
      return new Uint32Array(0);
    }
    const shown = this.#shownMap;
    return shown === undefined ? this.drawn.drawn : this.drawn.drawnBy(shown.texture.map, shown.matrix);
  }

  /** While true, nothing is drawn: the points wait for their first answer. */
  set isPending(isPending: boolean) {
    const { layers } = this.#points;
    if (isPending && this.#layers === undefined) {
      this.#layers = layers.mask;
      layers.mask = 0;
    } else if (!isPending && this.#layers !== undefined) {
      layers.mask = this.#layers;
      this.#layers = undefined;
    }
  }

  /** Copies the changes of the points since the last frame. Called in every frame. */
  follow(): void {
    this.#mapped?.follow();
    this.#dimmed?.follow();
  }

  /** Draws all points, until there is an answer or `enabled` is set to true. */
  showAll(): void {
    this.drawn.showAll();
    this.#mapped?.show(undefined);
    this.#dimmed?.hide();
  }

  /** Releases the points if they are no longer the ones that were read. */
  leaveOthers(): void {
    if (!this.drawn.isSame) {
      this.leave();
    }
  }

  /** Releases the points that were read. */
  leave(): void {
    this.isPending = false;
    this.showAll();
    this.#maps.clear();
    this.drawn.release();
  }

  dispose(): void {
    this.leave();
    this.#mapped?.dispose();
    this.#dimmed?.dispose();
    this.#ownTextures?.dispose();
  }

  get #shownMap(): Mapped | undefined {
    return this.#enabled ? this.#maps.get(this.#camera) : undefined;
  }

  #show(): void {
    if (!this.#enabled) {
      return;
    }
    const shown = this.#shownMap;
    this.#mapped?.show(shown?.texture, shown?.matrix);
    if (shown !== undefined) {
      this.drawn.showAll();
      this.#dimmed?.showBy(shown.texture, shown.matrix);
      return;
    }
    this.drawn.show();
    if (this.drawn.order === undefined) {
      this.#dimmed?.hide();
    } else {
      this.#dimmed?.show(this.drawn);
    }
  }
}
