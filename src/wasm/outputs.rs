//! Meshes and light. Both are computed from views.

use js_sys::{Float32Array, Float64Array, Uint32Array};
use wasm_bindgen::prelude::*;

use crate::Lighting;
use crate::wasm::answer::answer;
use crate::wasm::clouds::with_view;
use crate::wasm::options::ViewOptions;
use crate::wasm::transfer::{corners, triples};

/// The points that are visible from (x, y, z), and the triangles between them.
#[wasm_bindgen(unchecked_return_type = "Answer")]
pub fn reconstruct(
    handle: u32,
    x: f64,
    y: f64,
    z: f64,
    options: &ViewOptions,
    max_edge: Option<f64>,
) -> Result<JsValue, JsValue> {
    let view = options.read();
    let mesh = with_view(handle, Some([x, y, z]), options, &view, |cloud| {
        cloud.reconstruct([x, y, z], &view, max_edge)
    })?;
    Ok(answer(&mesh.visibility, mesh.triangles.as_flattened())?)
}

/// Writes the brightness of every index into `target`, which has the length of the cloud.
/// `lights` holds x, y, z of one light after another.
#[wasm_bindgen]
pub fn illuminate(
    handle: u32,
    lights: &Float64Array,
    options: &ViewOptions,
    triangles: Option<Uint32Array>,
    smoothing: f64,
    ambient: f64,
    target: &Float32Array,
) -> Result<(), JsValue> {
    let view = options.read();
    let brightness = with_view(handle, None, options, &view, |cloud| {
        let lights = triples(lights)?;
        let triangles = triangles.as_ref().map(corners).transpose()?;
        let lighting = Lighting {
            triangles: triangles.as_deref(),
            smoothing: smoothing as usize,
            ambient,
        };
        cloud.illuminate(&lights, &view, &lighting)
    })?;
    target.copy_from(&brightness);
    Ok(())
}
