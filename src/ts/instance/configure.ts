import { describe, HprError } from "../base/errors.js";
import { compile, compiledOnce, FULL, type InitInput, type OwnWasm } from "./compile.js";

/** Where the files of this package are, if a bundler does not put them where the package looks. */
export interface Addresses {
  /** What `init()` takes if it gets no argument: the address of `hpr.wasm`, its bytes, or the module. */
  wasm?: InitInput | undefined;
  /** The address of `worker-thread.js`: the file that the package exports by that name. In Node also a path. */
  worker?: string | URL | undefined;
}

const NAMES = ["wasm", "worker"];
let wasm: OwnWasm | undefined;
let worker: string | URL | undefined;
let workerText: string | undefined;

/**
 * Says where the wasm and the worker's script are. For all entries; call it before `init()` and before the first
 * `WorkerPointCloud`. What is not given stays as it is.
 *
 * ```js
 * configure({ wasm: "/files/hpr_bg.wasm", worker: "/files/worker-thread.js" });
 * ```
 *
 * @throws HprError `option` for an unknown name, or if `worker` is not an address.
 */
export function configure(addresses: Addresses): void {
  if (typeof addresses !== "object" || (addresses as unknown) === null) {
    throw new HprError("option", `configure takes an object with wasm and worker, got ${describe(addresses)}`);
  }
  const unknown = Object.keys(addresses).find((name) => !NAMES.includes(name));
  if (unknown !== undefined) {
    throw new HprError("option", `unknown option ${describe(unknown)} of configure; there are ${NAMES.join(" and ")}`);
  }
  const given = addresses.worker;
  if (given !== undefined && typeof given !== "string" && !(given instanceof URL)) {
    throw new HprError("option", `worker must be an address, got ${describe(given)}`);
  }
  const input = addresses.wasm;
  if (input !== undefined) {
    wasm = compiledOnce(() => compile(input, FULL));
  }
  worker = given ?? worker;
}

/** The wasm that {@link configure} was given. */
export function configuredWasm(): OwnWasm | undefined {
  return wasm;
}

/**
 * Keeps a wasm of a script's own, and the worker's script as text. They are used unless {@link configure} gave others.
 */
export function embed(own: OwnWasm, text: string): void {
  wasm ??= own;
  workerText = text;
}

/** Where to take the worker's script from: an address, its text, or the package's own file if both are missing. */
export function workerSource(): { address?: string | URL | undefined; text?: string | undefined } {
  return worker === undefined ? { text: workerText } : { address: worker };
}
