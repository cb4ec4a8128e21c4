//! JavaScript objects, made field by field.

use wasm_bindgen::prelude::*;

#[wasm_bindgen]
extern "C" {
    #[wasm_bindgen(js_name = Object)]
    type Fields;
    #[wasm_bindgen(constructor, js_class = "Object")]
    fn new() -> Fields;
    #[wasm_bindgen(method, structural, indexing_setter)]
    fn set(this: &Fields, name: &str, value: &JsValue);
}

#[inline(never)]
pub(super) fn object(fields: &[(&str, &JsValue)]) -> JsValue {
    let object = Fields::new();
    for (name, value) in fields {
        object.set(name, value);
    }
    object.into()
}

/// An object whose fields are numbers.
#[inline(never)]
pub(super) fn numbered(fields: &[(&str, f64)]) -> JsValue {
    let object = Fields::new();
    for (name, value) in fields {
        object.set(name, &(*value).into());
    }
    object.into()
}

/// A list of numbers.
#[inline(never)]
pub(super) fn list(numbers: &[f64]) -> JsValue {
    numbers
        .iter()
        .map(|&number| JsValue::from(number))
        .collect::<js_sys::Array>()
        .into()
}
