//! One number for many answers: the same on every machine and in WebAssembly.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use hidden_point_removal::{
    Exponential, Inversion, Options, PointCloud, Radius, Visibility, ring_of_viewpoints,
};

use crate::common::ask;
use crate::common::scenes::KINDS;

/// FNV-1a over 64-bit words.
struct Digest(u64);

impl Digest {
    fn add(&mut self, word: u64) {
        self.0 = (self.0 ^ word).wrapping_mul(0x0000_0100_0000_01b3);
    }

    fn add_answer(&mut self, answer: &Visibility) {
        self.add(answer.radius().to_bits());
        self.add(answer.exponent().to_bits());
        let indices = answer.indices().iter();
        indices.for_each(|&i| self.add(u64::from(i)));
        self.add(u64::MAX);
    }
}

/// Every build must give these answers; the certificates prove that they are right. The
/// digest changes only with the scenes, the canonical order of points, or the rule of the
/// automatic radius.
const EXPECTED: u64 = 0x3373_238f_6737_9b00;

#[test]
fn answers_and_radii_are_the_same_bits_everywhere() {
    let mut digest = Digest(0xcbf2_9ce4_8422_2325);
    for kind in KINDS {
        for (seed, n) in [(100, 12), (101, 150), (102, 2000), (103, 2500)] {
            let scene = kind.scene(seed, n);
            let answer = ask(&scene.points, scene.viewpoint, &scene.options);
            digest.add_answer(&answer);
        }
    }
    assert_eq!(digest.0, EXPECTED, "got {:#x}", digest.0);
}

/// The digest of operations that need more than a square root, or that make a choice.
const EXPECTED_OF_THE_REST: u64 = 0x58f8_0253_886c_1f53;

#[test]
fn inversions_searches_directions_noise_and_rings_are_the_same_bits_everywhere() {
    let mut digest = Digest(0xcbf2_9ce4_8422_2325);
    let options = [
        Options::with_inversion(Inversion::Power(1.3)),
        Options::with_inversion(Inversion::Power(7.1)),
        Options::with_inversion(Inversion::Exponential(Exponential::Auto)),
        Options::with_inversion(Inversion::Exponential(Exponential::Scale(0.3))),
        Options {
            radius: Radius::Search,
            ..Options::default()
        },
        Options {
            radius: Radius::Opposite,
            ..Options::default()
        },
        Options {
            denoise: Some(9),
            vote: Some(7),
            ..Options::default()
        },
    ];
    for kind in KINDS {
        let scene = kind.scene(104, 120);
        let cloud = PointCloud::new(&scene.points).unwrap();
        for options in &options {
            let answer = cloud.visible_from(scene.viewpoint, options).unwrap();
            digest.add_answer(&answer);
            if let Inversion::Exponential(Exponential::Scale(scale)) = answer.inversion() {
                digest.add(scale.to_bits());
            }
        }
        let along = cloud.visible_from_direction([0.3, -0.7, 0.2], &Options::default());
        digest.add_answer(&along.unwrap());
        let mesh = cloud.reconstruct(scene.viewpoint, &Options::default(), None);
        let corners = mesh.unwrap().triangles.into_iter().flatten();
        corners.for_each(|i| digest.add(u64::from(i)));
        let ring = ring_of_viewpoints(scene.viewpoint, [0.1, 0.2, 0.3], 5, 0.05).unwrap();
        ring.iter().flatten().for_each(|x| digest.add(x.to_bits()));
    }
    let got = digest.0;
    assert_eq!(got, EXPECTED_OF_THE_REST, "got {got:#x}");
}
