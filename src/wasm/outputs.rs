//! Meshes, light and the thickness of scans. All are computed from views.

use js_sys::{Float32Array, Float64Array, Uint32Array};
use wasm_bindgen::prelude::*;

use crate::base::allocation::with_capacity;
use crate::wasm::answer::answer;
use crate::wasm::clouds::with_view;
use crate::wasm::objects::{list, object};
use crate::wasm::options::ViewOptions;
use crate::wasm::transfer::{copy_in_integers, corners, triples};
use crate::{Lighting, Station};

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

/// The thickness at which scanners see their own points. `viewpoints` holds x, y, z of one station after another, `indices`
/// the points of all, and `ends` where those of each end.
#[wasm_bindgen(unchecked_return_type = "CalibrationAnswer")]
pub fn calibrate(
    handle: u32,
    viewpoints: &Float64Array,
    ends: &Uint32Array,
    indices: &Uint32Array,
    options: &ViewOptions,
) -> Result<JsValue, JsValue> {
    let view = options.read();
    let found = with_view(handle, None, options, &view, |cloud| {
        let (places, ends) = (triples(viewpoints)?, copy_in_integers(ends)?);
        let indices = copy_in_integers(indices)?;
        let mut stations = with_capacity(places.len())?;
        let mut start = 0;
        for (&viewpoint, &end) in places.iter().zip(&ends) {
            let indices = &indices[start..end as usize];
            stations.push(Station { viewpoint, indices });
            start = end as usize;
        }
        cloud.calibrate(&stations, &view)
    })?;
    Ok(object(&[
        ("thickness", &found.thickness.into()),
        ("recall", &list(&found.recall)),
        ("shown", &found.shown.into()),
        ("isLow", &found.is_low().into()),
    ]))
}
