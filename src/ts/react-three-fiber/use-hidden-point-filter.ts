import { useFrame, useThree } from "@react-three/fiber";
import { type RefObject, useEffect, useLayoutEffect, useRef, useState } from "react";
import type { Points } from "three";

import type { AnswerKind } from "../follow/options.js";
import { HiddenPointFilter } from "../three/filter.js";
import type { HiddenPointFilterOptions } from "../three/options.js";

/** The options of a `HiddenPointFilter`, its state and its callbacks. */
export interface UseHiddenPointFilterOptions extends HiddenPointFilterOptions {
  /** While true, the same points stay drawn, even if the camera moves. Default false. */
  frozen?: boolean | undefined;
  /** While false, all points are drawn. Default true. */
  enabled?: boolean | undefined;
  /**
   * A new answer is drawn. `count` is the number of visible points. `milliseconds` is the time that it
   * took. `answer` says what it is: a map comes before the exact answer.
   */
  onChange?: ((change: { count: number; milliseconds: number; answer: AnswerKind }) => void) | undefined;
  /** The points or a view are refused. Without this callback, the error is an unhandled rejection. */
  onError?: ((error: Error) => void) | undefined;
}

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
 * The filter is made again when one of the options changes, except `frozen`, `enabled` and the
 * callbacks. It is also made again when `ref` holds another object after a render.
 *
 * @returns the filter, or null while there are no points.
 * @throws HprError the errors of `HiddenPointFilter`'s constructor. The nearest error boundary gets them.
 */
export function useHiddenPointFilter(
  ref: RefObject<Points | null>,
  options: UseHiddenPointFilterOptions = {},
): HiddenPointFilter | null {
  const { frozen = false, enabled = true, onChange, onError, ...settings } = options;
  const { dimMaterial, inversion, ...plain } = settings;
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
    created.addEventListener("change", ({ count, milliseconds, answer }) => {
      invalidate();
      callbacks.current.onChange?.({ count, milliseconds, answer });
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
    // Each render may write the options as new objects. Only a change of their content counts.
  }, [points, dimMaterial, JSON.stringify(inversion), JSON.stringify(plain), isHeard, invalidate]);

  useEffect(() => {
    if (filter !== null) {
      filter.frozen = frozen;
      filter.enabled = enabled;
      // The next frame asks with the new options.
      invalidate();
    }
  }, [filter, frozen, enabled, invalidate]);

  useFrame(({ camera }) => {
    filter?.update(camera);
  });

  return filter;
}
