/// <reference types="vite/client" />

/**
 * Has the page kept for when there is no network, once it shows its first cloud: nothing is loaded before that. `sample`:
 * the address of the one that is shown.
 */
export function keepForOffline(sample: string | null): void {
  keep(sample).catch(() => {
    // Private windows, frames and full disks: the page just needs the network then.
  });
}

async function keep(sample: string | null): Promise<void> {
  if (!("serviceWorker" in navigator)) return;
  const { serviceWorker } = navigator;
  if (!import.meta.env.PROD) {
    // While the page is being worked on nothing is kept, nor by a build that was served here before.
    for (const registration of await serviceWorker.getRegistrations()) await registration.unregister();
    return;
  }
  // A worker that is in charge has seen the sample itself.
  if (serviceWorker.controller) return;
  await serviceWorker.register("./service-worker.js");
  const { active } = await serviceWorker.ready;
  if (sample !== null) active?.postMessage(sample);
}
