//! The short form of the fuzzer `fuzz_core`, with the same scenes every time.

use crate::checks::CHECKS;
use crate::common::rng::Rng;
use crate::test;

/// Asks so many scenes of a check.
fn ask(name: &str, scenes: u64) {
    let check = CHECKS
        .iter()
        .find(|check| check.name == name)
        .expect("a check");
    for seed in 0..scenes {
        let (kind, scene) = (check.subject)(&mut Rng::new(seed));
        let wrong = (check.ask)(&scene, &mut Rng::new(seed + 1_000_000)).err();
        assert_eq!(wrong, None, "{name}, {kind}, seed {seed}");
    }
}

macro_rules! short {
    ($($name:ident $scenes:literal;)*) => {
        $(#[test] fn $name() { ask(stringify!($name), $scenes); })*

        #[test]
        fn no_check_is_left_out() {
            assert_eq!(CHECKS.map(|check| check.name), [$(stringify!($name)),*]);
        }
    };
}

short! {
    oracle 6_000;
    sectors 300;
    slices 15;
    boxes 20;
    dimensions 150;
    camera 100;
    sees 100;
    within 100;
    coverage 60;
    invariance 300;
    maps 8;
    threads 20;
}
