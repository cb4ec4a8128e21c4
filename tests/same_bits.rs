//! The answers of the corpus have the same bits natively and in WebAssembly, where this test runs under Node.

#[path = "bits/corpus.rs"]
mod corpus;

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

/// `npm run bits` prints it for other platforms. The tests of `core` prove that the answers are right.
const EXPECTED: u64 = 0x82fe_f5a0_2c70_052d;

#[test]
fn all_answers_are_the_same_bits() {
    let (digest, cases) = corpus::ask_all(|_, _| {});
    assert_eq!((digest, cases), (EXPECTED, 1415), "got {digest:#x}");
}
