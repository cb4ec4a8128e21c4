//! Clouds of four and more dimensions, whose viewpoints are lists of numbers.

use alloc::boxed::Box;
use alloc::vec::Vec;

use js_sys::Float64Array;
use wasm_bindgen::prelude::*;

use crate::PointCloudNd;
use crate::base::allocation::with_capacity;
use crate::wasm::answer::{answered, chosen, refused};
use crate::wasm::cloud_options::{CloudOptions, non_finite};
use crate::wasm::clouds::{Cloud, change_any, created, resized, with_hyper};
use crate::wasm::options::ViewOptions;
use crate::wasm::transfer::numbers;

/// A cloud of `dimension` numbers a point.
#[wasm_bindgen(js_name = createHyperCloud, unchecked_return_type = "CloudInfo")]
pub fn create(
    positions: &Float64Array,
    dimension: u32,
    options: &CloudOptions,
) -> Result<JsValue, JsValue> {
    let non_finite = non_finite(options);
    created(numbers(positions).and_then(|positions| {
        let cloud = PointCloudNd::with_non_finite(dimension as usize, &positions, non_finite)?;
        Ok(Cloud::Hyper(Box::new(cloud)))
    }))
}

/// Adds points to a cloud of four or more dimensions.
#[wasm_bindgen(js_name = appendHyper, unchecked_return_type = "CloudSize")]
pub fn append(handle: u32, positions: &Float64Array) -> Result<JsValue, JsValue> {
    let positions = numbers(positions).map_err(refused)?;
    resized(change_any(handle, &mut |cloud| match cloud {
        Cloud::Space(_) | Cloud::Horizon(_) => Ok(()),
        Cloud::Hyper(cloud) => cloud.append(&positions),
    }))
}

/// Which points are visible from at least `k` of the viewpoints, one after another?
#[wasm_bindgen(js_name = hyperVisibleFrom, unchecked_return_type = "Answer")]
pub fn visible_from(
    handle: u32,
    viewpoints: &Float64Array,
    k: u32,
    options: &ViewOptions,
) -> Result<JsValue, JsValue> {
    let view = options.read();
    let seen = with_hyper(handle, |cloud| {
        let viewpoints = numbers(viewpoints)?;
        let mut rows: Vec<&[f64]> = with_capacity(viewpoints.len() / cloud.dimension())?;
        rows.extend(viewpoints.chunks_exact(cloud.dimension()));
        if rows.is_empty() {
            cloud.visible_from_any(&rows, &view)
        } else {
            cloud.visible_from_at_least(k as usize, &rows, &view)
        }
    });
    answered(seen, options)
}

/// The radius that the rule of `options` chooses for a viewpoint.
#[wasm_bindgen(js_name = hyperAutoRadius, unchecked_return_type = "ChosenRadius")]
pub fn auto_radius(
    handle: u32,
    viewpoint: &Float64Array,
    options: &ViewOptions,
) -> Result<JsValue, JsValue> {
    let rule = options.read_radius();
    chosen(with_hyper(handle, |cloud| {
        cloud.auto_radius(&numbers(viewpoint)?, rule)
    }))
}
