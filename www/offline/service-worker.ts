/*
 * Stores the page for offline use. With a network, the newest page always wins: only files whose names change with
 * their content are answered from the store.
 *
 *                                   with a network         without
 *   the page, files of fixed names  network                as they were when this worker was installed
 *   assets, named by their content  kept                   kept
 *   samples                         network, then kept     kept, if they have been opened
 *   anything else                   never touched, never kept: files from other places are the user's
 *
 * Each build has its own service worker with its own store. A store is complete, or it does not exist. The service
 * worker takes over when no page of the build before is open any more. So each page can still load the parts that it
 * needs.
 */
const worker = self as unknown as ServiceWorkerGlobalScope;

/** The build writes this in front of the file (build/offline-plugin.ts). The addresses are relative. */
declare const BUILD: {
  version: string;
  /** The page's own script. The text of a page with this script belongs to this build. */
  entry: string;
  assets: readonly string[];
  fixed: readonly string[];
  samples: readonly string[];
};

const here = (name: string) => new URL(name, worker.location.href).href;
const PAGE = here("./");
const STORES = `hidden-point-removal ${PAGE} `;
const STORE = STORES + BUILD.version;
const SAMPLES = `${STORES}samples`;
const assets = new Set(BUILD.assets.map(here));
const fixed = new Set(BUILD.fixed.map(here));
const samples = new Set(BUILD.samples.map(here));

worker.addEventListener("install", (event) => {
  event.waitUntil(
    install().catch(async (error: unknown) => {
      await caches.delete(STORE);
      throw error;
    }),
  );
});

worker.addEventListener("activate", (event) => {
  event.waitUntil(
    (async () => {
      const old = (await caches.keys()).filter((name) => name.startsWith(STORES) && name !== STORE && name !== SAMPLES);
      await Promise.all(old.map((name) => caches.delete(name)));
      // This also takes over the page that has installed this worker.
      await worker.clients.claim();
    })(),
  );
});

worker.addEventListener("fetch", (event) => {
  const answer = answerFor(event.request);
  if (answer) event.respondWith(answer);
});

/** A sample that a page has opened before it had a service worker. */
worker.addEventListener("message", (event) => {
  const address = event.data as unknown;
  if (typeof address !== "string" || !samples.has(address)) return;
  event.waitUntil(
    // The browser's cache may still have it. Then it need not be downloaded again.
    caches.open(SAMPLES).then((store) => store.add(new Request(address, { cache: "force-cache" }))),
  );
});

async function install(): Promise<void> {
  const store = await caches.open(STORE);
  await Promise.all([
    store.put(PAGE, await pageOfThisBuild()),
    ...[...assets].map(async (address) =>
      store.put(address, (await caches.match(address)) ?? (await received(address, "default"))),
    ),
    ...[...fixed].map(async (address) => store.put(address, await received(address, "no-cache"))),
  ]);
}

/**
 * The page's text. During a deployment it may belong to another build. Then the installation is tried again at the next
 * visit.
 */
async function pageOfThisBuild(): Promise<Response> {
  const response = await received(PAGE, "no-cache");
  const text = await response.text();
  if (!text.includes(BUILD.entry)) throw new Error("The page is of another build than its service worker.");
  // A new response is made, because a redirected one cannot be shown as a page.
  return new Response(text, { headers: response.headers });
}

async function received(address: string, cache: RequestCache): Promise<Response> {
  const response = await fetch(address, { cache });
  if (!response.ok) throw new Error(`${address}: ${response.status}`);
  return response;
}

/** `null` leaves the request to the browser. */
function answerFor(request: Request): Promise<Response> | null {
  if (request.method !== "GET" || request.headers.has("range")) return null;
  const { origin, pathname, search } = new URL(request.url);
  const address = origin + pathname;
  if (request.mode === "navigate") {
    return address === PAGE || address === here("index.html") ? networkFirst(request, STORE, PAGE) : null;
  }
  if (search !== "") return null;
  if (assets.has(address)) return kept(address, request);
  if (fixed.has(address)) return networkFirst(request, STORE, address);
  return samples.has(address) ? sample(request, address) : null;
}

async function kept(address: string, request: Request): Promise<Response> {
  return (await caches.match(address)) ?? fetch(request);
}

async function networkFirst(request: Request, store: string, address: string): Promise<Response> {
  try {
    return await fetch(request);
  } catch (error) {
    const copy = await caches.open(store).then((opened) => opened.match(address));
    if (copy) return copy;
    throw error;
  }
}

async function sample(request: Request, address: string): Promise<Response> {
  const response = await networkFirst(request, SAMPLES, address);
  // If there is no room to store it, it is still shown.
  if (response.ok) {
    const copy = response.clone();
    void caches
      .open(SAMPLES)
      .then((store) => store.put(address, copy))
      .catch(() => undefined);
  }
  return response;
}
