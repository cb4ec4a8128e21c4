//! The answers of the corpus have the same bits natively and in WebAssembly, where this test runs under Node.

#[path = "bits/corpus.rs"]
mod corpus;

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

/// The program `bits_corpus` prints it on other platforms. The tests of `core` prove that the answers are right. A change that gives
/// other answers on purpose changes this number: write the one that the failure prints.
const EXPECTED: u64 = 0x1e81_d9a9_c317_7e03;

#[test]
fn all_answers_are_the_same_bits() {
    let (digest, cases) = corpus::ask_all(|_, _| {});
    assert_eq!((digest, cases), (EXPECTED, 1415), "got {digest:#x}");
}
