//! The map hides hidden points only, and most of them.

use super::*;
use crate::base::random::Random;
use crate::cloud::blocks::Blocks;
use crate::cloud::points::Points;
use crate::flip::inversion::Flip;
use crate::flip::kernel::Kernel;
use crate::hull::{Memory, mark_visible};

/// Compares what the map hides with the answer. Returns the share of the hidden points that it
/// hides.
fn compare(points: &Points, blocks: &[Sphere], flip: &Flip, wanted: &dyn Fn(u32) -> bool) -> f64 {
    let mut memory = Memory::new();
    mark_visible(points, &[], flip, &mut memory).unwrap();
    let flipped = Flipped::of(points, blocks, flip);
    let mut map = DepthMap::default();
    map.make(&memory.hull, &flipped, points.len(), wanted)
        .unwrap();
    let [mut hidden, mut found] = [0.0; 2];
    for start in (0..points.len()).step_by(BLOCK) {
        if !wanted(start as u32) {
            continue;
        }
        let left = map.not_hidden(&flipped, start as u32, u64::MAX);
        assert_eq!(
            map.not_hidden(&flipped, start as u32, 0x5555),
            left & 0x5555
        );
        let end = points.len().min(start + BLOCK);
        for index in start..end {
            let is_left = left >> (index - start) & 1 != 0;
            assert!(is_left || !memory.visible()[index], "point {index}");
            hidden += f64::from(u8::from(!memory.visible()[index]));
            found += f64::from(u8::from(!is_left));
        }
        assert!(end - start == BLOCK || left >> (end - start) == 0);
    }
    found / f64::max(hidden, 1.0)
}

#[test]
fn the_map_hides_most_hidden_points_and_no_others() {
    let mut random = Random::new(15);
    let surface = Points::Double(random.bumpy(9000));
    let mut ball: Vec<[f64; 3]> = (0..9000)
        .map(|_| (random.between(0.3, 1.0) * random.direction()).to_array())
        .collect();
    ball.sort_by_key(|p| p.map(|x| (4.0 * x) as i32));
    let ball = Points::Double(ball);
    let (inside, outside) = ([0.02, -0.01, 0.03], [2.0, 0.5, -1.5]);
    let sphere = |radius| Kernel::Spherical { radius };
    let exponential = Kernel::Exponential { scale: 0.05 };
    // The map of a third of the blocks knows fewer corners around them.
    for (points, viewpoint, kernel, all, some) in [
        (&surface, inside, sphere(60.0), 0.0, 0.0),
        (&surface, outside, sphere(60.0), 0.83, 0.36),
        (&ball, inside, sphere(6.0), 0.87, 0.69),
        (&ball, inside, exponential, 0.89, 0.7),
        (&ball, outside, sphere(6.0), 0.95, 0.92),
        (&ball, outside, sphere(60.0), 0.96, 0.91),
        (&ball, outside, exponential, 0.77, 0.69),
    ] {
        let blocks = Blocks::around(points).unwrap();
        let flip = Flip::new(viewpoint, kernel);
        for spheres in [&[], &blocks.levels[0][..]] {
            let share = compare(points, spheres, &flip, &|_| true);
            assert!(share >= all, "{viewpoint:?}, {kernel:?}: {share}");
            let share = compare(points, spheres, &flip, &|index| index / 640 % 3 == 1);
            assert!(share >= some, "{viewpoint:?}, {kernel:?}: {share}");
        }
    }
}
