import { byId } from "../controls/dom.ts";
import type { Store } from "../settings/store.ts";

/** The small signs over the picture: an answer is still to come, the viewpoint is frozen, this color means hidden. */
export class Signs {
  readonly #work = byId("sign-work");

  constructor(store: Store) {
    const frozen = byId("sign-frozen");
    const hidden = byId("sign-hidden");
    store.follow(({ freeze, hidden: mode, compare }) => {
      const isFrozen = freeze !== null;
      frozen.hidden = !isFrozen;
      // Beside a comparison, hidden points have no color of their own.
      hidden.hidden = mode === "off" || compare !== null;
      hidden.dataset["dimmed"] = String(mode === "dimmed");
      hidden.lastElementChild!.textContent = isFrozen ? "Hidden from that viewpoint" : "Hidden from here";
    });
  }

  busy(busy: boolean): void {
    this.#work.hidden = !busy;
  }
}
