import type { Up } from "../cloud/cloud.ts";
import type { HiddenMode, Store } from "../settings/settings.ts";
import { Segmented } from "../controls/segmented.ts";
import { Slider } from "../controls/slider.ts";

/** What changes the picture and nothing that is found: hidden points, their size, the lens, which way is up. */
export function bindLook(store: Store): void {
  const hidden = new Segmented<HiddenMode>("hidden-points", (value) => {
    store.change({ hidden: value });
  });
  const size = new Slider(
    "point-size",
    (value) => `${Number(value.toFixed(1))} ×`,
    (value) => {
      store.change({ size: value });
    },
  );
  const lens = new Slider(
    "field-of-view",
    (value) => `${Math.round(value)}°`,
    (fieldOfView) => {
      store.change({ fieldOfView });
    },
  );
  const upward = new Segmented<Up>("up-axis", (up) => {
    store.change({ up, freeze: null });
  });
  store.follow((now) => {
    hidden.value = now.hidden;
    size.value = now.size;
    lens.value = now.fieldOfView;
    upward.value = now.up;
  });
}
