// What `configure` refuses. tests/consumers shows its effect in bundlers.
import { expect, it } from "vitest";

import { freshPackage, wasmBytes } from "./support";

type Configure = (addresses: unknown) => void;

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
