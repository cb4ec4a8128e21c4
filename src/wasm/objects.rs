//! Structs as JavaScript objects.

use serde::Serialize;
use serde_wasm_bindgen::Serializer;
use wasm_bindgen::prelude::*;

pub(super) fn to_js(value: &impl Serialize) -> JsValue {
    /// Flattened, a struct is written as a map of names. As a struct, serde-wasm-bindgen
    /// would look for its names in a hash map, and the wasm be 0.8 kB larger.
    #[derive(Serialize)]
    struct Object<T> {
        #[serde(flatten)]
        fields: T,
    }
    let serializer = Serializer::new().serialize_maps_as_objects(true);
    let object = Object { fields: value };
    object.serialize(&serializer).unwrap_or_else(JsValue::from)
}
