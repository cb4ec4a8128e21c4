//! The answer of a query, as JavaScript receives it. All numbers are doubles, because the code
//! that writes a field is compiled for each type.

use js_sys::Uint32Array;
use serde::Serialize;
use wasm_bindgen::prelude::*;

use super::failure::Failure;
use super::objects::to_js;
use super::options::ViewOptions;
use super::transfer::copy_out;
use crate::{ChosenRadius, Error, Exponential, Inversion, Visibility};

#[derive(Serialize)]
struct Answer {
    #[serde(with = "serde_wasm_bindgen::preserve")]
    indices: Uint32Array,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    triangles: Uint32Array,
    radius: f64,
    exponent: f64,
    evaluations: f64,
    /// c of the exponential inversion, as given or as chosen; otherwise 0.
    scale: f64,
}

/// An answer with the triangles between its points, if it has any.
pub(super) fn answer(
    visibility: &Visibility,
    triangles: &[[u32; 3]],
    options: &ViewOptions,
) -> Result<JsValue, Failure> {
    let scale = match visibility.inversion() {
        Inversion::Exponential(Exponential::Scale(scale)) => scale,
        _ => 0.0,
    };
    Ok(to_js(&Answer {
        indices: copy_out(visibility.indices(), options)?,
        triangles: copy_out(triangles.as_flattened(), options)?,
        radius: visibility.radius(),
        exponent: visibility.exponent(),
        evaluations: f64::from(visibility.evaluations()),
        scale,
    }))
}

/// The answer to a query that was not refused.
pub(super) fn answered(
    visibility: Result<Visibility, Failure>,
    options: &ViewOptions,
) -> Result<JsValue, JsValue> {
    Ok(visibility.and_then(|visibility| answer(&visibility, &[], options))?)
}

#[derive(Serialize)]
struct Chosen {
    radius: f64,
    exponent: f64,
    evaluations: f64,
}

pub(super) fn chosen(chosen: Result<ChosenRadius, Failure>) -> Result<JsValue, JsValue> {
    let chosen = chosen?;
    Ok(to_js(&Chosen {
        radius: chosen.radius,
        exponent: chosen.exponent,
        evaluations: f64::from(chosen.evaluations),
    }))
}

#[cold]
pub(super) fn refused(error: Error) -> JsValue {
    Failure::from(error).into()
}
