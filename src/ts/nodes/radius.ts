import { HprError } from "../errors.js";
import type { MergeOptions } from "../merge.js";
import type { ResolvedInversion, VisibilityOptions } from "../view-options.js";
import { farthest, type Measure, meanSquare } from "./measure.js";

/** As the core chooses: R = 5·r²/s, or c = 0.07·s, with s the spacing of the points. */
const SPACINGS = 5;
const SCALE = 0.07;
/**
 * A radius is kept while it is within so many decades of what would be chosen: with the
 * error of a sample's spacing, that is a tenth.
 */
const KEPT = 0.06;

/** One radius for all nodes, which does not change with every step and every node. */
export class CommonRadius {
  readonly #view: VisibilityOptions;
  /** Of all points together; undefined until it is first known. */
  spacing: number | undefined;
  #kept = 0;

  constructor(view: VisibilityOptions) {
    this.#view = view;
  }

  /** Whether the points' spacing makes a difference. */
  get needsSpacing(): boolean {
    const { radius, exponent, inversion } = this.#view;
    if (typeof inversion === "object") {
      return "exponential" in inversion && inversion.exponential === "auto";
    }
    return exponent === undefined && typeof radius !== "number";
  }

  /**
   * What all nodes are asked with, in numbers only. While nodes come and go, a radius is
   * kept that is large enough.
   */
  choose(measures: readonly Measure[], viewpoint: readonly number[], settled: boolean): MergeOptions {
    const { radius, exponent, inversion = "spherical" } = this.#view;
    // Where no point is away from the viewpoint, any radius will do.
    const least = farthest(measures, viewpoint) || 1;
    if (typeof inversion === "object" && "exponential" in inversion) {
      const { exponential } = inversion;
      return { inversion: { exponential: exponential === "auto" ? SCALE * (this.spacing ?? 0) : exponential } };
    }
    const resolved: ResolvedInversion = inversion;
    if (typeof radius === "number") {
      return { radius, inversion: resolved };
    }
    if (resolved !== "spherical") {
      return { radius: this.#keep(least, least, settled), inversion: resolved };
    }
    if (exponent !== undefined) {
      if (exponent < 0) {
        throw new HprError("option", `exponent must be finite and at least 0, got ${exponent}`);
      }
      return { radius: least * 10 ** exponent, inversion: resolved };
    }
    const { spacing = 0 } = this;
    const chosen = spacing > 0 ? Math.max(least, (SPACINGS * meanSquare(measures, viewpoint)) / spacing) : least;
    return { radius: this.#keep(chosen, least, settled), inversion: resolved };
  }

  #keep(chosen: number, least: number, settled: boolean): number {
    const isNear = Math.abs(Math.log10(this.#kept / chosen)) <= KEPT;
    if (this.#kept < least || (settled && !isNear)) {
      this.#kept = chosen;
    }
    return this.#kept;
  }
}
