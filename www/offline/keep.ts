/// <reference types="vite/client" />

/**
 * Stores the page for offline use. Call it when the first cloud is on screen, so that nothing delays this cloud.
 * `sample`: the address of the cloud that is shown.
 */
export function keepForOffline(sample: string | null): void {
  keep(sample).catch(() => {
    // Private windows, frames and full disks do not allow it. Then the page just needs the network.
  });
}

async function keep(sample: string | null): Promise<void> {
  if (!("serviceWorker" in navigator)) return;
  const { serviceWorker } = navigator;
  if (!import.meta.env.PROD) {
    // In development, nothing is stored. A service worker of an earlier build at this address is removed, too.
    for (const registration of await serviceWorker.getRegistrations()) await registration.unregister();
    return;
  }
  // An active service worker has stored the sample itself.
  if (serviceWorker.controller) return;
  await serviceWorker.register("./service-worker.js");
  const { active } = await serviceWorker.ready;
  if (sample !== null) active?.postMessage(sample);
}
