//! JavaScript objects, made field by field.

use serde::{Serialize, Serializer};
use wasm_bindgen::prelude::*;

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
