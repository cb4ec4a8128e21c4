//! What a query answers, as JavaScript receives it.

use wasm_bindgen::prelude::*;

use super::failure::Failure;
use super::options::ViewOptions;
use super::record::record;
use super::transfer::copy_out;
use crate::{ChosenRadius, Error, Exponential, Inversion, Visibility};

/// An answer with the triangles between its points, if it has any.
pub(super) fn answer(
    visibility: &Visibility,
    triangles: &[[u32; 3]],
    options: &ViewOptions,
) -> Result<JsValue, Failure> {
    // c of the exponential inversion, which may have been chosen.
    let scale = match visibility.inversion() {
        Inversion::Exponential(Exponential::Scale(scale)) => scale,
        _ => 0.0,
    };
    let answer = record(&[
        ("radius", visibility.radius()),
        ("exponent", visibility.exponent()),
        ("evaluations", f64::from(visibility.evaluations())),
        ("scale", scale),
    ]);
    answer.set_array("indices", &copy_out(visibility.indices(), options)?);
    answer.set_array("triangles", &copy_out(triangles.as_flattened(), options)?);
    Ok(answer.into())
}

/// The answer to a query that was not refused.
pub(super) fn answered(
    visibility: Result<Visibility, Failure>,
    options: &ViewOptions,
) -> Result<JsValue, JsValue> {
    Ok(visibility.and_then(|visibility| answer(&visibility, &[], options))?)
}

pub(super) fn chosen(chosen: Result<ChosenRadius, Failure>) -> Result<JsValue, JsValue> {
    let chosen = chosen?;
    let chosen = record(&[
        ("radius", chosen.radius),
        ("exponent", chosen.exponent),
        ("evaluations", f64::from(chosen.evaluations)),
    ]);
    Ok(chosen.into())
}

#[cold]
pub(super) fn refused(error: Error) -> JsValue {
    Failure::from(error).into()
}
