//! A view divided among several workers.

use wasm_bindgen::prelude::*;

use super::transfer::copy_out;
use super::{Answer, Failure, ViewOptions, to_js, with_cloud};
use crate::{Options, Radius, Sector};

/// Which of the points that fall to sector `number` of `count` are visible from (x, y, z)?
#[wasm_bindgen(js_name = visibleInSector, unchecked_return_type = "Answer")]
pub fn visible_in_sector(
    handle: u32,
    x: f64,
    y: f64,
    z: f64,
    #[wasm_bindgen(unchecked_param_type = "ViewOptions")] options: JsValue,
    number: u32,
    count: u32,
) -> Result<JsValue, JsValue> {
    let options: ViewOptions = serde_wasm_bindgen::from_value(options).map_err(Failure::from)?;
    let radius = match (options.radius, options.exponent) {
        (Some(radius), _) => Radius::Absolute(radius),
        (None, Some(exponent)) => Radius::Exponent(exponent),
        (None, None) => Radius::Auto,
    };
    let sector = Sector::new(number, count).ok_or_else(|| Failure {
        code: "option",
        message: "there is no such sector".into(),
    })?;
    let visibility = with_cloud(handle, |cloud| {
        cloud.visible_in_sector([x, y, z], &Options { radius }, sector)
    })?;
    Ok(to_js(&Answer {
        indices: copy_out(visibility.indices()).map_err(Failure::from)?,
        radius: visibility.radius(),
        exponent: visibility.exponent(),
        evaluations: visibility.evaluations(),
    }))
}
