//! Tells a listener of the page or worker that something is still computed.

use core::cell::OnceCell;

use js_sys::Function;
use std::thread_local;
use wasm_bindgen::prelude::*;

use crate::base::beat;

thread_local! {
    static LISTENER: OnceCell<Function> = const { OnceCell::new() };
}

/// Calls the function again and again while anything is computed: every few milliseconds, in the middle
/// of a call. It must not call this module. Only the first listener is kept.
#[wasm_bindgen(js_name = onBeat)]
pub fn on_beat(listener: Function) {
    let _ = LISTENER.with(|kept| kept.set(listener));
    beat::listen(|| {
        LISTENER.with(|kept| {
            if let Some(listener) = kept.get() {
                // The function posts a message, which does not throw.
                let _ = listener.call0(&JsValue::UNDEFINED);
            }
        });
    });
}
