//! Clouds in parts: horizons, which are kept among the clouds, grow and are freed as clouds are, and merged answers.

use alloc::boxed::Box;

use js_sys::{Float64Array, Uint32Array};
use wasm_bindgen::prelude::*;

use crate::Horizon;
use crate::answers::merge::{Ids, merge};
use crate::wasm::clouds::{Cloud, created, with_horizon};
use crate::wasm::options::ViewOptions;
use crate::wasm::transfer::{Coordinates, copy_in_integers, copy_out, copy_out_doubles, points};

/// A horizon without points, seen from (x, y, z).
#[wasm_bindgen(js_name = createHorizon, unchecked_return_type = "CloudInfo")]
pub fn create_horizon(x: f64, y: f64, z: f64, options: &ViewOptions) -> Result<JsValue, JsValue> {
    let horizon = Horizon::new([x, y, z], &options.read());
    created(horizon.map(|horizon| Cloud::Horizon(Box::new(horizon))))
}

/// The indices of points that the horizon does not hide.
#[wasm_bindgen]
pub fn screen(handle: u32, positions: &Coordinates) -> Result<Uint32Array, JsValue> {
    with_horizon(handle, |horizon| {
        let kept = horizon.not_hidden(points(positions)?.as_given())?;
        copy_out(&kept)
    })
}

/// Whether everything in a box is certainly hidden. `corners` holds its least and its largest x, y, z.
#[wasm_bindgen(js_name = hidesBox)]
pub fn hides_box(handle: u32, corners: &Float64Array) -> Result<bool, JsValue> {
    let mut own = [[0.0; 3]; 2];
    corners.copy_to(own.as_flattened_mut());
    with_horizon(handle, |horizon| horizon.hides_box(own[0], own[1]))
}

/// The points of the horizon that are visible among them: x, y, z of each.
#[wasm_bindgen(js_name = horizonPoints)]
pub fn horizon_points(handle: u32) -> Result<Float64Array, JsValue> {
    with_horizon(handle, |horizon| {
        copy_out_doubles(horizon.visible()?.as_flattened())
    })
}

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
