//! What is made of views: meshes and light.

use alloc::vec::Vec;

use js_sys::{Float32Array, Float64Array, Uint32Array};
use wasm_bindgen::prelude::*;

use super::answer::answer;
use super::clouds::with_cloud;
use super::options::ViewOptions;
use super::transfer::{copy_in_integers, triples};
use crate::Lighting;

/// What is visible from (x, y, z), and the triangles between it.
#[wasm_bindgen(unchecked_return_type = "Answer")]
pub fn reconstruct(
    handle: u32,
    x: f64,
    y: f64,
    z: f64,
    options: &ViewOptions,
    max_edge: Option<f64>,
) -> Result<JsValue, JsValue> {
    let options = options.read();
    let mesh = with_cloud(handle, |cloud| {
        cloud.reconstruct([x, y, z], &options, max_edge)
    })?;
    Ok(answer(&mesh.visibility, &mesh.triangles)?)
}

/// Writes the brightness of every index under the lights, x, y, z of one after another,
/// into `target`, which has the length of the cloud.
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
    let options = options.read();
    let brightness = with_cloud(handle, |cloud| {
        let lights = triples(lights)?;
        let corners = triangles.as_ref().map(copy_in_integers).transpose()?;
        let mut triangles: Vec<[u32; 3]> = Vec::new();
        if let Some(corners) = &corners {
            triangles.try_reserve_exact(corners.len() / 3)?;
            let three = corners.chunks_exact(3).map(|t| [t[0], t[1], t[2]]);
            triangles.extend(three);
        }
        let lighting = Lighting {
            triangles: corners.is_some().then_some(&triangles[..]),
            smoothing: smoothing as usize,
            ambient,
        };
        cloud.illuminate(&lights, &options, &lighting)
    })?;
    target.copy_from(&brightness);
    Ok(())
}
