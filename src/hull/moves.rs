//! Small hulls that move from view to view. Each answer is compared with that of a new hull.

use alloc::vec::Vec;
use glam::DVec3;

use super::{Memory, mark_visible};
use crate::base::random::Random;
use crate::cloud::points::Points;
use crate::flip::inversion::Flip;
use crate::flip::kernel::Kernel;

/// Compares the view that may start from the last one with a view that does not. Returns whether it did.
fn see(points: &Points, radius: f64, viewpoint: DVec3, memory: &mut Memory) -> bool {
    let flip = Flip::new(viewpoint.to_array(), Kernel::Spherical { radius });
    mark_visible(points, &[], &flip, None, memory).unwrap();
    let mut new = Memory::default();
    mark_visible(points, &[], &flip, None, &mut new).unwrap();
    assert_eq!(memory.visible(), new.visible(), "{viewpoint}");
    memory.moved()
}

/// Moves around a cloud by steps of all sizes. Returns how many views started from the last one.
fn walk(points: &Points, radius: f64, seed: u64) -> usize {
    let mut random = Random::new(seed);
    let mut memory = Memory::default();
    let mut viewpoint = DVec3::new(0.0, 0.5, 2.5);
    let mut moved = 0;
    for view in 0..80 {
        moved += usize::from(see(points, radius, viewpoint, &mut memory));
        let step = [2e-3, 6e-3, 2e-2, 5e-2][view / 20];
        viewpoint = 2.5 * (viewpoint + step * random.direction()).normalize();
    }
    moved
}

#[test]
fn steps_that_turn_faces_over_are_mended() {
    let mut random = Random::new(27);
    let bumpy = random.bumpy(1200);
    let ball: Vec<[f64; 3]> = (0..1200)
        .map(|_| (random.between(0.1, 1.0) * random.direction()).to_array())
        .collect();
    let plane = |p: &[f64; 3]| [p[0], p[1], 0.1 * (5.0 * p[2]).round()];
    let layers = bumpy.iter().map(plane).collect::<Vec<_>>();
    // So many of the 79 views are mended. The others start with a new hull: too much has changed.
    for (title, places, mended) in [
        ("bumpy", bumpy, [72, 41]),
        ("ball", ball, [62, 40]),
        ("layers", layers, [79, 61]),
    ] {
        let points = Points::Double(places);
        for (radius, mended) in [300.0, 3000.0].into_iter().zip(mended) {
            let moved = walk(&points, radius, 28);
            assert!(moved >= mended, "{title}, {radius}: {moved}");
        }
    }
}

/// Where the viewpoint leaves the hull of the flipped points, a face turns over that no flip can mend: the
/// viewpoint becomes a vertex.
#[test]
fn a_viewpoint_leaves_a_cloud_and_enters_it() {
    let mut random = Random::new(29);
    for count in [12, 150, 600] {
        let places = (0..count).map(|_| random.direction().to_array()).collect();
        let points = Points::Double(places);
        for radius in [2.5, 6.0] {
            let u = random.direction();
            let mut memory = Memory::default();
            let mut moved = 0;
            for step in 0..160 {
                let viewpoint = (0.8 + 0.003 * f64::from(i32::abs(step - 80))) * u;
                moved += usize::from(see(&points, radius, viewpoint, &mut memory));
            }
            assert!(moved >= 80, "{count} points, {radius}: {moved}");
        }
    }
}
