//! Answers merged from those of a cloud's parts.

use js_sys::Uint32Array;
use wasm_bindgen::prelude::*;

use crate::answers::merge::{Ids, merge};
use crate::wasm::options::ViewOptions;
use crate::wasm::transfer::{Coordinates, copy_in_integers, copy_out, points};

/// The ids of the visible points among positions; each position has one id.
#[wasm_bindgen(js_name = mergeVisible)]
pub fn merge_visible(
    positions: &Coordinates,
    ids: &Uint32Array,
    x: f64,
    y: f64,
    z: f64,
    options: &ViewOptions,
) -> Result<Uint32Array, JsValue> {
    let view = options.read();
    let (positions, ids) = (points(positions)?, copy_in_integers(ids)?);
    let part = |_| (positions.as_given(), Ids::Short(&ids));
    let seen = merge(1, &part, [x, y, z], &view)?;
    Ok(copy_out(&seen)?)
}
