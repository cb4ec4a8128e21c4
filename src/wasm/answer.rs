//! The answer of a query, as JavaScript receives it.

use wasm_bindgen::prelude::*;

use super::failure::Failure;
use super::objects::Fields;
use super::options::ViewOptions;
use super::transfer::{copy_out, copy_out_singles};
use crate::{ChosenRadius, Error, Exponential, Inversion, Visibility};

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
    let fields = Fields::new();
    fields.set("indices", copy_out(visibility.indices(), options)?);
    fields.set("triangles", copy_out(triangles, options)?);
    fields.set("scores", copy_out_singles(visibility.scores(), options)?);
    fields.number("radius", visibility.radius());
    fields.number("exponent", visibility.exponent());
    fields.number("evaluations", f64::from(visibility.evaluations()));
    fields.number("exact", f64::from(u8::from(visibility.exact())));
    fields.numbers("scales", &scales);
    Ok(fields.into())
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
    let fields = Fields::new();
    fields.number("radius", chosen.radius);
    fields.number("exponent", chosen.exponent);
    fields.number("evaluations", f64::from(chosen.evaluations));
    Ok(fields.into())
}

#[cold]
pub(super) fn refused(error: Error) -> JsValue {
    Failure::from(error).into()
}
