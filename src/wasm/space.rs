//! Clouds in space.

use alloc::boxed::Box;

use js_sys::Uint32Array;
#[cfg(feature = "wasm")]
use wasm_bindgen::JsCast;
use wasm_bindgen::prelude::*;

use crate::PointCloud;
use crate::base::build::FULL;
use crate::wasm::cloud_options::{CloudOptions, non_finite};
use crate::wasm::clouds::{Cloud, change_any, created};
#[cfg(feature = "wasm")]
use crate::wasm::higher::hyper_cloud;
#[cfg(feature = "wasm")]
use crate::wasm::transfer::numbers;
use crate::wasm::transfer::{Coordinates, copy_in_integers, points};

/// A cloud of `dimension` numbers a point, or of three up to the third dimension. These are kept in their precision.
#[wasm_bindgen(js_name = createCloud, unchecked_return_type = "CloudInfo")]
pub fn create_cloud(
    positions: &Coordinates,
    dimension: u32,
    options: &CloudOptions,
) -> Result<JsValue, JsValue> {
    let non_finite = non_finite(options);
    #[cfg(feature = "wasm")]
    if dimension > 3 {
        return created(hyper_cloud(positions, dimension as usize, non_finite));
    }
    let _ = dimension;
    let listener = if FULL { options.progress() } else { None };
    let mut progress = |share: f64| {
        if let Some(listener) = &listener {
            // The function posts a message, which does not throw.
            let _ = listener.call1(&JsValue::UNDEFINED, &share.into());
        }
    };
    created(points(positions).and_then(|positions| {
        let cloud = PointCloud::prepare(positions.as_given(), non_finite, &mut progress)?;
        Ok(Cloud::Space(Box::new(cloud)))
    }))
}

/// Adds points to a cloud or to a horizon.
#[wasm_bindgen(unchecked_return_type = "CloudSize")]
pub fn append(handle: u32, positions: &Coordinates) -> Result<JsValue, JsValue> {
    change_any(handle, &mut |cloud| match cloud {
        Cloud::Space(cloud) => cloud.add(points(positions)?.as_given()),
        #[cfg(feature = "wasm")]
        Cloud::Horizon(horizon) => horizon.grow(points(positions)?.as_given()),
        #[cfg(feature = "wasm")]
        Cloud::Hyper(cloud) => cloud.append(&numbers(positions.unchecked_ref())?),
    })
}

/// Removes points from a cloud of any dimension by their indices.
#[wasm_bindgen(unchecked_return_type = "CloudSize")]
pub fn remove(handle: u32, indices: &Uint32Array) -> Result<JsValue, JsValue> {
    let indices = copy_in_integers(indices)?;
    change_any(handle, &mut |cloud| match cloud {
        Cloud::Space(cloud) => cloud.remove(&indices),
        #[cfg(feature = "wasm")]
        Cloud::Hyper(cloud) => cloud.remove(&indices),
        #[cfg(feature = "wasm")]
        Cloud::Horizon(_) => Ok(()),
    })
}
