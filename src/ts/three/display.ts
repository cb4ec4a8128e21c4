import type { Points } from "three";

import { DimmedPoints } from "./dimmed.js";
import { DrawnPoints, type Order } from "./drawn-points.js";
import { MappedPoints, type MapTexture, MapTextures } from "./mapped-points.js";
import type { VisibilityMap } from "../cloud/visibility-map.js";
import type { FilterSettings } from "./options.js";

/** What is drawn for a camera: a map, with the way from the points' space to its space, or an order. Otherwise all points. */
interface View {
  order?: Order;
  isStale: boolean;
  mapped?: { texture: MapTexture; matrix: readonly number[] | undefined } | undefined;
}

/** Draws either all points or only the visible ones. The hidden points may be drawn, too, but dimmed. */
export class Display {
  readonly drawn: DrawnPoints;
  readonly #points: Points;
  readonly #settings: FilterSettings;
  #dimmed: DimmedPoints | undefined;
  /** Undefined if no maps are ever asked. */
  readonly #mapped: MappedPoints | undefined;
  readonly #views = new Map<unknown, View>();
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
    const { dim, stale, inWorker, patch } = settings;
    this.#points = points;
    this.#settings = settings;
    this.#dimmed = dim ? new DimmedPoints(points, settings) : undefined;
    this.#mapped = stale === "map" && inWorker ? new MappedPoints(points, patch!) : undefined;
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

  /** Whether hidden points are drawn, but dimmed. */
  get dim(): boolean {
    return this.#dimmed !== undefined;
  }

  /** @throws HprError `option` if the material cannot be dimmed. */
  set dim(dim: boolean) {
    if (dim === this.dim) return;
    this.#dimmed?.dispose();
    this.#dimmed = dim ? new DimmedPoints(this.#points, this.#settings) : undefined;
    this.drawn.listsHidden = dim;
    for (const { order } of this.#views.values()) {
      if (order !== undefined) this.drawn.list(order.indices, order);
    }
    this.#show();
  }

  /** How many points are drawn, without the dimmed ones. */
  get count(): number {
    if (this.#shownMap !== undefined) return this.drawnIndices.length;
    return this.#order?.indices.length ?? this.drawn.total;
  }

  /**
   * Takes up the points that a camera sees, and draws them if the camera is selected. `indices` are
   * their ascending indices among the points that `drawn` has read.
   *
   * @returns the number of points that are drawn as visible.
   * @throws HprError `too-large`, `option`.
   */
  answer(camera: unknown, indices: Uint32Array): number {
    const order = this.drawn.list(indices, this.#views.get(camera)?.order);
    this.#set(camera, { order, isStale: false });
    return indices.length;
  }

  /** Draws what this camera sees. Called in every frame. */
  select(camera: unknown): void {
    const isOther = this.#camera !== camera;
    this.#camera = camera;
    // The points may have moved in the map's space.
    if (isOther || this.#view?.mapped !== undefined) this.#show();
  }

  /** Whether maps can be drawn. Undefined until the points were drawn once. */
  get isAble(): boolean | undefined {
    return this.#mapped?.isAble;
  }

  /** Draws by a map for this camera until its next answer. `matrix`: from the points' space to the map's. */
  map(camera: unknown, map: VisibilityMap, matrix?: readonly number[]): void {
    const mapped = { texture: this.#textures.of(camera, map), matrix };
    this.#set(camera, { isStale: true, ...this.#views.get(camera), mapped });
  }

  /** Draws all points for this camera until its next answer. */
  setStale(camera: unknown): void {
    Object.assign(this.#views.get(camera) ?? {}, { isStale: true, mapped: undefined });
    this.#show();
  }

  /** Forgets the answers for this camera. */
  drop(camera: unknown): void {
    this.#views.delete(camera);
    this.#textures.drop(camera);
  }

  /** Whether there was an answer for the selected camera. */
  get isAnswered(): boolean {
    return this.#views.get(this.#camera)?.isStale === false;
  }

  /** The indices of the points that are drawn, without the dimmed ones. */
  get drawnIndices(): Uint32Array {
    if (this.#layers !== undefined) return new Uint32Array(0);
    const shown = this.#shownMap;
    return shown === undefined ? this.drawn.drawn : this.drawn.drawnBy(shown.texture.map, shown.matrix);
  }

  /**
   * Whether a point is drawn, and not dimmed.
   *
   * @throws HprError `option` if there is no point with this number.
   */
  isVisible(index: number): boolean {
    const shown = this.#shownMap;
    const isDrawn = this.drawn.isDrawn(index);
    return (
      isDrawn &&
      this.#layers === undefined &&
      shown?.texture.map.hides(this.drawn.placeOf(index, shown.matrix))[0] !== 1
    );
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
    if (!this.drawn.isSame) this.leave();
  }

  /** Releases the points that were read. */
  leave(): void {
    this.isPending = false;
    this.showAll();
    this.#views.clear();
    this.drawn.release();
  }

  dispose(): void {
    this.leave();
    this.#mapped?.dispose();
    this.#dimmed?.dispose();
    this.#ownTextures?.dispose();
  }

  get #view(): View | undefined {
    return this.#enabled ? this.#views.get(this.#camera) : undefined;
  }

  get #shownMap(): View["mapped"] {
    return this.#view?.mapped;
  }

  get #order(): Order | undefined {
    return this.#view?.isStale === false ? this.#view.order : undefined;
  }

  #set(camera: unknown, view: View): void {
    this.#views.set(camera, view);
    this.isPending = false;
    this.#show();
  }

  #show(): void {
    if (!this.#enabled) return;
    const [shown, order] = [this.#shownMap, this.#order];
    this.#mapped?.show(shown?.texture, shown?.matrix);
    if (shown !== undefined) {
      this.drawn.showAll();
      this.#dimmed?.showBy(shown.texture, shown.matrix);
    } else if (order === undefined) {
      this.drawn.showAll();
      this.#dimmed?.hide();
    } else {
      this.drawn.show(order);
      this.#dimmed?.show(order, this.drawn.total);
    }
  }
}
