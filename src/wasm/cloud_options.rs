//! The options of a new cloud, as JavaScript gives them.

use js_sys::Function;
use wasm_bindgen::prelude::*;

use crate::NonFinite;

#[wasm_bindgen]
extern "C" {
    /// Chosen by the caller and checked on the JavaScript side.
    #[wasm_bindgen(typescript_type = "CloudOptions")]
    pub type CloudOptions;
    #[wasm_bindgen(method, getter, js_name = skipNonFinite)]
    fn skip_non_finite(this: &CloudOptions) -> bool;
    /// Told which share of the building is done.
    #[wasm_bindgen(method, getter)]
    pub(super) fn progress(this: &CloudOptions) -> Option<Function>;
}

pub(super) fn non_finite(options: &CloudOptions) -> NonFinite {
    if options.skip_non_finite() {
        NonFinite::Skip
    } else {
        NonFinite::Error
    }
}
