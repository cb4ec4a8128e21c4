//! Answers merged from those of a cloud's parts.

use js_sys::{Float32Array, Float64Array, Uint32Array};
use wasm_bindgen::prelude::*;

use crate::Error;
use crate::answers::merge::{Ids, merge};
use crate::cloud::points::Points;
use crate::wasm::failure::Failure;
use crate::wasm::options::ViewOptions;
use crate::wasm::transfer::{copy_in_integers, copy_out, doubles, singles};

/// The ids of the visible points among single-precision positions; each position has one id.
#[wasm_bindgen(js_name = mergeVisibleF32)]
pub fn merge_visible_f32(
    positions: &Float32Array,
    ids: &Uint32Array,
    x: f64,
    y: f64,
    z: f64,
    options: &ViewOptions,
) -> Result<Uint32Array, JsValue> {
    merge_visible(singles(positions), ids, [x, y, z], options)
}

/// The ids of the visible points among double-precision positions; each position has one id.
#[wasm_bindgen(js_name = mergeVisibleF64)]
pub fn merge_visible_f64(
    positions: &Float64Array,
    ids: &Uint32Array,
    x: f64,
    y: f64,
    z: f64,
    options: &ViewOptions,
) -> Result<Uint32Array, JsValue> {
    merge_visible(doubles(positions), ids, [x, y, z], options)
}

fn merge_visible(
    positions: Result<Points, Error>,
    ids: &Uint32Array,
    viewpoint: [f64; 3],
    options: &ViewOptions,
) -> Result<Uint32Array, JsValue> {
    let view = options.read();
    let merged = positions.and_then(|positions| {
        let ids = copy_in_integers(ids)?;
        let part = |_| (positions.as_given(), Ids::Short(&ids));
        let seen = merge(1, &part, viewpoint, &view)?;
        copy_out(&seen, options)
    });
    Ok(merged.map_err(Failure::from)?)
}
