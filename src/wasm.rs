//! The JavaScript bindings: check, copy in, call, copy out, map errors.
//!
//! Clouds stay on this side and JavaScript holds a number for each, so that a
//! number from an instance that was given up can never free memory of the next
//! one. Typed arrays arrive as JavaScript objects, never as `&[f32]`: the glue
//! would copy those before any code here runs, and trap where memory is refused.

mod transfer;

use alloc::boxed::Box;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use core::cell::RefCell;
use std::panic;
use std::thread_local;

use js_sys::{Float32Array, Float64Array, Uint32Array};
use serde::{Deserialize, Serialize};
use wasm_bindgen::prelude::*;

use self::transfer::{copy_in, copy_in_integers, copy_out, doubles, singles};
use crate::{Error, NonFinite, Options, PointCloud, Position, Radius, merge_visible};

thread_local! {
    static CLOUDS: RefCell<Vec<Option<PointCloud>>> = const { RefCell::new(Vec::new()) };
}

/// What JavaScript receives as an exception: the fields of an `HprError`.
#[derive(Serialize)]
struct Failure {
    code: &'static str,
    message: String,
}

impl Failure {
    /// A number that names no cloud (any more).
    fn disposed() -> Self {
        Self {
            code: "disposed",
            message: "this cloud has been disposed of".to_string(),
        }
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        Self {
            code: error.code(),
            message: error.to_string(),
        }
    }
}

/// JavaScript checks options before it passes them on; what it let through is refused here.
impl From<serde_wasm_bindgen::Error> for Failure {
    fn from(error: serde_wasm_bindgen::Error) -> Self {
        Self {
            code: "option",
            message: error.to_string(),
        }
    }
}

impl From<Failure> for JsValue {
    fn from(failure: Failure) -> Self {
        to_js(&failure)
    }
}

/// Chosen by the caller and checked for type on the JavaScript side.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct CloudOptions {
    stride: usize,
    skip_non_finite: bool,
}

/// At most one of the two; neither is `Radius::Auto`.
#[derive(Deserialize)]
struct ViewOptions {
    radius: Option<f64>,
    exponent: Option<f64>,
}

#[derive(Serialize)]
struct CloudInfo {
    handle: u32,
    length: usize,
    skipped: usize,
}

#[derive(Serialize)]
struct CloudSize {
    length: usize,
    skipped: usize,
}

#[derive(Serialize)]
struct Answer {
    #[serde(with = "serde_wasm_bindgen::preserve")]
    indices: Uint32Array,
    radius: f64,
    exponent: f64,
    evaluations: u32,
}

#[derive(Serialize)]
struct ChosenRadius {
    radius: f64,
    exponent: f64,
    evaluations: u32,
}

/// Runs once for each instance: a panic says what happened before it traps.
#[wasm_bindgen(start)]
fn start() {
    panic::set_hook(Box::new(|info| {
        web_sys::console::error_1(&info.to_string().into());
    }));
}

/// A cloud of single-precision positions, kept in single precision.
#[wasm_bindgen(js_name = createCloudF32, unchecked_return_type = "CloudInfo")]
pub fn create_cloud_f32(
    positions: &Float32Array,
    #[wasm_bindgen(unchecked_param_type = "CloudOptions")] options: JsValue,
) -> Result<JsValue, JsValue> {
    create_cloud(positions.length(), options, singles(positions))
}

/// A cloud of double-precision positions.
#[wasm_bindgen(js_name = createCloudF64, unchecked_return_type = "CloudInfo")]
pub fn create_cloud_f64(
    positions: &Float64Array,
    #[wasm_bindgen(unchecked_param_type = "CloudOptions")] options: JsValue,
) -> Result<JsValue, JsValue> {
    create_cloud(positions.length(), options, doubles(positions))
}

/// Adds single-precision points to a cloud of any precision.
#[wasm_bindgen(js_name = appendF32, unchecked_return_type = "CloudSize")]
pub fn append_f32(
    handle: u32,
    positions: &Float32Array,
    stride: usize,
) -> Result<JsValue, JsValue> {
    append(handle, positions.length(), stride, singles(positions))
}

/// Adds double-precision points to a cloud of any precision.
#[wasm_bindgen(js_name = appendF64, unchecked_return_type = "CloudSize")]
pub fn append_f64(
    handle: u32,
    positions: &Float64Array,
    stride: usize,
) -> Result<JsValue, JsValue> {
    append(handle, positions.length(), stride, doubles(positions))
}

/// Removes points from a cloud by their indices.
#[wasm_bindgen]
pub fn remove(handle: u32, indices: &Uint32Array) -> Result<(), JsValue> {
    let indices = copy_in_integers(indices).map_err(Failure::from)?;
    Ok(change_cloud(handle, |cloud| cloud.remove(&indices))?)
}

/// The ids of what is visible among single-precision positions, one id for each.
#[wasm_bindgen(js_name = mergeVisibleF32)]
pub fn merge_visible_f32(
    positions: &Float32Array,
    ids: &Uint32Array,
    x: f64,
    y: f64,
    z: f64,
    radius: f64,
) -> Result<Uint32Array, JsValue> {
    let block = singles(positions);
    merge(positions.length(), block, ids, [x, y, z], radius)
}

/// The ids of what is visible among double-precision positions, one id for each.
#[wasm_bindgen(js_name = mergeVisibleF64)]
pub fn merge_visible_f64(
    positions: &Float64Array,
    ids: &Uint32Array,
    x: f64,
    y: f64,
    z: f64,
    radius: f64,
) -> Result<Uint32Array, JsValue> {
    let block = doubles(positions);
    merge(positions.length(), block, ids, [x, y, z], radius)
}

/// Frees a cloud; its number may be given to another one afterwards.
#[wasm_bindgen(js_name = freeCloud)]
pub fn free_cloud(handle: u32) {
    CLOUDS.with_borrow_mut(|clouds| {
        if let Some(slot) = clouds.get_mut(handle as usize) {
            *slot = None;
        }
    });
}

/// Which points are visible from (x, y, z)?
#[wasm_bindgen(js_name = visibleFrom, unchecked_return_type = "Answer")]
pub fn visible_from(
    handle: u32,
    x: f64,
    y: f64,
    z: f64,
    #[wasm_bindgen(unchecked_param_type = "ViewOptions")] options: JsValue,
) -> Result<JsValue, JsValue> {
    let options: ViewOptions = serde_wasm_bindgen::from_value(options).map_err(Failure::from)?;
    let radius = match (options.radius, options.exponent) {
        (Some(radius), _) => Radius::Absolute(radius),
        (None, Some(exponent)) => Radius::Exponent(exponent),
        (None, None) => Radius::Auto,
    };
    let visibility = with_cloud(handle, |cloud| {
        let options = Options {
            radius,
            ..Options::default()
        };
        cloud.visible_from([x, y, z], &options)
    })?;
    Ok(to_js(&Answer {
        indices: copy_out(visibility.indices()).map_err(Failure::from)?,
        radius: visibility.radius(),
        exponent: visibility.exponent(),
        evaluations: visibility.evaluations(),
    }))
}

/// The radius that `visibleFrom` chooses by itself for (x, y, z).
#[wasm_bindgen(js_name = autoRadius, unchecked_return_type = "ChosenRadius")]
pub fn auto_radius(handle: u32, x: f64, y: f64, z: f64) -> Result<JsValue, JsValue> {
    let chosen = with_cloud(handle, |cloud| cloud.auto_radius([x, y, z], Radius::Auto))?;
    Ok(to_js(&ChosenRadius {
        radius: chosen.radius,
        exponent: chosen.exponent,
        evaluations: chosen.evaluations,
    }))
}

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &str = r#"
/** Makes all of the functions below call into this instance. */
export function __wbg_set_wasm(exports: WebAssembly.Exports): void;
interface CloudOptions { stride: number; skipNonFinite: boolean }
interface CloudSize { length: number; skipped: number }
interface CloudInfo extends CloudSize { handle: number }
interface ViewOptions { radius: number | undefined; exponent: number | undefined }
interface ChosenRadius { radius: number; exponent: number; evaluations: number }
interface Answer extends ChosenRadius { indices: Uint32Array }
"#;

fn create_cloud<T: Copy + Default>(
    length: u32,
    options: JsValue,
    copy_block: impl Fn(u32, &mut [T]),
) -> Result<JsValue, JsValue>
where
    [T; 3]: Position,
{
    let options: CloudOptions = serde_wasm_bindgen::from_value(options).map_err(Failure::from)?;
    let non_finite = if options.skip_non_finite {
        NonFinite::Skip
    } else {
        NonFinite::Error
    };
    let positions = copy_in(length as usize, options.stride, copy_block).map_err(Failure::from)?;
    let cloud = PointCloud::with_non_finite(&positions, non_finite).map_err(Failure::from)?;
    let (length, skipped) = (cloud.len(), cloud.skipped());
    let handle = keep(cloud).map_err(Failure::from)?;
    Ok(to_js(&CloudInfo {
        handle,
        length,
        skipped,
    }))
}

fn append<T: Copy + Default>(
    handle: u32,
    length: u32,
    stride: usize,
    copy_block: impl Fn(u32, &mut [T]),
) -> Result<JsValue, JsValue>
where
    [T; 3]: Position,
{
    let positions = copy_in(length as usize, stride, copy_block).map_err(Failure::from)?;
    let size = change_cloud(handle, |cloud| {
        cloud.append(&positions)?;
        Ok(CloudSize {
            length: cloud.len(),
            skipped: cloud.skipped(),
        })
    })?;
    Ok(to_js(&size))
}

fn merge<T: Copy + Default>(
    length: u32,
    copy_block: impl Fn(u32, &mut [T]),
    ids: &Uint32Array,
    viewpoint: [f64; 3],
    radius: f64,
) -> Result<Uint32Array, JsValue>
where
    [T; 3]: Position,
{
    let positions = copy_in(length as usize, 3, copy_block).map_err(Failure::from)?;
    let ids = copy_in_integers(ids).map_err(Failure::from)?;
    let options = Options::with_radius(radius);
    let seen = merge_visible(&[(&positions, &ids)], viewpoint, &options).map_err(Failure::from)?;
    Ok(copy_out(&seen).map_err(Failure::from)?)
}

fn keep(cloud: PointCloud) -> Result<u32, Error> {
    CLOUDS.with_borrow_mut(|clouds| {
        let free = clouds.iter().position(Option::is_none);
        let slot = free.unwrap_or(clouds.len());
        if free.is_none() {
            clouds.try_reserve(1)?;
            clouds.push(None);
        }
        clouds[slot] = Some(cloud);
        Ok(slot as u32)
    })
}

fn with_cloud<T>(
    handle: u32,
    query: impl FnOnce(&PointCloud) -> Result<T, Error>,
) -> Result<T, Failure> {
    CLOUDS.with_borrow(|clouds| {
        let cloud = clouds.get(handle as usize).and_then(Option::as_ref);
        query(cloud.ok_or_else(Failure::disposed)?).map_err(Failure::from)
    })
}

fn change_cloud<T>(
    handle: u32,
    change: impl FnOnce(&mut PointCloud) -> Result<T, Error>,
) -> Result<T, Failure> {
    CLOUDS.with_borrow_mut(|clouds| {
        let cloud = clouds.get_mut(handle as usize).and_then(Option::as_mut);
        change(cloud.ok_or_else(Failure::disposed)?).map_err(Failure::from)
    })
}

fn to_js(value: &impl Serialize) -> JsValue {
    serde_wasm_bindgen::to_value(value).unwrap_or_else(JsValue::from)
}
