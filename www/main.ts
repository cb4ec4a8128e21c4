import { init } from "hidden-point-removal";
import { WorkerPointCloud } from "hidden-point-removal/worker";
import { byId } from "./controls/controls.ts";
import { loadAhead } from "./loaders/index.ts";
import { sourceOf } from "./page/sources.ts";
import { bindDrawer, bindSheet } from "./panel/drawer.ts";
import { SAMPLES } from "./samples/samples.ts";
import { readAddress } from "./settings/read-address.ts";

// The first cloud and the WebAssembly are fetched beside the part of the page that draws, which is larger than both.
const wishes = readAddress(
  location.search,
  SAMPLES.map((sample) => sample.name),
);
const first = sourceOf(wishes, location.search);
loadAhead(first.request);
// If that fails, the error is reported when a cloud needs it.
init().catch(() => undefined);
// Its worker starts meanwhile. One point keeps the worker until the cloud is there.
const keeper = WorkerPointCloud.create(new Float32Array(3), { shared: true });
keeper.catch(() => undefined);
bindSheet();
bindDrawer();

import("./page/session.ts")
  .then(({ startSession }) => startSession(wishes, first))
  .finally(() => {
    keeper.then(
      (cloud) => cloud.dispose(),
      () => undefined,
    );
  })
  .catch((error: unknown) => {
    const status = byId("status");
    status.dataset["state"] = "error";
    // While the drawer is closed, only screen readers have the status.
    for (const element of [status, byId("caption")]) {
      element.textContent = "A part of this page could not be loaded; reload the page to try again.";
    }
    throw error;
  });
