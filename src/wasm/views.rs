//! Views in slices, from several viewpoints, along a direction and through a camera.

use js_sys::{Float32Array, Float64Array, Uint8Array, Uint32Array};
use wasm_bindgen::prelude::*;

use crate::Camera;
use crate::cloud::points::Given;
use crate::wasm::answer::answered;
use crate::wasm::clouds::{is_hyper, with_cloud, with_hyper, with_memory, with_view};
use crate::wasm::higher::seen_from_several;
use crate::wasm::options::ViewOptions;
use crate::wasm::transfer::{copy_in_integers, triples};

/// Does a part of the work of `visibleFrom`, which goes on from there: about `budget` points. Returns whether little more
/// than the answer is left.
#[wasm_bindgen(js_name = goOn)]
pub fn go_on(
    handle: u32,
    x: f64,
    y: f64,
    z: f64,
    options: &ViewOptions,
    budget: u32,
) -> Result<bool, JsValue> {
    if options.mask().is_some() {
        return Ok(true);
    }
    let view = options.read();
    with_memory(handle, [x, y, z], options, &view, |cloud, memory| {
        cloud.go_on_with(memory, [x, y, z], &view, budget as usize)
    })
}

/// Writes into `target` where a camera shows points: x, y and the depth of each, and the direction of length 1 to
/// the camera. All are 0 for a point outside of the image. `camera`: see `Camera::of`.
#[wasm_bindgen]
pub fn project(
    handle: u32,
    camera: &Float64Array,
    indices: &Uint32Array,
    target: &Float32Array,
) -> Result<(), JsValue> {
    let shown = with_cloud(handle, |cloud| {
        cloud.shown(&read(camera), &copy_in_integers(indices)?)
    })?;
    target.copy_from(shown.as_flattened());
    Ok(())
}

/// Checks a camera. Returns its place, and the direction and the angle of the cone around its image.
#[wasm_bindgen(js_name = cameraPlace)]
pub fn camera_place(camera: &Float64Array) -> Result<Float64Array, JsValue> {
    let camera = read(camera);
    let ([a, b, c], angle) = camera.cone()?;
    let [x, y, z] = camera.position();
    Ok(Float64Array::from([x, y, z, a, b, c, angle].as_slice()))
}

#[inline(never)]
pub(super) fn read(camera: &Float64Array) -> Camera {
    let mut numbers = [0.0; 35];
    camera.copy_to(&mut numbers);
    Camera::of(&numbers)
}

/// Whether the pose of a camera was probably given the wrong way round.
#[wasm_bindgen(js_name = seemsInverted)]
pub fn seems_inverted(handle: u32, camera: &Float64Array) -> Result<bool, JsValue> {
    let camera = read(camera);
    with_cloud(handle, |cloud| cloud.seems_inverted(&camera))
}

/// Would points at `positions` be visible from (x, y, z), each added alone? Writes 1 or 0 for each
/// into `target`.
#[wasm_bindgen]
pub fn sees(
    handle: u32,
    x: f64,
    y: f64,
    z: f64,
    positions: &Float64Array,
    options: &ViewOptions,
    target: &Uint8Array,
) -> Result<(), JsValue> {
    let view = options.read();
    let seen = with_view(handle, Some([x, y, z]), options, &view, |cloud| {
        let positions = triples(positions)?;
        cloud.sees_given([x, y, z], Given::Double(&positions), &view)
    })?;
    target.copy_from(&seen);
    Ok(())
}

/// Which points are visible from at least `k` of the viewpoints? `viewpoints` holds the numbers of
/// one viewpoint after another.
#[wasm_bindgen(js_name = visibleFromSeveral, unchecked_return_type = "Answer")]
pub fn visible_from_several(
    handle: u32,
    viewpoints: &Float64Array,
    k: u32,
    options: &ViewOptions,
) -> Result<JsValue, JsValue> {
    let view = options.read();
    if is_hyper(handle) {
        let seen = with_hyper(handle, |cloud| {
            seen_from_several(cloud, viewpoints, k as usize, &view)
        });
        return answered(seen);
    }
    let seen = with_view(handle, None, options, &view, |cloud| {
        let viewpoints = triples(viewpoints)?;
        // "Any of no viewpoints" is an empty answer; "one of no viewpoints" is refused.
        if viewpoints.is_empty() {
            cloud.visible_from_any(&viewpoints, &view)
        } else {
            cloud.visible_from_at_least(k as usize, &viewpoints, &view)
        }
    });
    answered(seen)
}

/// Which points are visible along (x, y, z) from infinitely far away?
#[wasm_bindgen(js_name = visibleFromDirection, unchecked_return_type = "Answer")]
pub fn visible_from_direction(
    handle: u32,
    x: f64,
    y: f64,
    z: f64,
    options: &ViewOptions,
) -> Result<JsValue, JsValue> {
    let view = options.read();
    let seen = with_view(handle, None, options, &view, |cloud| {
        cloud.visible_from_direction([x, y, z], &view)
    });
    answered(seen)
}
