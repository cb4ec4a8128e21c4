//! Clouds in space.

use alloc::boxed::Box;

use js_sys::{Float32Array, Float64Array, Uint32Array};
use wasm_bindgen::prelude::*;

use crate::base::build::FULL;
use crate::cloud::points::Points;
use crate::wasm::cloud_options::{CloudOptions, non_finite};
use crate::wasm::clouds::{Cloud, change_any, created, resized};
use crate::wasm::failure::Failure;
use crate::wasm::transfer::{copy_in_integers, doubles, singles};
use crate::{Error, PointCloud};

/// A cloud of single-precision positions, three a point, kept in single precision.
#[wasm_bindgen(js_name = createCloudF32, unchecked_return_type = "CloudInfo")]
pub fn create_cloud_f32(
    positions: &Float32Array,
    options: &CloudOptions,
) -> Result<JsValue, JsValue> {
    create_cloud(singles(positions), options)
}

/// A cloud of double-precision positions.
#[wasm_bindgen(js_name = createCloudF64, unchecked_return_type = "CloudInfo")]
pub fn create_cloud_f64(
    positions: &Float64Array,
    options: &CloudOptions,
) -> Result<JsValue, JsValue> {
    create_cloud(doubles(positions), options)
}

/// Adds single-precision points to a cloud of any precision.
#[wasm_bindgen(js_name = appendF32, unchecked_return_type = "CloudSize")]
pub fn append_f32(handle: u32, positions: &Float32Array) -> Result<JsValue, JsValue> {
    append(handle, singles(positions))
}

/// Adds double-precision points to a cloud of any precision.
#[wasm_bindgen(js_name = appendF64, unchecked_return_type = "CloudSize")]
pub fn append_f64(handle: u32, positions: &Float64Array) -> Result<JsValue, JsValue> {
    append(handle, doubles(positions))
}

/// Removes points from a cloud of any dimension by their indices.
#[wasm_bindgen(unchecked_return_type = "CloudSize")]
pub fn remove(handle: u32, indices: &Uint32Array) -> Result<JsValue, JsValue> {
    let indices = copy_in_integers(indices).map_err(Failure::from)?;
    resized(change_any(handle, &mut |cloud| match cloud {
        Cloud::Space(cloud) => cloud.remove(&indices),
        #[cfg(feature = "wasm")]
        Cloud::Hyper(cloud) => cloud.remove(&indices),
        #[cfg(feature = "wasm")]
        Cloud::Horizon(_) => Ok(()),
    }))
}

fn create_cloud(
    positions: Result<Points, Error>,
    options: &CloudOptions,
) -> Result<JsValue, JsValue> {
    let non_finite = non_finite(options);
    let listener = if FULL { options.progress() } else { None };
    let mut progress = |share: f64| {
        if let Some(listener) = &listener {
            // The function posts a message, which does not throw.
            let _ = listener.call1(&JsValue::UNDEFINED, &share.into());
        }
    };
    created(positions.and_then(|positions| {
        let cloud = PointCloud::prepare(positions.as_given(), non_finite, &mut progress)?;
        Ok(Cloud::Space(Box::new(cloud)))
    }))
}

fn append(handle: u32, positions: Result<Points, Error>) -> Result<JsValue, JsValue> {
    let positions = positions.map_err(Failure::from)?;
    resized(change_any(handle, &mut |cloud| match cloud {
        Cloud::Space(cloud) => cloud.add(positions.as_given()),
        #[cfg(feature = "wasm")]
        Cloud::Horizon(horizon) => horizon.grow(positions.as_given()),
        #[cfg(feature = "wasm")]
        Cloud::Hyper(_) => Ok(()),
    }))
}
