//! Structs as JavaScript objects.

use serde::Serialize;
use serde_wasm_bindgen::Serializer;
use wasm_bindgen::prelude::*;

pub(super) fn to_js(value: &impl Serialize) -> JsValue {
    /// `flatten` writes a struct as a map of names. Otherwise serde-wasm-bindgen keeps names in a
    /// hash map, and the wasm is 0.8 kB larger.
    #[derive(Serialize)]
    struct Object<T> {
        #[serde(flatten)]
        fields: T,
    }
    let serializer = Serializer::new().serialize_maps_as_objects(true);
    let object = Object { fields: value };
    object.serialize(&serializer).unwrap_or_else(JsValue::from)
}
