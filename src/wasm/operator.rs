//! What both modules have: clouds in space and their changes, the operator, and its radius.

use alloc::boxed::Box;

use js_sys::Uint32Array;
#[cfg(feature = "wasm")]
use wasm_bindgen::JsCast;
use wasm_bindgen::prelude::*;

use crate::PointCloud;
use crate::base::FULL;
use crate::hull::Memory;
use crate::view::refusals::QuestionKind;
use crate::wasm::answer::{answered, chosen};
use crate::wasm::clouds::{Cloud, change_any, created, with_cloud, with_memory};
#[cfg(feature = "wasm")]
use crate::wasm::higher::hyper_cloud;
use crate::wasm::options::{CloudOptions, ViewOptions};
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
    let non_finite = options.non_finite();
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
        #[cfg(feature = "wasm")]
        _ => Ok(()),
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
        _ => Ok(()),
    })
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
    let view = options.read();
    if FULL {
        return answered(with_memory(
            handle,
            [x, y, z],
            options,
            &view,
            |cloud, memory| cloud.visible_from_with(memory, [x, y, z], &view),
        ));
    }
    // The operator alone goes on from no slice. New room takes at most 2 % longer.
    answered(with_cloud(handle, |cloud| {
        view.check(QuestionKind::View)?;
        cloud.seen_by_hull(&mut Memory::new(), [x, y, z], &view)
    }))
}

/// The radius that the rule of `options` chooses for (x, y, z).
#[wasm_bindgen(js_name = autoRadius, unchecked_return_type = "ChosenRadius")]
pub fn auto_radius(
    handle: u32,
    x: f64,
    y: f64,
    z: f64,
    options: &ViewOptions,
) -> Result<JsValue, JsValue> {
    let rule = options.read().radius;
    chosen(with_cloud(handle, |cloud| {
        cloud.auto_radius([x, y, z], rule)
    }))
}
