//! The answers of the corpus have the same bits natively as in WebAssembly, where the program itself runs.

#[path = "../bits/corpus.rs"]
mod corpus;

#[test]
fn all_answers_are_the_same_bits() {
    let all = corpus::ask_all(|_, _| {});
    assert_eq!(all, corpus::EXPECTED, "got {:#x}", all.0);
}
