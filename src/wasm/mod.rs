//! The JavaScript bindings: check, copy in, call, copy out, map errors.
//!
//! Clouds stay in wasm, and JavaScript holds a number for each. So a number from an instance
//! that was given up can never free memory of the next instance. Typed arrays arrive as
//! JavaScript objects, never as `&[f32]`. The glue would copy a `&[f32]` before any code here
//! runs, and trap where memory is refused.
//!
//! With the feature `lite` alone, they hold the operator: a cloud of two or three dimensions, a view,
//! its radius, and changes.

mod answer;
mod clouds;
#[cfg(feature = "wasm")]
mod formulas;
#[cfg(feature = "wasm")]
mod higher;
#[cfg(feature = "wasm")]
mod merge;
mod operator;
mod options;
#[cfg(feature = "wasm")]
mod outputs;
#[cfg(feature = "wasm")]
mod surveys;
mod transfer;
#[cfg(feature = "wasm")]
mod views;

#[cfg(debug_assertions)]
use {alloc::boxed::Box, alloc::string::ToString, std::panic};

use wasm_bindgen::prelude::*;

/// Runs once for each instance of a development build: a panic prints its message before it traps. A
/// released module traps without a message.
#[cfg(debug_assertions)]
#[wasm_bindgen(start)]
fn start() {
    panic::set_hook(Box::new(|info| {
        web_sys::console::error_1(&info.to_string().into());
    }));
}

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &str = r#"
/** Makes all of the functions below call into this instance. */
export function __wbg_set_wasm(exports: WebAssembly.Exports): void;
interface CloudOptions { skipNonFinite: boolean; progress?: ((share: number) => void) | undefined }
interface CloudSize { length: number; skipped: number; spacing: number }
interface CloudInfo extends CloudSize { handle: number }
interface ViewOptions {
  /** 0 the automatic radius, 1 the paper's rule, 2 `size` is R, 3 `size` is the exponent. */
  rule: number;
  size: number;
  /** 0 spherical, 1 `parameter` is the power, 2 exponential, 3 `parameter` is its scale, 4 `parameter` is the number of looks. */
  kernel: number;
  parameter: number;
  /** The names and values of all others. */
  others: readonly (readonly [string, unknown])[];
  /** A distance, the lowest x, y, z and the highest ones; infinite where there is no limit. */
  within: ArrayLike<number>;
  mask?: Uint8Array | undefined;
}
interface ChosenRadius { radius: number; exponent: number; evaluations: number }
interface Answer extends ChosenRadius {
  indices: Uint32Array<ArrayBuffer>;
  triangles: Uint32Array<ArrayBuffer>;
  scores: Float32Array<ArrayBuffer>;
  exact: number;
  scales: [number, number, number];
}
interface ShownPoints {
  indices: Uint32Array;
  pixels: Float32Array;
  depths: Float32Array;
  towards?: Float32Array | undefined;
  scores?: Float32Array | undefined;
}
interface PlacementAnswer {
  chosen: number[];
  gains: number[];
  seen: Uint32Array<ArrayBuffer>;
  unseen: Uint32Array<ArrayBuffer>;
}
interface CalibrationAnswer { thickness: number; recall: number[]; shown: number; isLow: boolean }
interface MapAnswer {
  data: Float32Array<ArrayBuffer>;
  center: [number, number, number];
  origin: [number, number, number];
  numbers: [number, number, number, number];
}
"#;
