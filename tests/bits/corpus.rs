//! Asks the same questions on every platform: `cargo run --profile quick --package hpr-tests --bin bits_corpus`.
//!
//! Prints one line for each case, `name digest count radius`: a digest of the whole answer, how
//! many points are visible (or lit), and the bits of the radius (`-` if the answer has none). The
//! last line is a digest of all cases. tests/README.md says how to compare platforms.
//!
//! Every point and viewpoint comes from exactly rounded arithmetic, so that all platforms ask
//! the same. Dimensions 4 and higher are left out: their answers are only promised to within
//! 10⁻¹⁰.

mod answer;
mod clouds;
#[path = "../core/common/flip.rs"]
#[allow(dead_code)]
mod flip;
mod options;
mod questions;
#[path = "../core/common/rng.rs"]
mod rng;
#[path = "../core/common/scenes.rs"]
#[allow(dead_code)]
mod scenes;
#[path = "../core/common/shapes.rs"]
mod shapes;

use answer::{Answer, Digest};
use clouds::Subject;
use questions::{LARGE, QUESTIONS, formulas, own_options};
use scenes::{EXTREME, KINDS};

/// Of all cases. The tests of `core` prove that the answers are right. A change that gives other answers on purpose
/// changes this number: write the one that the failure prints.
pub const EXPECTED: (u64, u64) = (0x3c80_e4da_8ec5_d627, 1218);

#[allow(dead_code)] // `core/same_bits.rs` asks the corpus by itself.
fn main() {
    let all = ask_all(|name, answer| println!("{name} {answer}"));
    println!("all {:016x} {} -", all.0, all.1);
    assert_eq!(all, EXPECTED);
}

/// Tells every case, and gives the digest and the number of all cases.
pub fn ask_all(tell: impl FnMut(&str, &Answer)) -> (u64, u64) {
    let mut record = Record {
        tell,
        all: Digest::new(),
        cases: 0,
    };
    for kind in KINDS {
        for (seed, n) in [(1, 12), (2, 150), (3, 3000)] {
            let scene = kind.scene(seed, n);
            let name = format!("{}/{n}", kind.name);
            record.add(&name, own_options(&scene));
        }
        let subject = Subject::of(kind.scene(4, 200));
        record.ask_all(kind.name, &subject, QUESTIONS);
    }
    for kind in EXTREME {
        for (seed, n) in [(1, 12), (2, 150)] {
            let name = format!("{}/{n}", kind.name.replace(' ', "_"));
            record.add(&name, own_options(&kind.scene(seed, n)));
        }
    }
    for (name, subject) in clouds::thin() {
        record.ask_all(&name, &subject, QUESTIONS);
    }
    for (name, subject) in clouds::magnitudes() {
        record.ask_all(&name, &subject, QUESTIONS);
    }
    for (name, subject) in clouds::large() {
        record.ask_all(name, &subject, LARGE);
    }
    record.add("formulas", formulas());
    (record.all.value(), record.cases)
}

struct Record<F> {
    tell: F,
    all: Digest,
    cases: u64,
}

impl<F: FnMut(&str, &Answer)> Record<F> {
    fn add(&mut self, name: &str, answer: Answer) {
        (self.tell)(name, &answer);
        self.all.add(answer.digest);
        self.cases += 1;
    }

    fn ask_all(&mut self, name: &str, subject: &Subject, questions: &[questions::Question]) {
        for (question, ask) in questions {
            self.add(&format!("{name}/{question}"), ask(subject));
        }
    }
}
