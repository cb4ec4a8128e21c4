//! Objects that JavaScript receives. They are written field by field: with serde, the wasm is 3.5 kB
//! larger.

use js_sys::Array;
use wasm_bindgen::prelude::*;

#[wasm_bindgen]
extern "C" {
    /// A plain object.
    #[wasm_bindgen(js_name = Object)]
    pub(super) type Fields;
    #[wasm_bindgen(constructor, js_class = "Object")]
    pub(super) fn new() -> Fields;
    #[wasm_bindgen(method, structural, indexing_setter)]
    fn put(this: &Fields, name: &str, value: &JsValue);
    #[wasm_bindgen(method, structural, indexing_setter)]
    pub(super) fn number(this: &Fields, name: &str, value: f64);
    #[wasm_bindgen(method, structural, indexing_setter)]
    pub(super) fn text(this: &Fields, name: &str, value: &str);
}

impl Fields {
    pub(super) fn set(&self, name: &str, value: impl AsRef<JsValue>) {
        self.put(name, value.as_ref());
    }

    /// A list of numbers.
    pub(super) fn numbers(&self, name: &str, numbers: &[f64]) {
        let list = Array::new();
        for &number in numbers {
            list.push(&number.into());
        }
        self.set(name, list);
    }
}
