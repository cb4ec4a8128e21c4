import type { Inversion as LibraryInversion, VisibilityOptions } from "hidden-point-removal";
import type { WorkerPointCloud } from "hidden-point-removal/worker";
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

  options({ radius, inversion, looks, thickness }: Method): VisibilityOptions {
    return {
      ...(radius === null
        ? {}
        : "rule" in radius
          ? { radius: radius.rule }
          : "length" in radius
            ? { radius: radius.length }
            : radius),
      ...(inversion === "spherical" ? {} : { inversion: this.#inversion(inversion) }),
      ...(looks === 0 ? {} : { looks, thickness }),
    };
  }

  #inversion({ exponential }: Exclude<Method["inversion"], "spherical">): LibraryInversion {
    return { exponential: exponential === "auto" ? "auto" : exponential * this.points.spacing };
  }
}
