import { HprError } from "../base/errors.js";
import { refusal } from "./failure.js";
import * as glue from "../wasm/hpr_bg.js";

/** The exports of the wasm, as the generated glue offers them. */
export type Bindings = Omit<typeof glue, "__wbg_set_wasm">;

/**
 * One running copy of the wasm. The glue serves one copy at a time, so at most one is alive. After
 * a trap, the memory may be in any state. Then the copy is given up with every cloud in it.
 */
export class Instance {
  readonly module: WebAssembly.Module;
  readonly #exports: WebAssembly.Exports;
  #trap: unknown;

  constructor(module: WebAssembly.Module, exports: WebAssembly.Exports) {
    this.module = module;
    this.#exports = exports;
  }

  get alive(): boolean {
    return current === this;
  }

  /** Calls into the wasm. Every error of the wasm becomes an `HprError`. */
  call<T>(use: (bindings: Bindings) => T): T {
    if (!this.alive) {
      throw new HprError(
        "internal",
        "this cloud was lost when the wasm instance trapped; call init() again and build a new one",
        { cause: this.#trap },
      );
    }
    try {
      return use(glue);
    } catch (thrown) {
      const refused = refusal(thrown);
      if (refused !== undefined) {
        throw refused;
      }
      this.#trap = thrown;
      current = undefined;
      detachMemory(this.#exports);
      throw new HprError(
        "internal",
        `the wasm instance trapped (${String(thrown)}) and was given up with all of its clouds; ` +
          "call init() again to go on with new ones",
        { cause: thrown },
      );
    }
  }
}

let current: Instance | undefined;

/** The imports of the wasm module. */
export const imports: WebAssembly.Imports = { "./hpr_bg.js": glue };

/** The instance that is alive, if any. */
export function runningInstance(): Instance | undefined {
  return current;
}

/** The instance that is alive. */
export function requireInstance(): Instance {
  if (current === undefined) {
    throw new HprError(
      "not-initialised",
      "the wasm is not running yet: await init(), or call initSync() with its bytes, first",
    );
  }
  return current;
}

/** Makes this instance the one that the glue serves. No other may be alive. */
export function startInstance(module: WebAssembly.Module, { exports }: WebAssembly.Instance): void {
  glue.__wbg_set_wasm(exports);
  try {
    (exports["__wbindgen_start"] as () => void)();
  } catch (cause) {
    detachMemory(exports);
    throw cause;
  }
  current = new Instance(module, exports);
}

/**
 * The glue keeps views of the last memory and makes new ones only after their buffer is detached.
 * Every `grow` detaches the buffer, even a `grow` by 0.
 */
function detachMemory({ memory }: WebAssembly.Exports): void {
  if (memory instanceof WebAssembly.Memory) {
    memory.grow(0);
  }
}
