//! The answer of a query, as JavaScript receives it. All numbers are doubles, because the code
//! that writes a field is compiled for each type.

use js_sys::{Float32Array, Uint32Array};
use serde::Serialize;
use wasm_bindgen::prelude::*;

#[cfg(feature = "wasm")]
use crate::Error;
use crate::wasm::failure::Failure;
use crate::wasm::objects::to_js;
use crate::wasm::options::ViewOptions;
use crate::wasm::transfer::{copy_out, copy_out_singles};
use crate::{ChosenRadius, Exponential, Inversion, Visibility};

#[derive(Serialize)]
struct Answer {
    #[serde(with = "serde_wasm_bindgen::preserve")]
    indices: Uint32Array,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    triangles: Uint32Array,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    scores: Float32Array,
    radius: f64,
    exponent: f64,
    evaluations: f64,
    /// 1 or 0.
    exact: f64,
    /// The scale c of the exponential inversion or of each look, given or chosen; otherwise 0.
    scales: [f64; 3],
}

/// An answer with the triangles between its points, if it has any.
pub(super) fn answer(
    visibility: &Visibility,
    triangles: &[u32],
    options: &ViewOptions,
) -> Result<JsValue, Failure> {
    let mut scales = [0.0; 3];
    match visibility.inversion() {
        Inversion::Exponential(Exponential::Scale(scale)) => scales[0] = scale,
        _ => (scales.iter_mut().zip(visibility.looks())).for_each(|(to, from)| *to = *from),
    }
    Ok(to_js(&Answer {
        indices: copy_out(visibility.indices(), options)?,
        triangles: copy_out(triangles, options)?,
        scores: copy_out_singles(visibility.scores(), options)?,
        radius: visibility.radius(),
        exponent: visibility.exponent(),
        evaluations: f64::from(visibility.evaluations()),
        exact: f64::from(u8::from(visibility.exact())),
        scales,
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

#[cfg(feature = "wasm")]
#[cold]
pub(super) fn refused(error: Error) -> JsValue {
    Failure::from(error).into()
}
