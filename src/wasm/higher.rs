//! Clouds of four and more dimensions, whose viewpoints are lists of numbers.

use alloc::boxed::Box;
use alloc::vec::Vec;

use js_sys::Float64Array;
use wasm_bindgen::JsCast;
use wasm_bindgen::prelude::*;

use crate::base::allocation::with_capacity;
use crate::wasm::answer::chosen;
use crate::wasm::clouds::{Cloud, with_hyper};
use crate::wasm::options::ViewOptions;
use crate::wasm::transfer::{Coordinates, numbers};
use crate::{Error, NonFinite, Options, PointCloudNd, Visibility};

/// A cloud of `dimension` numbers a point.
pub(super) fn hyper_cloud(
    positions: &Coordinates,
    dimension: usize,
    non_finite: NonFinite,
) -> Result<Cloud, Error> {
    let positions = numbers(positions.unchecked_ref())?;
    let cloud = PointCloudNd::with_non_finite(dimension, &positions, non_finite)?;
    Ok(Cloud::Hyper(Box::new(cloud)))
}

/// Which points are visible from at least `k` of the viewpoints, one after another?
pub(super) fn seen_from_several(
    cloud: &PointCloudNd,
    viewpoints: &Float64Array,
    k: usize,
    view: &Options,
) -> Result<Visibility, Error> {
    let viewpoints = numbers(viewpoints)?;
    let mut rows: Vec<&[f64]> = with_capacity(viewpoints.len() / cloud.dimension())?;
    rows.extend(viewpoints.chunks_exact(cloud.dimension()));
    if rows.is_empty() {
        cloud.visible_from_any(&rows, view)
    } else {
        cloud.visible_from_at_least(k, &rows, view)
    }
}

/// The radius that the rule of `options` chooses for a viewpoint.
#[wasm_bindgen(js_name = hyperAutoRadius, unchecked_return_type = "ChosenRadius")]
pub fn auto_radius(
    handle: u32,
    viewpoint: &Float64Array,
    options: &ViewOptions,
) -> Result<JsValue, JsValue> {
    let rule = options.read().radius;
    chosen(with_hyper(handle, |cloud| {
        cloud.auto_radius(&numbers(viewpoint)?, rule)
    }))
}
