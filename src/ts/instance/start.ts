import {
  bytesOf,
  compile,
  type InitInput,
  isModule,
  loadError,
  nameOf,
  type OwnWasm,
  type SyncInitInput,
  type WasmModule,
} from "./compile.js";
import { type Engine, importsOf, startInstance, type State } from "./engine.js";

/** The `init()` of every entry, with that entry's own wasm. */
export function initFrom<B>(engine: Engine<B>, own: OwnWasm, input: InitInput | undefined): Promise<void> {
  const { state } = engine;
  const { starting } = state;
  if (state.running !== undefined) {
    return Promise.resolve();
  }
  if (starting !== undefined && starting.input === input) {
    return starting.done;
  }
  const begin = () => start(engine, own, input);
  const attempt = {
    input,
    done: (starting === undefined ? begin() : starting.done.catch(begin)).finally(() => {
      if (state.starting === attempt) {
        state.starting = undefined;
      }
    }),
  };
  state.starting = attempt;
  return attempt.done;
}

/** The `initSync()` of every entry. */
export function startSync<B>(engine: Engine<B>, input: SyncInitInput): void {
  if (engine.state.running !== undefined) {
    return;
  }
  try {
    const module = isModule(input) ? input : new WebAssembly.Module(bytesOf(input));
    startInstance(engine, module, new WebAssembly.Instance(module, importsOf(engine)));
  } catch (cause) {
    throw loadError("the given wasm", cause, engine.binary);
  }
}

/** The compiled wasm of the instance that is running or starting, if any. */
export async function startedModule<B>(state: State<B>): Promise<WasmModule | undefined> {
  await state.starting?.done;
  return state.running?.module;
}

async function start<B>(engine: Engine<B>, own: OwnWasm, input: InitInput | undefined): Promise<void> {
  const module = await (input === undefined ? own() : compile(input, engine.binary));
  try {
    const instance = await WebAssembly.instantiate(module, importsOf(engine));
    // initSync() may have been called in the meantime.
    if (engine.state.running === undefined) {
      startInstance(engine, module, instance);
    }
  } catch (cause) {
    throw loadError(input === undefined ? "the package's own wasm" : nameOf(input), cause, engine.binary);
  }
}
