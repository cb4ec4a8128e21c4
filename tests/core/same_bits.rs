//! The answers of the corpus have the same bits natively and in WebAssembly.

use crate::test;

// It brings its own scenes and numbers: it is a program, too.
#[allow(clippy::duplicate_mod)]
#[path = "../bits/corpus.rs"]
mod corpus;

#[test]
fn all_answers_are_the_same_bits() {
    let all = corpus::ask_all(|_, _| {});
    assert_eq!(all, corpus::EXPECTED, "got {:#x}", all.0);
}
