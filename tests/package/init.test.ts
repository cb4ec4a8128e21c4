import { createServer, type Server } from "node:http";
import type { AddressInfo } from "node:net";
import { pathToFileURL } from "node:url";
import { afterAll, beforeAll, describe, expect, it } from "vitest";

import { bumpySphere, freshPackage, problemOf, wasmBytes, wasmPath } from "./support";

const farAway = [0, 0, 5];

let server: Server;
let address: string;
let requests = 0;

beforeAll(async () => {
  server = createServer((request, response) => {
    requests++;
    const answers: Record<string, [status: number, type: string, body: string | Uint8Array]> = {
      "/hpr.wasm": [200, "application/wasm", wasmBytes()],
      "/untyped.wasm": [200, "application/octet-stream", wasmBytes()],
      "/page.wasm": [200, "text/html", "<!doctype html><title>Not what you wanted</title>"],
    };
    const [status, type, body] = answers[request.url ?? ""] ?? [404, "text/plain", "nothing here"];
    response.writeHead(status, { "Content-Type": type }).end(body);
  });
  await new Promise<void>((listening) => server.listen(0, "127.0.0.1", listening));
  address = `http://127.0.0.1:${(server.address() as AddressInfo).port}`;
});
afterAll(() => {
  server.close();
});

/** The package works after this call of init() or initSync(). */
function expectToWork(fresh: Awaited<ReturnType<typeof freshPackage>>) {
  const visible = fresh.hiddenPointRemoval(bumpySphere(1, 200), farAway);
  expect(visible.count).toBeGreaterThan(10);
}

describe("init", () => {
  const sharedBytes = () => {
    const bytes = new Uint8Array(new SharedArrayBuffer(wasmBytes().length + 8), 8);
    bytes.set(wasmBytes());
    return bytes;
  };
  const inputs: [name: string, input: () => unknown][] = [
    ["nothing: the package's own file", () => undefined],
    ["a path", () => wasmPath],
    ["a file: URL", () => pathToFileURL(wasmPath)],
    ["a file: URL as a string", () => pathToFileURL(wasmPath).href],
    ["an http: URL", () => new URL("/hpr.wasm", address)],
    ["an http: URL as a string", () => `${address}/hpr.wasm`],
    ["a URL that is served with another type", () => `${address}/untyped.wasm`],
    ["a Response", () => fetch(`${address}/hpr.wasm`)],
    ["a Response made of bytes", () => new Response(wasmBytes())],
    ["a Uint8Array", () => wasmBytes()],
    ["a view of shared memory", sharedBytes],
    ["an ArrayBuffer", () => wasmBytes().buffer],
    ["a DataView", () => new DataView(wasmBytes().buffer)],
    ["a WebAssembly.Module", () => new WebAssembly.Module(wasmBytes())],
  ];
  it.each(inputs)("takes %s", async (_, input) => {
    const fresh = await freshPackage();
    await fresh.init((await input()) as never);
    expectToWork(fresh);
  });

  it("loads once, however often it is called", async () => {
    const fresh = await freshPackage();
    const before = requests;
    const [first, second] = [fresh.init(`${address}/hpr.wasm`), fresh.init(`${address}/hpr.wasm`)];
    expect(second).toBe(first);
    await first;
    const cloud = new fresh.PointCloud(bumpySphere(1, 200));
    await fresh.init(`${address}/hpr.wasm`);
    await fresh.init();
    fresh.initSync(wasmBytes());
    expect(requests - before).toBe(1);
    expect(cloud.visibleFrom(farAway).count).toBeGreaterThan(10);
  });

  it("leaves an instance alone that initSync() started while it was loading", async () => {
    const fresh = await freshPackage();
    const starting = fresh.init(`${address}/hpr.wasm`);
    fresh.initSync(wasmBytes());
    const cloud = new fresh.PointCloud(bumpySphere(1, 200));
    await starting;
    expect(cloud.visibleFrom(farAway).count).toBeGreaterThan(10);
  });

  const failures: [name: string, names: RegExp, input: () => unknown][] = [
    ["a URL nobody serves", /127\.0\.0\.1:\d+\/missing\.wasm.*404/, () => `${address}/missing.wasm`],
    ["a missing server", /127\.0\.0\.1:1\/hpr\.wasm/, () => new URL("http://127.0.0.1:1/hpr.wasm")],
    ["a page instead of wasm", /page\.wasm.*magic/, () => `${address}/page.wasm`],
    ["a Response that failed", /missing\.wasm.*404/, () => fetch(`${address}/missing.wasm`)],
    ["a missing file", /nothing\.wasm/, () => pathToFileURL("/nothing.wasm")],
    ["bytes that are no wasm", /magic/, () => new Uint8Array(100)],
    ["another wasm", /start/, () => new Uint8Array([0, 97, 115, 109, 1, 0, 0, 0])],
    ["a number", /got 7/, () => 7],
    ["null", /got null/, () => null],
  ];
  it.each(failures)("rejects %s with the code load, and may be called again", async (_, names, input) => {
    const fresh = await freshPackage();
    const given = (await input()) as never;
    const problem = await problemOf(() => fresh.init(given));
    expect(problem.code).toBe("load");
    expect(problem.message).toMatch(names);
    expect(problem.message).toMatch(/hidden-point-removal\/hpr\.wasm/);
    expect(problem.cause).toBeInstanceOf(Error);
    await fresh.init();
    expectToWork(fresh);
  });
});

describe("initSync", () => {
  const inputs: [name: string, input: () => unknown][] = [
    ["a Uint8Array", () => wasmBytes()],
    ["an ArrayBuffer", () => wasmBytes().buffer],
    ["a WebAssembly.Module", () => new WebAssembly.Module(wasmBytes())],
  ];
  it.each(inputs)("takes %s", async (_, input) => {
    const fresh = await freshPackage();
    fresh.initSync(input() as never);
    fresh.initSync(input() as never);
    expectToWork(fresh);
  });

  it.each([undefined, "hpr.wasm", new Uint8Array(3)])(
    "rejects %s with the code load, and may be called again",
    async (input) => {
      const fresh = await freshPackage();
      expect((await problemOf(() => fresh.initSync(input as never))).code).toBe("load");
      fresh.initSync(wasmBytes());
      expectToWork(fresh);
    },
  );
});

type Configure = (addresses: unknown) => void;

// tests/consumers shows its effect in bundlers.
describe("configure", () => {
  it.each([
    [undefined, /configure takes an object with wasm and worker, got undefined/],
    [null, /configure takes an object with wasm and worker, got null/],
    ["/hpr.wasm", /configure takes an object with wasm and worker, got "\/hpr\.wasm"/],
    [{ wasmUrl: "/hpr.wasm" }, /unknown option "wasmUrl" of configure; there are wasm and worker/],
    [{ worker: 3 }, /worker must be an address, got 3/],
    [{ worker: new Uint8Array(4) }, /worker must be an address, got an object of type Uint8Array/],
    [{ worker: null }, /worker must be an address, got null/],
  ])("%j is refused with the code option", async (addresses, says) => {
    const { configure, HprError, init, PointCloud } = await freshPackage();
    const refusal = (() => {
      try {
        (configure as Configure)(addresses);
      } catch (error) {
        return error;
      }
      return undefined;
    })();
    expect(refusal).toBeInstanceOf(HprError);
    expect(refusal).toMatchObject({ code: "option", message: expect.stringMatching(says) as string });
    // A refusal changes nothing.
    await init();
    expect(new PointCloud([0, 0, 1]).visibleFrom([0, 0, 5]).count).toBe(1);
  });

  it("a wasm that is none is refused by init, with the code load", async () => {
    const { configure, HprError, init } = await freshPackage();
    for (const wasm of [7, {}, new Uint8Array(8), "/no/such/file.wasm"]) {
      (configure as Configure)({ wasm });
      const error: unknown = await init().catch((thrown: unknown) => thrown);
      expect(error).toBeInstanceOf(HprError);
      expect(error).toMatchObject({ code: "load" });
    }
    // After that, the right one works, and what is not given stays.
    configure({ wasm: wasmBytes() });
    configure({});
    await init();
  });
});
