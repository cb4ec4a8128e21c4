//! The options of a new cloud, as JavaScript gives them.

use js_sys::Function;
use wasm_bindgen::prelude::*;

use crate::NonFinite;

#[wasm_bindgen]
extern "C" {
    /// The caller's choices. JavaScript has checked them.
    #[wasm_bindgen(typescript_type = "CloudOptions")]
    pub type CloudOptions;
    #[wasm_bindgen(method, getter, js_name = skipNonFinite)]
    fn skip_non_finite(this: &CloudOptions) -> bool;
    /// A function that is called with the share of the building that is done.
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
