import { HprError, type HprErrorCode } from "../base/errors.js";
import type { Binary, WasmModule } from "./compile.js";

/** What all generated glue has besides the exports of its wasm. */
interface Glue {
  __wbg_set_wasm(exports: WebAssembly.Exports): void;
}

/**
 * One running copy of the wasm. The glue serves one copy at a time, so at most one is alive. After
 * a trap, the memory may be in any state. Then the copy is given up with every cloud in it.
 */
export class Instance<Bindings> {
  readonly module: WasmModule;
  readonly #state: State<Bindings>;
  readonly #glue: Bindings;
  readonly #exports: WebAssembly.Exports;
  #trap: unknown;

  constructor({ state, glue }: Engine<Bindings>, module: WasmModule, exports: WebAssembly.Exports) {
    this.module = module;
    this.#state = state;
    this.#glue = glue;
    this.#exports = exports;
  }

  get alive(): boolean {
    return this.#state.running === this;
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
      return use(this.#glue);
    } catch (thrown) {
      const refused = refusal(thrown);
      if (refused !== undefined) {
        throw refused;
      }
      this.#trap = thrown;
      this.#state.running = undefined;
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

/** What runs of one wasm. It does not know the glue: the worker client needs only this. */
export interface State<Bindings> {
  /** The instance that is alive, if any. */
  running?: Instance<Bindings> | undefined;
  /** The start that is under way. */
  starting?: { input: unknown; done: Promise<void> } | undefined;
}

/** A wasm of this package, with its glue. */
export interface Engine<Bindings> {
  readonly state: State<Bindings>;
  readonly glue: Bindings & Glue;
  readonly binary: Binary;
}

/** The instance that is alive. */
export function required<Bindings>({ running }: State<Bindings>): Instance<Bindings> {
  if (running === undefined) {
    throw new HprError(
      "not-initialised",
      "the wasm is not running yet: await init(), or call initSync() with its bytes, first",
    );
  }
  return running;
}

/** The imports of the wasm module. */
export function importsOf({ glue }: Engine<unknown>): WebAssembly.Imports {
  return { "./hpr_bg.js": glue as unknown as WebAssembly.ModuleImports };
}

/** Makes this instance the one that the glue serves. No other may be alive. */
export function startInstance<Bindings>(
  engine: Engine<Bindings>,
  module: WasmModule,
  { exports }: WebAssembly.Instance,
): void {
  engine.glue.__wbg_set_wasm(exports);
  try {
    (exports["__wbindgen_start"] as () => void)();
  } catch (cause) {
    detachMemory(exports);
    throw cause;
  }
  engine.state.running = new Instance(engine, module, exports);
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

/** The bindings of every wasm. */
interface Freeing {
  freeCloud(handle: number): void;
}

/** Frees the clouds that were never disposed of, after nothing refers to them any more. */
export const unreachable = new FinalizationRegistry(freeCloud);

/** Frees a cloud unless its instance is lost. The number of a lost cloud may be in use again for another cloud. */
export function freeCloud({ instance, handle }: { instance: Instance<Freeing>; handle: number }): void {
  if (instance.alive) {
    instance.call((bindings) => {
      bindings.freeCloud(handle);
    });
  }
}

/**
 * A refusal as the wasm throws it (src/wasm/answer.rs). The numbers are written here, because that would make the wasm
 * larger.
 */
interface Failure {
  code: HprErrorCode;
  /** The message. Each `@` in it stands for a word, and each `#` for a number. */
  text: string;
  first: string;
  second: string;
  numbers: number[];
}

/**
 * The error of a refusal by the bindings, which have freed their memory by then. Undefined for any
 * other thrown value.
 */
export function refusal(thrown: unknown): HprError | undefined {
  if (!isFailure(thrown)) {
    return undefined;
  }
  const { code, text, first, second, numbers } = thrown;
  const [words, values] = [[first, second], numbers.map(spelled)];
  return new HprError(
    code,
    text.replace(/[@#]/g, (mark) => (mark === "@" ? words : values).shift()!),
  );
}

/** The number as the crate writes it. JavaScript writes only these cases differently. */
function spelled(number: number): string {
  if (Object.is(number, -0)) {
    return "-0";
  }
  return String(number).replace("Infinity", "infinity").replace("e+", "e");
}

function isFailure(thrown: unknown): thrown is Failure {
  return (
    typeof thrown === "object" &&
    thrown !== null &&
    !(thrown instanceof Error) &&
    "code" in thrown &&
    "text" in thrown &&
    "numbers" in thrown
  );
}
