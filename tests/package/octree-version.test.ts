// Octrees whose files change while they are read, and servers that are slow, busy or wrong: `hidden-point-removal/stream`.
import { openAsBlob, readFileSync, utimesSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import type { Octree, OctreeOptions, OctreeStep } from "hidden-point-removal/stream";
import { afterEach, describe, expect, it, vi } from "vitest";

import { type Behavior, type Fault, serverOf, type Site } from "../fuzz/stream/server";
import { potreeOctree, town } from "./octrees";
import { root, scratchFor } from "./snippets";
import { randomNumbers, readyPackage } from "./support";

const { HprError } = await readyPackage();
const { openOctree } = await import("hidden-point-removal/stream");

const files = potreeOctree(town(1500, randomNumbers(3), 20, 2), { leaf: 150 });
const metadata = new Uint8Array(new TextEncoder().encode(JSON.stringify(files.metadata)));
const town1: Site = { "metadata.json": metadata, "hierarchy.bin": files.hierarchy, "octree.bin": files.octree };
const ball: Site = { "ball.laz": new Uint8Array(readFileSync(join(root, "tests/browser/fixtures/octree.copc.laz"))) };
const [POTREE, COPC] = ["https://example.org/town/metadata.json", "https://example.org/ball.laz"];
const AT = { [POTREE]: [5, 5, 3], [COPC]: [512_345, 5_403_222.3, 431.6] };
const exponential = { inversion: { exponential: 0.03 } } as const;

/** A good server. */
const good = (site: Site): Behavior => ({
  sites: [site, site],
  replacedAt: Infinity,
  telling: { etag: "strong", modified: true, contentRange: true },
  faults: new Map(),
  knowsIfRange: false,
});

async function last(octree: Octree, viewpoint: number[], signal?: AbortSignal): Promise<OctreeStep> {
  let step: OctreeStep | undefined;
  for await (step of octree.visibleFrom(viewpoint, { ...exponential, ...(signal && { signal }) }));
  return step!;
}

/** How a view of an octree on a server ends: `exact`, or the error. */
async function ending(address: string, behavior: Behavior, options: OctreeOptions = {}): Promise<[string, string]> {
  try {
    const octree = await openOctree(address, { fetch: serverOf(behavior).fetch, ...options });
    const { exact } = await last(octree, AT[address]!);
    return [exact ? "exact" : "not exact", ""];
  } catch (error) {
    return error instanceof HprError ? [error.code, error.message] : [(error as Error).name, String(error)];
  }
}

const sites: [string, Site][] = [[POTREE, town1], [COPC, ball]]; // prettier-ignore
const change = /the file has changed/;

afterEach(() => {
  vi.unstubAllGlobals();
});

describe.each(sites)("%s: a file that is replaced", (address, site) => {
  it("ends the view at any request, if the server tells it by a tag, a date or the length", async () => {
    const longer = Object.fromEntries(Object.entries(site).map(([name, bytes]) => [name, Uint8Array.from([...bytes, 32])]));
    const count = serverOf(good(site));
    await last(await openOctree(address, { fetch: count.fetch }), AT[address]!);
    expect(count.asked()).toBeGreaterThan(8);
    const ways: Partial<Behavior>[] = [
      {},
      { knowsIfRange: true },
      { telling: { etag: "weak", modified: false, contentRange: false } },
      { telling: { etag: "none", modified: true, contentRange: false } },
      { telling: { etag: "none", modified: false, contentRange: true }, sites: [site, longer] },
    ];
    for (const way of ways) {
      for (const at of [1, 2, 3, 4, 7, count.asked() - 1]) {
        const [code, message] = await ending(address, { ...good(site), replacedAt: at, ...way });
        expect([way, at, code, message]).toEqual([way, at, "load", expect.stringMatching(change)]);
      }
      expect(await ending(address, { ...good(site), ...way, replacedAt: 0 })).toEqual(["exact", ""]);
    }
  }); // prettier-ignore

  it("is not read any further, and is named in the error of the next view", async () => {
    const behavior = { ...good(site), replacedAt: 5 };
    const { fetch, asked } = serverOf(behavior);
    const octree = await openOctree(address, { fetch, cache: 0 });
    const views = [1, 2].map(async () => last(octree, AT[address]!));
    for (const { reason } of (await Promise.allSettled(views)) as PromiseRejectedResult[]) {
      expect(reason).toMatchObject({ code: "load", message: expect.stringMatching(change) as string });
    }
    const before = asked();
    await expect(last(octree, AT[address]!)).rejects.toThrow(change);
    expect(asked()).toBe(before);
  });

  it("is noticed by an answer 412 or 200 after the first", async () => {
    for (const fault of [{ kind: "status", status: 412 }, { kind: "whole" }] as Fault[]) {
      const [code, message] = await ending(address, { ...good(site), faults: new Map([[5, fault]]) });
      expect([code, message]).toEqual(["load", expect.stringMatching(change)]);
    }
  });
});

describe("If-Range", () => {
  const conditions = async (behavior: Behavior) => {
    const { fetch } = serverOf(behavior);
    const sent: (string | null)[] = [];
    const spy = (url: string, init?: RequestInit) => {
      const headers = new Headers(init?.headers);
      expect([...headers.keys()].filter((name) => name !== "range" && name !== "if-range")).toEqual([]);
      sent.push(headers.get("if-range"));
      return fetch(url, init);
    };
    await last(await openOctree(COPC, { fetch: spy }), AT[COPC]!);
    return sent;
  };

  it("is sent in Node and to the page's own origin, with a strong tag alone", async () => {
    const isTagged = [null, ...Array<string>(5).fill('"version-0"')];
    expect((await conditions(good(ball))).slice(0, 6)).toEqual(isTagged);
    vi.stubGlobal("location", new URL("https://example.org/page"));
    expect((await conditions(good(ball))).slice(0, 6)).toEqual(isTagged);
    const weak = { etag: "weak", modified: true, contentRange: true } as const;
    expect(new Set(await conditions({ ...good(ball), telling: weak }))).toEqual(new Set([null]));
  });

  it("is not sent to other origins: a host that allows `Range` alone still streams", async () => {
    vi.stubGlobal("location", new URL("https://other.example/page"));
    const telling = { etag: "none", modified: true, contentRange: false } as const;
    for (const told of [good(ball).telling, telling]) {
      expect(new Set(await conditions({ ...good(ball), telling: told }))).toEqual(new Set([null]));
    }
  });
});

it("a file on the device that has changed is not read any further", async () => {
  const file = join(scratchFor("stream-version"), "ball.copc.laz");
  writeFileSync(file, ball["ball.laz"]!);
  const octree = await openOctree(await openAsBlob(file));
  writeFileSync(file, ball["ball.laz"]!);
  utimesSync(file, new Date(), new Date(Date.now() + 5000));
  await expect(last(octree, AT[COPC]!)).rejects.toMatchObject({ code: "load", message: expect.stringMatching(change) as string }); // prettier-ignore
});

describe("a request", () => {
  const faults = (...list: [number, Fault][]): Behavior => ({ ...good(town1), faults: new Map(list) });
  const busy = (status: number, retryAfter?: string): Fault => ({ kind: "status", status, ...(retryAfter !== undefined && { retryAfter }) }); // prettier-ignore

  it("is repeated after 429, 5xx and a broken connection, as often as `retries` says", async () => {
    const each = faults([0, busy(503)], [2, { kind: "reset" }], [4, { kind: "cut" }], [6, busy(429, "0")], [8, busy(500)]); // prettier-ignore
    expect(await ending(POTREE, each)).toEqual(["exact", ""]);
    const down = { ...good(town1), faults: new Map(Array.from({ length: 99 }, (_, i) => [i + 3, busy(503)])) };
    const [code, message] = await ending(POTREE, down, { retries: 1 });
    expect([code, message]).toEqual([
      "load",
      expect.stringMatching(/answered 503 \(2 tries; see the option retries\)/),
    ]);
    expect((await ending(POTREE, faults([3, { kind: "reset" }]), { retries: 0 }))[1]).toMatch(/fetch failed \(1 try; /);
  });

  it("is not repeated after other answers", async () => {
    for (const status of [400, 403, 404, 410]) {
      const [code, message] = await ending(POTREE, faults([3, busy(status)]));
      expect([code, message]).toEqual(["load", expect.stringMatching(new RegExp(`answered ${status}$`))]);
    }
  });

  it("waits as long as `Retry-After` says, but not longer than a minute", async () => {
    const begun = performance.now();
    expect(await ending(POTREE, faults([0, busy(429, "1")]))).toEqual(["exact", ""]);
    expect(performance.now() - begun).toBeGreaterThan(990);
    const [code, message] = await ending(POTREE, faults([0, busy(503, "3600")]));
    expect([code, message]).toEqual(["load", expect.stringMatching(/503, and asks to wait 3600 s \(1 try/)]);
  });

  it("is given up when the view is, also while it waits for the next try or for a page", async () => {
    for (const fault of [busy(503, "30"), { kind: "silent" }] as Fault[]) {
      for (const number of [1, 4, 6]) {
        const octree = await openOctree(POTREE, { fetch: serverOf(faults([number, fault])).fetch });
        const controller = new AbortController();
        let isLate = false;
        setTimeout(() => {
          controller.abort();
          setTimeout(() => (isLate = true), 5000);
        }, 40);
        await expect(last(octree, [5, 5, 3], controller.signal)).rejects.toMatchObject({ name: "AbortError" });
        expect(isLate).toBe(false);
      }
    }
  });

  it("ends when no byte comes for `timeout` milliseconds, and not earlier", async () => {
    const [code, message] = await ending(POTREE, faults([3, { kind: "silent" }]), { timeout: 30 });
    expect([code, message]).toEqual([
      "load",
      expect.stringMatching(/no byte came for 30 ms \(see the option timeout\)/),
    ]);
    expect((await ending(POTREE, faults([3, { kind: "slow", milliseconds: 150 }]), { timeout: 2000 }))[0]).toBe(
      "exact",
    );
    // While this thread computes, the time does not count.
    const { fetch, asked } = serverOf(good(town1));
    const blocked = async (url: string, init?: RequestInit) => {
      const answer = new Promise<void>((resolve) => setTimeout(resolve, 30)).then(() => fetch(url, init));
      for (const until = performance.now() + 600; asked() === 3 && performance.now() < until;);
      return answer;
    };
    const octree = await openOctree(POTREE, { fetch: blocked, timeout: 500 });
    expect((await last(octree, [5, 5, 3])).exact).toBe(true);
  });

  it.each<[string, Fault, RegExp]>([
    ["without end", { kind: "endless" }, /more than the \d+ bytes asked for/],
    ["that is too long", { kind: "long" }, /more than the \d+ bytes asked for/],
    ["that is too short", { kind: "short" }, /of the \d+ bytes at byte \d+ came/],
    ["with another range", { kind: "shifted" }, /its server sends "bytes \d+-\d+\/\d+" instead of the bytes/],
    ["in several parts", { kind: "multipart" }, /sends ranges as multipart\/byteranges/],
    ["that is compressed", { kind: "gzip" }, /sends ranges as gzip/],
    ["416", busy(416), /server answered 416/],
  ])("is refused an answer %s", async (_, fault, message) => {
    for (const [address, site] of sites) {
      const answer = await ending(address, { ...good(site), faults: new Map([[4, fault]]) });
      expect(answer).toEqual(["load", expect.stringMatching(message)]);
    }
  });

  it("reads no more of an endless answer than was asked for", async () => {
    let sent = 0;
    const { fetch } = serverOf(good(town1));
    const endless = async (url: string, init?: RequestInit) => {
      const answer = await fetch(url, init);
      if (!url.endsWith("octree.bin")) return answer;
      const pull = (controller: ReadableStreamDefaultController<Uint8Array>) => {
        sent += 1000;
        controller.enqueue(new Uint8Array(1000));
      };
      return new Response(new ReadableStream({ pull }), { status: 206, headers: answer.headers });
    };
    const octree = await openOctree(POTREE, { fetch: endless });
    await expect(last(octree, [5, 5, 3])).rejects.toThrow(/more than the \d+ bytes/);
    expect(sent).toBeLessThan(files.octree.length);
  });

  it("has options that are checked", async () => {
    for (const options of [{ retries: -1 }, { retries: 1.5 }, { timeout: 0 }, { timeout: Infinity }]) {
      expect((await ending(POTREE, good(town1), options))[0]).toBe("option");
    }
  });
});
