import type { ThreeElements } from "@react-three/fiber";
import { createElement, type ReactElement, type Ref, useImperativeHandle, useRef } from "react";
import type { Points } from "three";

import { useHiddenPointFilter, type UseHiddenPointFilterOptions } from "./use-hidden-point-filter.js";

/** Those of `<points>`, and how they are filtered. */
export type VisiblePointsProps = ThreeElements["points"] & {
  /** See {@link UseHiddenPointFilterOptions}. */
  filter?: UseHiddenPointFilterOptions | undefined;
};

/**
 * A `<points>` of which only what the canvas' camera sees is drawn, and hit by pointer events.
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
  // Theirs is a type of its own for what is the same object.
  useImperativeHandle(ref as Ref<unknown>, () => own.current);
  return createElement("points", { ...props, ref: own });
}
