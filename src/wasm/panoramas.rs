//! Panoramas.

use js_sys::{Float32Array, Float64Array, Uint32Array};
use wasm_bindgen::prelude::*;

use crate::PanoramaOptions;
use crate::wasm::clouds::with_memory;
use crate::wasm::options::ViewOptions;

/// Writes what stands in each direction into `ranges` and `indices`, which have a place for each pixel, and
/// the sky view factor and the solid angle into `areas`. `asked` holds x, y, z of the viewpoint, the width,
/// the height, and x, y, z of the direction up.
#[wasm_bindgen]
pub fn panorama(
    handle: u32,
    asked: &Float64Array,
    options: &ViewOptions,
    ranges: &Float32Array,
    indices: &Uint32Array,
    areas: &Float64Array,
) -> Result<(), JsValue> {
    let view = options.read();
    let mut numbers = [0.0; 8];
    asked.copy_to(&mut numbers);
    let [x, y, z, width, height, up @ ..] = numbers;
    let choices = PanoramaOptions {
        width: width as usize,
        height: height as usize,
        up,
    };
    let made = with_memory(handle, [x, y, z], options, &view, |cloud, memory| {
        cloud.panorama_with(memory, [x, y, z], &view, &choices)
    })?;
    ranges.copy_from(&made.ranges);
    indices.copy_from(&made.indices);
    areas.copy_from(&[made.sky_view_factor, made.solid_angle]);
    Ok(())
}
