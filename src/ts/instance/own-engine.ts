import * as glue from "../wasm/hpr_bg.js";
import { FULL } from "./compile.js";
import type { Engine } from "./engine.js";
import { type Bindings, state } from "./instance.js";

/** The engine of all entries but `lite`. Whoever only asks whether it runs does not import its glue. */
export const engine: Engine<Bindings> = { state, glue, binary: FULL };
