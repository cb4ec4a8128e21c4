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
#[cfg(feature = "wasm")]
mod beats;
mod cloud_options;
mod clouds;
mod failure;
#[cfg(feature = "wasm")]
mod formulas;
#[cfg(feature = "wasm")]
mod higher;
#[cfg(feature = "wasm")]
mod horizons;
#[cfg(feature = "wasm")]
mod maps;
#[cfg(feature = "wasm")]
mod merges;
mod objects;
mod options;
#[cfg(feature = "wasm")]
mod outputs;
#[cfg(feature = "wasm")]
mod panoramas;
mod space;
mod transfer;
mod view;
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
  /** As coreNumbers of view-options.ts lists them. */
  numbers: Float64Array;
  mask?: Uint8Array | undefined;
  /** Makes room for so many indices of an answer. */
  memory: (length: number) => Uint32Array<ArrayBuffer>;
}
interface ChosenRadius { radius: number; exponent: number; evaluations: number }
interface Answer extends ChosenRadius {
  indices: Uint32Array<ArrayBuffer>;
  triangles: Uint32Array<ArrayBuffer>;
  scores: Float32Array<ArrayBuffer>;
  exact: number;
  scales: [number, number, number];
}
interface MapAnswer {
  data: Float32Array<ArrayBuffer>;
  center: [number, number, number];
  origin: [number, number, number];
  numbers: [number, number, number, number];
}
"#;
