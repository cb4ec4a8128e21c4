//! The JavaScript bindings: check, copy in, call, copy out, map errors.
//!
//! Clouds stay on this side and JavaScript holds a number for each, so that a
//! number from an instance that was given up can never free memory of the next
//! one. Typed arrays arrive as JavaScript objects, never as `&[f32]`: the glue
//! would copy those before any code here runs, and trap where memory is refused.

mod failure;
mod sector;
mod transfer;

use alloc::boxed::Box;
use alloc::string::ToString;
use alloc::vec::Vec;
use core::cell::RefCell;
use std::panic;
use std::thread_local;

use js_sys::{Float32Array, Float64Array, Uint32Array};
use serde::Serialize;
use serde_wasm_bindgen::Serializer;
use wasm_bindgen::prelude::*;

use self::failure::Failure;
use self::transfer::{copy_in_integers, copy_out, doubles, singles};
use crate::hull::Memory;
use crate::merge::merge;
use crate::points::Points;
use crate::{Error, NonFinite, Options, PointCloud, Radius};

thread_local! {
    static CLOUDS: RefCell<Vec<Option<PointCloud>>> = const { RefCell::new(Vec::new()) };
    static LAST_VIEW: RefCell<Option<LastView>> = const { RefCell::new(None) };
}

/// What the next view may start from: the last one's hull, and its room. One for all
/// clouds, so that many clouds need no more than one.
struct LastView {
    handle: u32,
    memory: Memory,
}

#[wasm_bindgen]
extern "C" {
    /// Chosen by the caller and checked on the JavaScript side. Read field by field:
    /// what serde says about a field of the wrong type brings the formatting of
    /// floats along, 30 kB.
    #[wasm_bindgen(typescript_type = "CloudOptions")]
    pub type CloudOptions;
    #[wasm_bindgen(method, getter, js_name = skipNonFinite)]
    fn skip_non_finite(this: &CloudOptions) -> bool;

    /// At most one of the two; neither is `Radius::Auto`.
    #[wasm_bindgen(typescript_type = "ViewOptions")]
    pub type ViewOptions;
    #[wasm_bindgen(method, getter)]
    fn radius(this: &ViewOptions) -> Option<f64>;
    #[wasm_bindgen(method, getter)]
    fn exponent(this: &ViewOptions) -> Option<f64>;
}

// What JavaScript is given holds doubles, as all of its numbers are: the code that
// writes a field is compiled once for each type.

#[derive(Serialize)]
struct CloudInfo {
    handle: f64,
    length: f64,
    skipped: f64,
}

#[derive(Serialize)]
struct CloudSize {
    length: f64,
    skipped: f64,
}

#[derive(Serialize)]
struct Answer {
    #[serde(with = "serde_wasm_bindgen::preserve")]
    indices: Uint32Array,
    radius: f64,
    exponent: f64,
    evaluations: f64,
}

#[derive(Serialize)]
struct ChosenRadius {
    radius: f64,
    exponent: f64,
    evaluations: f64,
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
    merge_visible(singles(positions), ids, [x, y, z], radius)
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
    merge_visible(doubles(positions), ids, [x, y, z], radius)
}

/// Frees a cloud; its number may be given to another one afterwards.
#[wasm_bindgen(js_name = freeCloud)]
pub fn free_cloud(handle: u32) {
    forget(handle);
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
    options: &ViewOptions,
) -> Result<JsValue, JsValue> {
    sector::visible_in_sector(handle, x, y, z, options, 0, 1)
}

/// The radius that `visibleFrom` chooses by itself for (x, y, z).
#[wasm_bindgen(js_name = autoRadius, unchecked_return_type = "ChosenRadius")]
pub fn auto_radius(handle: u32, x: f64, y: f64, z: f64) -> Result<JsValue, JsValue> {
    let chosen = with_cloud(handle, |cloud| cloud.auto_radius([x, y, z], Radius::Auto))?;
    Ok(to_js(&ChosenRadius {
        radius: chosen.radius,
        exponent: chosen.exponent,
        evaluations: f64::from(chosen.evaluations),
    }))
}

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &str = r#"
/** Makes all of the functions below call into this instance. */
export function __wbg_set_wasm(exports: WebAssembly.Exports): void;
interface CloudOptions { skipNonFinite: boolean }
interface CloudSize { length: number; skipped: number }
interface CloudInfo extends CloudSize { handle: number }
interface ViewOptions { radius: number | undefined; exponent: number | undefined }
interface ChosenRadius { radius: number; exponent: number; evaluations: number }
interface Answer extends ChosenRadius { indices: Uint32Array }
"#;

fn create_cloud(
    positions: Result<Points, Error>,
    options: &CloudOptions,
) -> Result<JsValue, JsValue> {
    let non_finite = if options.skip_non_finite() {
        NonFinite::Skip
    } else {
        NonFinite::Error
    };
    let made = positions.and_then(|positions| {
        let cloud = PointCloud::prepare(positions.as_given(), non_finite)?;
        let CloudSize { length, skipped } = size_of(&cloud);
        let handle = f64::from(keep(cloud)?);
        Ok(CloudInfo {
            handle,
            length,
            skipped,
        })
    });
    Ok(to_js(&made.map_err(Failure::from)?))
}

fn append(handle: u32, positions: Result<Points, Error>) -> Result<JsValue, JsValue> {
    let size = change_cloud(handle, |cloud| {
        cloud.add(positions?.as_given())?;
        Ok(size_of(cloud))
    })?;
    Ok(to_js(&size))
}

fn merge_visible(
    positions: Result<Points, Error>,
    ids: &Uint32Array,
    viewpoint: [f64; 3],
    radius: f64,
) -> Result<Uint32Array, JsValue> {
    let merged = positions.and_then(|positions| {
        let ids = copy_in_integers(ids)?;
        let part = |_| (positions.as_given(), &ids[..]);
        let seen = merge(1, &part, viewpoint, &Options::with_radius(radius))?;
        copy_out(&seen)
    });
    Ok(merged.map_err(Failure::from)?)
}

fn size_of(cloud: &PointCloud) -> CloudSize {
    CloudSize {
        length: cloud.len() as f64,
        skipped: cloud.skipped() as f64,
    }
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
        query(cloud.ok_or(Failure::DISPOSED)?).map_err(Failure::from)
    })
}

/// Runs `view` with the last view's memory, which knows nothing of other clouds.
fn with_memory<T>(handle: u32, view: impl FnOnce(&mut Memory) -> T) -> T {
    LAST_VIEW.with_borrow_mut(|last| {
        let last = last.get_or_insert_with(|| LastView {
            handle,
            memory: Memory::default(),
        });
        if last.handle != handle {
            last.memory.forget();
            last.handle = handle;
        }
        view(&mut last.memory)
    })
}

/// Gives back what is kept of the cloud's last view.
fn forget(handle: u32) {
    LAST_VIEW.with_borrow_mut(|last| {
        if last.as_ref().is_some_and(|last| last.handle == handle) {
            *last = None;
        }
    });
}

fn change_cloud<T>(
    handle: u32,
    change: impl FnOnce(&mut PointCloud) -> Result<T, Error>,
) -> Result<T, Failure> {
    forget(handle);
    CLOUDS.with_borrow_mut(|clouds| {
        let cloud = clouds.get_mut(handle as usize).and_then(Option::as_mut);
        change(cloud.ok_or(Failure::DISPOSED)?).map_err(Failure::from)
    })
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
