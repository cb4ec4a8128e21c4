import { nextFrame } from "../controls/dom.ts";
import { eased } from "../controls/ease.ts";
import { isCalm } from "../controls/motion.ts";
import type { Store } from "../settings/store.ts";

/** Milliseconds in which the line crosses the picture. */
const SWEEP = 2600;

/** Moves the line that divides the picture to a place, at once if motion is to be reduced or when `goes` says no. */
export async function sweep(store: Store, to: number, goes: () => boolean): Promise<void> {
  const from = store.current.compare ?? to;
  const begun = performance.now();
  while (goes() && !isCalm()) {
    const share = Math.min(1, (performance.now() - begun) / SWEEP);
    store.change({ compare: from + (to - from) * eased(share) });
    if (share === 1) return;
    await nextFrame();
  }
  // Whoever has put the line away does not want it back.
  if (store.current.compare !== null) store.change({ compare: to });
}
