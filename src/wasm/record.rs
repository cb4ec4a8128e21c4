//! Plain objects for JavaScript, made field by field: all fields of one kind by one call.
//! Numbers are doubles, as its own are.

use js_sys::Uint32Array;
use wasm_bindgen::prelude::*;

#[wasm_bindgen]
extern "C" {
    #[wasm_bindgen(js_name = Object)]
    pub(super) type Record;
    #[wasm_bindgen(constructor, js_class = "Object")]
    fn new() -> Record;
    #[wasm_bindgen(method, indexing_setter)]
    fn set_number(this: &Record, name: &str, value: f64);
    #[wasm_bindgen(method, indexing_setter)]
    pub(super) fn set_text(this: &Record, name: &str, value: &str);
    #[wasm_bindgen(method, indexing_setter)]
    pub(super) fn set_array(this: &Record, name: &str, value: &Uint32Array);
}

#[inline(never)]
pub(super) fn record(numbers: &[(&str, f64)]) -> Record {
    let record = Record::new();
    for &(name, number) in numbers {
        record.set_number(name, number);
    }
    record
}
