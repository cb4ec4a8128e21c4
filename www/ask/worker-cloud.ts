import type { Inversion as LibraryInversion, VisibilityOptions } from "hidden-point-removal";
import type { WorkerPointCloud } from "hidden-point-removal/worker";
import { MOST_POWER } from "../settings/limits.ts";
import type { Viewpoint } from "../settings/settings.ts";
import type { Method } from "./question.ts";

/** The cloud in its worker. It takes questions in the page's terms. */
export class WorkerCloud {
  readonly points: WorkerPointCloud;
  /** The middle of the bounding box, in the file's coordinates. */
  readonly center: Viewpoint;

  constructor(points: WorkerPointCloud, center: Viewpoint) {
    this.points = points;
    this.center = center;
  }

  async options({ radius, inversion, looks, thickness }: Method, viewpoint: Viewpoint): Promise<VisibilityOptions> {
    return {
      ...(radius === null
        ? {}
        : "rule" in radius
          ? { radius: radius.rule }
          : "length" in radius
            ? { radius: radius.length }
            : radius),
      ...(inversion === "spherical" ? {} : { inversion: await this.#inversion(inversion, viewpoint) }),
      ...(looks === 0 ? {} : { looks, thickness }),
    };
  }

  async #inversion(
    inversion: Exclude<Method["inversion"], "spherical">,
    viewpoint: Viewpoint,
  ): Promise<LibraryInversion> {
    if ("power" in inversion) {
      return { power: inversion.power === "auto" ? await this.#automaticPower(viewpoint) : inversion.power };
    }
    const { exponential } = inversion;
    return { exponential: exponential === "auto" ? "auto" : exponential * this.points.spacing };
  }

  /**
   * The γ for which pits in a surface that faces the viewer may be as deep as with the automatic radius: γ ÷ (γ − 1) =
   * 2R ÷ r at the farthest distance r.
   */
  async #automaticPower(viewpoint: Viewpoint): Promise<number> {
    const { exponent } = await this.points.autoRadius(viewpoint, "auto");
    const diameters = 2 * 10 ** exponent;
    return Math.min(MOST_POWER, diameters / (diameters - 1));
  }
}
