import type * as glue from "../wasm/hpr_bg.js";
import { type Instance as RunningInstance, required, type State } from "./engine.js";

/** The exports of the wasm, as the generated glue offers them. */
export type Bindings = Omit<typeof glue, "__wbg_set_wasm">;
export type Instance = RunningInstance<Bindings>;

export const state: State<Bindings> = {};

/** The instance that is alive, if any. */
export function runningInstance(): Instance | undefined {
  return state.running;
}

/** The instance that is alive. */
export function requireInstance(): Instance {
  return required(state);
}
