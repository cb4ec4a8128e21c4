import { init } from "hidden-point-removal";
import { WorkerPointCloud } from "hidden-point-removal/worker";
import { byId, remember } from "./controls/controls.ts";
import { loadAhead } from "./loaders/index.ts";
import { sourceOf } from "./page/sources.ts";
import { SAMPLES } from "./samples/samples.ts";
import { readAddress } from "./settings/address.ts";

// The first cloud and the WebAssembly are fetched beside the part of the page that draws, which is larger than both.
const asked = readAddress(
  location.search,
  SAMPLES.map((sample) => sample.name),
);
const first = sourceOf(asked, location.search);
loadAhead(first.request);
// If that fails, the error is reported when a cloud needs it.
init().catch(() => undefined);
// Its worker starts meanwhile. One point keeps the worker until the cloud is there.
const keeper = WorkerPointCloud.create(new Float32Array(3), { shared: true });
keeper.catch(() => undefined);
bindSheet();
bindDrawer();

import("./page/session.ts")
  .then(({ startSession }) => startSession(asked, first))
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

/**
 * The drawer with all controls. Until it is opened, the page is the picture with a caption and three verbs. The script in
 * the head of index.html opens it where this device remembers that it was open.
 */
function bindDrawer(): void {
  const button = byId("drawer");
  const { dataset } = document.documentElement;
  const show = () => {
    const open = dataset["tools"] === "open";
    button.setAttribute("aria-expanded", String(open));
    button.textContent = open ? "Close tools" : "Tools";
  };
  show();
  button.addEventListener("click", () => {
    dataset["tools"] = dataset["tools"] === "open" ? "closed" : "open";
    remember("tools", dataset["tools"]);
    show();
  });
}

/** On a phone the panel is a bar; this button opens the rest of it. */
function bindSheet(): void {
  const toggle = byId("sheet-toggle", HTMLButtonElement);
  const panel = byId("panel");
  toggle.addEventListener("click", () => {
    const open = panel.classList.toggle("open");
    toggle.setAttribute("aria-expanded", String(open));
    toggle.textContent = open ? "Fewer controls" : "More controls";
  });
}
