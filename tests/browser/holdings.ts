import type { Page } from "playwright-core";

/** The objects of the page that no garbage collector frees by itself. */
export interface Holdings {
  /** WebGL objects by kind: made and not deleted. */
  webgl: Record<string, number>;
  workers: number;
  objectUrls: number;
}

type Counted = typeof globalThis & { holdings: Holdings };

/** Counts the objects that the page makes and frees. Call it before the page is opened. */
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
  /** Bytes of JavaScript objects, of the browser's objects for them, and of array buffers. */
  heap: number;
  embedder: number;
  buffers: number;
  nodes: number;
  listeners: number;
}

/** The memory and the size of the document after garbage collection. */
export async function memoryOf(page: Page): Promise<MemoryUse> {
  const session = await page.context().newCDPSession(page);
  try {
    // The second collection frees objects that only a finalizer released.
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
