import type { Store } from "../settings/settings.ts";
import { bindNumbers } from "../controls/segmented.ts";

export function bindNoise(store: Store): void {
  const showDenoise = bindNumbers("denoise", (denoise) => {
    store.change({ denoise });
  });
  const showVote = bindNumbers("vote", (vote) => {
    store.change({ vote });
  });
  store.follow(({ denoise, vote }) => {
    showDenoise(denoise);
    showVote(vote);
  });
}
