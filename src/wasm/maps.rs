//! Maps of directions.

use js_sys::Float64Array;
use wasm_bindgen::prelude::*;

use crate::MapOptions;
use crate::wasm::clouds::with_memory;
use crate::wasm::objects::{list, object};
use crate::wasm::options::ViewOptions;
use crate::wasm::transfer::copy_out_singles;

/// A map of directions around (x, y, z). `map` holds the number of points, a direction
/// and its angle, and an origin. A number of 0 stands for the default, an angle of 0 stands for all directions, and an origin of infinity
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
    let mut numbers = [0.0; 8];
    map.copy_to(&mut numbers);
    let [points, a, b, c, angle, origin @ ..] = numbers;
    with_memory(handle, [x, y, z], options, &view, |cloud, memory| {
        let choices = MapOptions {
            points: match points {
                0.0 => MapOptions::default().points,
                points => points as usize,
            },
            towards: (angle != 0.0).then_some(([a, b, c], angle)),
            origin: Some(origin).filter(|origin| origin[0] != f64::INFINITY),
        };
        let made = cloud.visibility_map_with(memory, [x, y, z], &view, &choices)?;
        Ok(object(&[
            ("data", &copy_out_singles(made.data())?.into()),
            ("center", &list(&cloud.middle())),
            ("origin", &list(&made.origin())),
            ("numbers", &list(&made.numbers().map(f64::from))),
        ]))
    })
}
