//! An error, as JavaScript receives it. JavaScript puts the numbers into the message
//! (src/ts/instance/failure.ts): to format them here would add 30 kB of wasm.

use wasm_bindgen::JsValue;

use crate::Error;
use crate::base::error::Message;
use crate::wasm::objects::{list, object};

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
