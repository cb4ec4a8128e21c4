//! What JavaScript receives: the answer of a query, or an error. JavaScript puts the numbers into an error's message
//! (src/ts/instance/engine.ts): to format them here would add 30 kB of wasm.

use serde::{Serialize, Serializer};
use wasm_bindgen::JsValue;

use crate::base::error::Message;
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

/// The number does not belong to a cloud, or its cloud was freed.
#[cold]
pub(super) fn disposed() -> JsValue {
    let message = Message {
        text: "this cloud has been disposed of",
        words: [""; 2],
        numbers: [0.0; 3],
    };
    failure("disposed", &message)
}

fn failure(code: &str, message: &Message) -> JsValue {
    let [first, second] = message.words;
    object(&[
        ("code", &code.into()),
        ("text", &message.text.into()),
        ("first", &first.into()),
        ("second", &second.into()),
        ("numbers", &list(&message.numbers)),
    ])
}

impl From<Error> for JsValue {
    #[cold]
    #[inline(never)]
    fn from(error: Error) -> Self {
        failure(error.code(), &error.message())
    }
}

#[inline(never)]
pub(super) fn object(fields: &[(&str, &JsValue)]) -> JsValue {
    struct Kept<'a>(&'a JsValue);
    impl Serialize for Kept<'_> {
        fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
            serde_wasm_bindgen::preserve::serialize(self.0, serializer)
        }
    }
    named(fields.iter().map(|&(name, value)| (name, Kept(value))))
}

/// An object whose fields are numbers.
#[inline(never)]
pub(super) fn numbered(fields: &[(&str, f64)]) -> JsValue {
    named(fields.iter().copied())
}

/// A list of numbers.
#[inline(never)]
pub(super) fn list(numbers: &[f64]) -> JsValue {
    serde_wasm_bindgen::to_value(numbers).unwrap_or_else(JsValue::from)
}

fn named<'a>(fields: impl Iterator<Item = (&'a str, impl Serialize)>) -> JsValue {
    let serializer = serde_wasm_bindgen::Serializer::new().serialize_maps_as_objects(true);
    serializer.collect_map(fields).unwrap_or_else(JsValue::from)
}
