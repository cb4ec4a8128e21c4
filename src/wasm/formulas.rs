//! What needs no cloud: formulas, and a listener of the page or worker that is told that something is still computed.

use core::cell::OnceCell;
use std::thread_local;

use js_sys::{Float64Array, Function};
use wasm_bindgen::prelude::*;

use crate::base::beat;
use crate::{permissible_curvature, radius_bound, ring_of_viewpoints};

/// Fills `ring`, three numbers a viewpoint, with viewpoints around `viewpoint`, on a circle
/// perpendicular to the line to `target`.
#[wasm_bindgen(js_name = ringOfViewpoints)]
pub fn ring(
    viewpoint: &Float64Array,
    target: &Float64Array,
    fraction: f64,
    ring: &Float64Array,
) -> Result<(), JsValue> {
    let [mut from, mut to] = [[0.0; 3]; 2];
    viewpoint.copy_to(&mut from);
    target.copy_to(&mut to);
    let count = ring.length() as usize / 3;
    let places = ring_of_viewpoints(from, to, count, fraction)?;
    ring.copy_from(places.as_flattened());
    Ok(())
}

/// The bound of Lemma 4.3.
#[wasm_bindgen(js_name = permissibleCurvature)]
pub fn curvature(radius: f64, r: f64, beta: f64) -> Result<f64, JsValue> {
    Ok(permissible_curvature(radius, r, beta)?)
}

/// The radius above which the back of a body shows through its front.
#[wasm_bindgen(js_name = radiusBound)]
pub fn bound(thickness: f64, distance: f64, spacing: f64) -> Result<f64, JsValue> {
    Ok(radius_bound(thickness, distance, spacing)?)
}

thread_local! {
    static LISTENER: OnceCell<Function> = const { OnceCell::new() };
}

/// Calls the function again and again while anything is computed: every few milliseconds, in the middle
/// of a call. It must not call this module. Only the first listener is kept.
#[wasm_bindgen(js_name = onBeat)]
pub fn on_beat(listener: Function) {
    let _ = LISTENER.with(|kept| kept.set(listener));
    beat::listen(|| {
        LISTENER.with(|kept| {
            if let Some(listener) = kept.get() {
                // The function posts a message, which does not throw.
                let _ = listener.call0(&JsValue::UNDEFINED);
            }
        });
    });
}
