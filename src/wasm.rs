//! The JavaScript bindings: check, copy in, call, copy out, map errors.
//!
//! Clouds stay on this side and JavaScript holds a number for each, so that a
//! number from an instance that was given up can never free memory of the next
//! one. Typed arrays arrive as JavaScript objects, never as `&[f32]`: the glue
//! would copy those before any code here runs, and trap where memory is refused.

mod answer;
mod clouds;
mod failure;
mod formulas;
mod hyperspace;
mod options;
mod outputs;
mod transfer;
mod views;

use alloc::boxed::Box;
use alloc::string::ToString;
use std::panic;

use js_sys::{Float32Array, Float64Array, Function, Uint32Array};
use serde::Serialize;
use serde_wasm_bindgen::Serializer;
use wasm_bindgen::prelude::*;

use self::clouds::{Cloud, change_any, created, resized};
use self::failure::Failure;
use self::options::ViewOptions;
use self::transfer::{copy_in_integers, copy_out, doubles, singles};
use crate::merge::merge;
use crate::points::Points;
use crate::{Error, NonFinite, PointCloud};

#[wasm_bindgen]
extern "C" {
    /// Chosen by the caller and checked on the JavaScript side.
    #[wasm_bindgen(typescript_type = "CloudOptions")]
    pub type CloudOptions;
    #[wasm_bindgen(method, getter, js_name = skipNonFinite)]
    fn skip_non_finite(this: &CloudOptions) -> bool;
    /// Told which share of the building is done.
    #[wasm_bindgen(method, getter)]
    fn progress(this: &CloudOptions) -> Option<Function>;
}

/// Runs once for each instance: a panic says what happened before it traps.
#[wasm_bindgen(start)]
fn start() {
    panic::set_hook(Box::new(|info| {
        web_sys::console::error_1(&info.to_string().into());
    }));
}

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
        Cloud::Hyper(cloud) => cloud.remove(&indices),
    }))
}

/// The ids of what is visible among single-precision positions, one id for each.
#[wasm_bindgen(js_name = mergeVisibleF32)]
pub fn merge_visible_f32(
    positions: &Float32Array,
    ids: &Uint32Array,
    x: f64,
    y: f64,
    z: f64,
    options: &ViewOptions,
) -> Result<Uint32Array, JsValue> {
    merge_visible(singles(positions), ids, [x, y, z], options)
}

/// The ids of what is visible among double-precision positions, one id for each.
#[wasm_bindgen(js_name = mergeVisibleF64)]
pub fn merge_visible_f64(
    positions: &Float64Array,
    ids: &Uint32Array,
    x: f64,
    y: f64,
    z: f64,
    options: &ViewOptions,
) -> Result<Uint32Array, JsValue> {
    merge_visible(doubles(positions), ids, [x, y, z], options)
}

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &str = r#"
/** Makes all of the functions below call into this instance. */
export function __wbg_set_wasm(exports: WebAssembly.Exports): void;
interface CloudOptions { skipNonFinite: boolean; progress?: ((share: number) => void) | undefined }
interface CloudSize { length: number; skipped: number; spacing: number }
interface CloudInfo extends CloudSize { handle: number }
/** ViewSettings of options.ts. */
interface ViewOptions {
  rule: number;
  size: number;
  kernel: number;
  parameter: number;
  denoise: number;
  vote: number;
  /** Makes room for so many indices of an answer. */
  memory: (length: number) => Uint32Array<ArrayBuffer>;
}
interface ChosenRadius { radius: number; exponent: number; evaluations: number }
interface Answer extends ChosenRadius {
  indices: Uint32Array<ArrayBuffer>;
  triangles: Uint32Array<ArrayBuffer>;
  scale: number;
}
"#;

fn non_finite(options: &CloudOptions) -> NonFinite {
    if options.skip_non_finite() {
        NonFinite::Skip
    } else {
        NonFinite::Error
    }
}

fn create_cloud(
    positions: Result<Points, Error>,
    options: &CloudOptions,
) -> Result<JsValue, JsValue> {
    let non_finite = non_finite(options);
    let listener = options.progress();
    let mut progress = |share: f64| {
        if let Some(listener) = &listener {
            // It posts a message, which does not throw.
            let _ = listener.call1(&JsValue::UNDEFINED, &share.into());
        }
    };
    created(positions.and_then(|positions| {
        let cloud = PointCloud::prepare(positions.as_given(), non_finite, &mut progress)?;
        Ok(Cloud::Space(cloud))
    }))
}

fn append(handle: u32, positions: Result<Points, Error>) -> Result<JsValue, JsValue> {
    let positions = positions.map_err(Failure::from)?;
    resized(change_any(handle, &mut |cloud| match cloud {
        Cloud::Space(cloud) => cloud.add(positions.as_given()),
        Cloud::Hyper(_) => Ok(()),
    }))
}

fn merge_visible(
    positions: Result<Points, Error>,
    ids: &Uint32Array,
    viewpoint: [f64; 3],
    options: &ViewOptions,
) -> Result<Uint32Array, JsValue> {
    let view = options.read();
    let merged = positions.and_then(|positions| {
        let ids = copy_in_integers(ids)?;
        let part = |_| (positions.as_given(), &ids[..]);
        let seen = merge(1, &part, viewpoint, &view)?;
        copy_out(&seen, options)
    });
    Ok(merged.map_err(Failure::from)?)
}

fn to_js(value: &impl Serialize) -> JsValue {
    /// Flattened, a struct is written as a map of names. As a struct, serde-wasm-bindgen
    /// would look for its names in a hash map, and the wasm be 0.8 kB larger.
    #[derive(Serialize)]
    struct Object<T> {
        #[serde(flatten)]
        fields: T,
    }
    let serializer = Serializer::new().serialize_maps_as_objects(true);
    let object = Object { fields: value };
    object.serialize(&serializer).unwrap_or_else(JsValue::from)
}
