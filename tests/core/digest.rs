//! One number for many answers: the same on every machine and in WebAssembly.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use crate::common::ask;
use crate::common::scenes::KINDS;

/// FNV-1a over 64-bit words.
struct Digest(u64);

impl Digest {
    fn add(&mut self, word: u64) {
        self.0 = (self.0 ^ word).wrapping_mul(0x0000_0100_0000_01b3);
    }
}

/// What every build answers; the certificates say that the answers are right. It
/// changes only with the scenes, the canonical order of points, or the rule of the
/// automatic radius.
const EXPECTED: u64 = 0x862a_a627_2c16_943f;

#[test]
fn answers_and_radii_are_the_same_bits_everywhere() {
    let mut digest = Digest(0xcbf2_9ce4_8422_2325);
    for kind in KINDS {
        for (seed, n) in [(100, 12), (101, 150), (102, 2000), (103, 2500)] {
            let scene = kind.scene(seed, n);
            let answer = ask(&scene.points, scene.viewpoint, &scene.options);
            digest.add(answer.radius().to_bits());
            digest.add(answer.exponent().to_bits());
            answer
                .indices()
                .iter()
                .for_each(|&i| digest.add(u64::from(i)));
            digest.add(u64::MAX);
        }
    }
    assert_eq!(digest.0, EXPECTED, "got {:#x}", digest.0);
}
