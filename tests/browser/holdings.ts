import type { Page } from "playwright-core";

/** What the page holds at the moment that no garbage collector takes back by itself. */
export interface Holdings {
  /** Of WebGL, by kind: made and not deleted. */
  webgl: Record<string, number>;
  workers: number;
  objectUrls: number;
}

type Counted = typeof globalThis & { holdings: Holdings };

/** Counts what the page makes and gives back; to be called before it is opened. */
export async function countHoldings(page: Page): Promise<void> {
  await page.addInitScript(() => {
    const holdings: Holdings = { webgl: {}, workers: 0, objectUrls: 0 };
    (globalThis as Counted).holdings = holdings;
    const wrap = (owner: object, name: string, then: () => void) => {
      const methods = owner as Record<string, (...args: unknown[]) => unknown>;
      const original = methods[name]!;
      methods[name] = function (...args: unknown[]) {
        const result = original.apply(this, args);
        then();
        return result;
      };
    };
    for (const kind of ["Buffer", "Texture", "Program", "Shader", "Framebuffer", "Renderbuffer", "VertexArray"]) {
      holdings.webgl[kind] = 0;
      wrap(WebGL2RenderingContext.prototype, `create${kind}`, () => {
        holdings.webgl[kind]! += 1;
      });
      wrap(WebGL2RenderingContext.prototype, `delete${kind}`, () => {
        holdings.webgl[kind]! -= 1;
      });
    }
    wrap(URL, "createObjectURL", () => {
      holdings.objectUrls += 1;
    });
    wrap(URL, "revokeObjectURL", () => {
      holdings.objectUrls -= 1;
    });
    wrap(Worker.prototype, "terminate", () => {
      holdings.workers -= 1;
    });
    globalThis.Worker = class extends Worker {
      constructor(...args: ConstructorParameters<typeof Worker>) {
        super(...args);
        holdings.workers += 1;
      }
    };
  });
}

export function holdingsOf(page: Page): Promise<Holdings> {
  return page.evaluate(() => (globalThis as Counted).holdings);
}

export interface MemoryUse {
  /** Bytes of JavaScript objects, of the browser's own for them, and of array buffers. */
  heap: number;
  embedder: number;
  buffers: number;
  nodes: number;
  listeners: number;
}

/** What is left of memory and document once all garbage is gone. */
export async function memoryOf(page: Page): Promise<MemoryUse> {
  const session = await page.context().newCDPSession(page);
  try {
    // What only a finalizer lets go of is gone with the second.
    await session.send("HeapProfiler.collectGarbage");
    await session.send("HeapProfiler.collectGarbage");
    const heap = (await session.send("Runtime.getHeapUsage")) as {
      usedSize: number;
      embedderHeapUsedSize: number;
      backingStorageSize: number;
    };
    const { nodes, jsEventListeners } = await session.send("Memory.getDOMCounters");
    return {
      heap: heap.usedSize,
      embedder: heap.embedderHeapUsedSize,
      buffers: heap.backingStorageSize,
      nodes,
      listeners: jsEventListeners,
    };
  } finally {
    await session.detach();
  }
}
