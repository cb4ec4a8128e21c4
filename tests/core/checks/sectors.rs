//! Views that 2 to 64 threads share, compared with those of one: viewpoints in planes and lines of points.

use hidden_point_removal::{Options, PointCloud};

use super::same;
use crate::common::rng::Rng;
use crate::common::scenes::Scene;
use crate::common::{cloud_of, structured};

/// The number of viewpoints for each cloud.
const VIEWS: usize = 6;

pub fn check(scene: &Scene, rng: &mut Rng) -> Result<(), String> {
    let cloud = cloud_of(&scene.points, rng.chance(2));
    let (mut viewpoint, mut options) = (scene.viewpoint, scene.options);
    for _ in 0..VIEWS {
        let count = match rng.below(16) {
            0..7 => 2,
            7..15 => 3 + rng.below(5),
            _ => 8 + rng.below(57),
        };
        compare(&cloud, viewpoint, &options, count)?;
        viewpoint = structured::viewpoint(rng, &scene.points);
        options = structured::options(rng, &scene.points, viewpoint);
    }
    Ok(())
}

/// Compares a view that threads share with the view of one.
pub fn compare(
    cloud: &PointCloud,
    viewpoint: [f64; 3],
    options: &Options,
    threads: usize,
) -> Result<(), String> {
    let whole = cloud.visible_from(viewpoint, options);
    let shared = cloud.visible_from(viewpoint, &options.with_threads(threads));
    let title = format!("{threads} threads, from {viewpoint:?} with {options:?}");
    same(&title, shared, whole)
}
