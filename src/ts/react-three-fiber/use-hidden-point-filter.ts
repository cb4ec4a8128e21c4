import { useFrame, useThree } from "@react-three/fiber";
import { type RefObject, useEffect, useLayoutEffect, useRef, useState } from "react";
import type { Points } from "three";

import { HiddenPointFilter } from "../three/filter.js";
import type { HiddenPointFilterOptions } from "../three/options.js";

/** The options of a `HiddenPointFilter`, and what else it can be told and tells. */
export interface UseHiddenPointFilterOptions extends HiddenPointFilterOptions {
  /** While true, what is drawn stays, wherever the camera goes. Default false. */
  frozen?: boolean | undefined;
  /** While false, all points are drawn. Default true. */
  enabled?: boolean | undefined;
  /** Another answer is drawn: how many points are visible, and how long it took to get. */
  onChange?: ((change: { count: number; milliseconds: number }) => void) | undefined;
  /** What the points or a view are refused for. Without it, that is an unhandled rejection. */
  onError?: ((error: Error) => void) | undefined;
}

/**
 * Draws only those points of a `<points>` that the canvas' camera sees, and lets pointer
 * events hit no others; see `HiddenPointFilter`. Asks before each frame whether the view
 * is a new one. With `frameloop="demand"`, a frame is requested for every answer.
 *
 * ```tsx
 * function Scan({ geometry }) {
 *   const ref = useRef<THREE.Points>(null);
 *   useHiddenPointFilter(ref, { exponent: 3 });
 *   return <points ref={ref} geometry={geometry}><pointsMaterial size={0.01} /></points>;
 * }
 * ```
 *
 * The filter is made anew when one of the options changes (`frozen`, `enabled` and the
 * callbacks are not among them) or the object that `ref` holds after a render.
 *
 * @returns the filter; null as long as there are no points.
 * @throws HprError as the constructor of `HiddenPointFilter`, to the nearest error boundary.
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

  // The ref has no way to say that it holds something else.
  useLayoutEffect(() => {
    setPoints(ref.current);
    callbacks.current = { onChange, onError };
  });

  useEffect(() => {
    if (points === null) {
      return;
    }
    const created = new HiddenPointFilter(points, settings);
    created.addEventListener("change", ({ count, milliseconds }) => {
      invalidate();
      callbacks.current.onChange?.({ count, milliseconds });
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
    // Options that are written anew in every render are the same ones if they say the same.
  }, [points, dimMaterial, JSON.stringify(inversion), JSON.stringify(plain), isHeard, invalidate]);

  useEffect(() => {
    if (filter !== null) {
      filter.frozen = frozen;
      filter.enabled = enabled;
      // What is wanted now is asked for in the next frame.
      invalidate();
    }
  }, [filter, frozen, enabled, invalidate]);

  useFrame(({ camera }) => {
    filter?.update(camera);
  });

  return filter;
}
