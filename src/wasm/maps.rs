//! Maps of directions.

use js_sys::Float64Array;
use wasm_bindgen::prelude::*;

use super::clouds::{with_memory, with_view};
use super::objects::Fields;
use super::options::ViewOptions;
use super::transfer::copy_out_singles;
use crate::MapOptions;

/// A map of directions around (x, y, z). `map` holds the numbers of points and of corners, a direction
/// and its angle, and an origin. An angle of 0 stands for all directions, and an origin of infinity
/// for none.
#[wasm_bindgen(js_name = visibilityMap, unchecked_return_type = "MapAnswer")]
pub fn visibility_map(
    handle: u32,
    x: f64,
    y: f64,
    z: f64,
    options: &ViewOptions,
    map: &Float64Array,
) -> Result<JsValue, JsValue> {
    let view = options.read();
    let masked = options.mask().is_some();
    let mut numbers = [0.0; 9];
    map.copy_to(&mut numbers);
    let [points, corners, a, b, c, angle, origin @ ..] = numbers;
    let choices = MapOptions {
        points: points as usize,
        corners: corners as usize,
        towards: (angle != 0.0).then_some(([a, b, c], angle)),
        origin: Some(origin).filter(|origin| origin[0] != f64::INFINITY),
    };
    let made = with_view(handle, Some([x, y, z]), options, &view, |cloud| {
        with_memory(handle, masked, |memory| {
            let made = cloud.visibility_map_with(memory, [x, y, z], &view, &choices)?;
            let fields = Fields::new();
            fields.set("data", copy_out_singles(made.data(), options)?);
            fields.numbers("center", &cloud.middle());
            fields.numbers("origin", &made.origin());
            fields.numbers("numbers", &made.numbers().map(f64::from));
            Ok(fields.into())
        })
    })?;
    Ok(made)
}
