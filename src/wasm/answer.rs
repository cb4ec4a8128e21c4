//! The answer of a query, as JavaScript receives it.

use wasm_bindgen::prelude::*;

use crate::wasm::objects::{list, numbered, object};
use crate::wasm::transfer::{copy_out, copy_out_singles};
use crate::{ChosenRadius, Error, Exponential, Inversion, Visibility};

/// An answer with the triangles between its points, if it has any.
pub(super) fn answer(visibility: &Visibility, triangles: &[u32]) -> Result<JsValue, Error> {
    let mut scales = [0.0; 3];
    match visibility.inversion() {
        Inversion::Exponential(Exponential::Scale(scale)) => scales[0] = scale,
        _ => (scales.iter_mut().zip(visibility.looks())).for_each(|(to, from)| *to = *from),
    }
    Ok(object(&[
        ("indices", &copy_out(visibility.indices())?.into()),
        ("triangles", &copy_out(triangles)?.into()),
        ("scores", &copy_out_singles(visibility.scores())?.into()),
        ("radius", &visibility.radius().into()),
        ("exponent", &visibility.exponent().into()),
        ("evaluations", &visibility.evaluations().into()),
        ("exact", &f64::from(u8::from(visibility.exact())).into()),
        // The scale c of the exponential inversion or of each look, given or chosen; otherwise 0.
        ("scales", &list(&scales)),
    ]))
}

/// The answer to a query that was not refused.
pub(super) fn answered(visibility: Result<Visibility, JsValue>) -> Result<JsValue, JsValue> {
    Ok(answer(&visibility?, &[])?)
}

pub(super) fn chosen(chosen: Result<ChosenRadius, JsValue>) -> Result<JsValue, JsValue> {
    let chosen = chosen?;
    Ok(numbered(&[
        ("radius", chosen.radius),
        ("exponent", chosen.exponent),
        ("evaluations", f64::from(chosen.evaluations)),
    ]))
}
