//! Views, whole or divided among several workers.

use wasm_bindgen::prelude::*;

use super::failure::Failure;
use super::transfer::copy_out;
use super::{Answer, ViewOptions, to_js, with_cloud, with_memory};
use crate::{Options, Radius, Sector};

/// Which of the points that fall to sector `number` of `count` are visible from (x, y, z)?
#[wasm_bindgen(js_name = visibleInSector, unchecked_return_type = "Answer")]
pub fn visible_in_sector(
    handle: u32,
    x: f64,
    y: f64,
    z: f64,
    options: &ViewOptions,
    number: u32,
    count: u32,
) -> Result<JsValue, JsValue> {
    let radius = match (options.radius(), options.exponent()) {
        (Some(radius), _) => Radius::Absolute(radius),
        (None, Some(exponent)) => Radius::Exponent(exponent),
        (None, None) => Radius::Auto,
    };
    let sector = Sector::new(number, count).unwrap_or(Sector::WHOLE);
    let visibility = with_cloud(handle, |cloud| {
        with_memory(handle, |memory| {
            let options = Options {
                radius,
                ..Options::default()
            };
            cloud.visible_in_sector_with(memory, [x, y, z], &options, sector)
        })
    })?;
    Ok(to_js(&Answer {
        indices: copy_out(visibility.indices()).map_err(Failure::from)?,
        radius: visibility.radius(),
        exponent: visibility.exponent(),
        evaluations: f64::from(visibility.evaluations()),
    }))
}
