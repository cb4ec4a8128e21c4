import { type ThreeElements, useFrame, useThree } from "@react-three/fiber";
import {
  createElement,
  type ReactElement,
  type Ref,
  type RefObject,
  useEffect,
  useImperativeHandle,
  useLayoutEffect,
  useRef,
  useState,
} from "react";
import type { Points } from "three";
import type { FilterChange } from "./three/camera-filter.js";
import { HiddenPointFilter } from "./three/filter.js";
import type { HiddenPointFilterOptions } from "./three/options.js";

/** The options of a `HiddenPointFilter`, its state and its callbacks. */
export type UseHiddenPointFilterOptions = HiddenPointFilterOptions & {
  /** While true, the same points stay drawn, even if the camera moves. Default false. */
  frozen?: boolean | undefined;
  /** While false, all points are drawn. Default true. */
  enabled?: boolean | undefined;
  /** A new answer is drawn. */
  onChange?: ((change: FilterChange) => void) | undefined;
  /** The points or a view are refused. Without this callback, the error is an unhandled rejection. */
  onError?: ((error: Error) => void) | undefined;
};

/**
 * Draws only the points of a `<points>` that the canvas' camera sees. Pointer events hit only these
 * points (see `HiddenPointFilter`). Before each frame, the hook checks whether the view is new. With
 * `frameloop="demand"`, each answer requests a frame.
 *
 * ```tsx
 * function Scan({ geometry }) {
 *   const ref = useRef<THREE.Points>(null);
 *   useHiddenPointFilter(ref, { exponent: 3 });
 *   return <points ref={ref} geometry={geometry}><pointsMaterial size={0.01} /></points>;
 * }
 * ```
 *
 * `frozen`, `enabled`, `mode`, the options of a view, `settle` and the callbacks may change at any time. When another
 * option changes, or when `ref` holds another object after a render, the filter is made again.
 *
 * @returns the filter, or null while there are no points.
 * @throws HprError the errors of `HiddenPointFilter`'s constructor. The nearest error boundary gets them.
 */
export function useHiddenPointFilter(
  ref: RefObject<Points | null>,
  options: UseHiddenPointFilterOptions = {},
): HiddenPointFilter | null {
  const { frozen = false, enabled = true, onChange, onError, ...settings } = options;
  const { mode, dimMaterial, cloud, worker, nonFinite, stale, origin, ...asked } = settings;
  const [place, view] = [JSON.stringify(origin), JSON.stringify(asked)];
  const invalidate = useThree((state) => state.invalidate);
  const [points, setPoints] = useState<Points | null>(null);
  const [filter, setFilter] = useState<HiddenPointFilter | null>(null);
  const callbacks = useRef({ onChange, onError });
  const isHeard = onError !== undefined;

  // A ref gives no notice of another object, so it is read after each render.
  useLayoutEffect(() => {
    setPoints(ref.current);
    callbacks.current = { onChange, onError };
  });

  useEffect(() => {
    if (points === null) {
      return;
    }
    const created = new HiddenPointFilter(points, settings);
    created.addEventListener("change", (change) => {
      invalidate();
      callbacks.current.onChange?.(change);
    });
    if (isHeard) {
      created.addEventListener("error", ({ error }) => callbacks.current.onError?.(error));
    }
    setFilter(created);
    return () => {
      created.dispose();
      setFilter(null);
      invalidate();
    };
  }, [points, dimMaterial, cloud, worker, nonFinite, stale, place, isHeard, invalidate]);

  // Each render may write the options as new objects. Only a change of their content counts.
  useEffect(() => {
    filter?.setOptions(asked);
    invalidate();
  }, [filter, view, invalidate]);

  useEffect(() => {
    if (filter !== null) {
      filter.mode = mode ?? "hide";
      filter.frozen = frozen;
      filter.enabled = enabled;
      invalidate();
    }
  }, [filter, frozen, enabled, mode, invalidate]);

  useFrame(({ camera }) => {
    filter?.update(camera);
  });

  return filter;
}

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

export { HprError, type HprErrorCode } from "./base/errors.js";
export type { HiddenPointFilter } from "./three/filter.js";
export type { AskedOptions, HiddenPointFilterOptions } from "./three/options.js";
export type { Inversion, RadiusRule, VisibilityOptions } from "./query/view-options.js";
export type { AnswerKind, FollowedOptions, FollowOptions } from "./follow/options.js";
