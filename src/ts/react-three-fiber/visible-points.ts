import type { ThreeElements } from "@react-three/fiber";
import { createElement, type ReactElement, type Ref, useImperativeHandle, useRef } from "react";
import type { Points } from "three";

import { useHiddenPointFilter, type UseHiddenPointFilterOptions } from "./use-hidden-point-filter.js";

/** The properties of `<points>`, and the options of the filter. */
export type VisiblePointsProps = ThreeElements["points"] & {
  /** See {@link UseHiddenPointFilterOptions}. */
  filter?: UseHiddenPointFilterOptions | undefined;
};

/**
 * A `<points>` that draws only the points that the canvas' camera sees. Pointer events do not hit
 * the other points.
 *
 * ```tsx
 * <VisiblePoints geometry={geometry} filter={{ exponent: 3, mode: "dim" }}>
 *   <pointsMaterial size={0.01} />
 * </VisiblePoints>
 * ```
 */
export function VisiblePoints({ filter, ref, ...props }: VisiblePointsProps): ReactElement {
  const own = useRef<Points>(null);
  useHiddenPointFilter(own, filter);
  // React Three Fiber has its own type for the same object.
  useImperativeHandle(ref as Ref<unknown>, () => own.current);
  return createElement("points", { ...props, ref: own });
}
