//! Choosing the radius R of the flipping sphere (paper §4): by the closed form, by a search
//! that asks the hull, or as given.

use crate::base::error::Error;
use crate::cloud::blocks::Blocks;
use crate::cloud::points::Points;
use crate::cloud::statistics::Statistics;
use crate::flip::inversion::Flip;
use crate::hull::visible_once;
use crate::view::options::Radius;
use crate::view::radius::{ChosenRadius, automatic, from_radius, given};
use crate::view::search::{self, Seen};

/// Turns the caller's choice into a radius for a cloud of these `points` and
/// `statistics`, whose farthest point from `viewpoint` is at `farthest`.
pub(crate) fn resolve(
    choice: Radius,
    points: &Points,
    blocks: &Blocks,
    statistics: &Statistics,
    viewpoint: [f64; 3],
    farthest: f64,
) -> Result<ChosenRadius, Error> {
    let automatic = || automatic(statistics, viewpoint, farthest);
    let seen = |place, kernel| visible_once(points, &Flip::new(place, kernel));
    match choice {
        Radius::Auto => Ok(from_radius(automatic(), farthest)),
        Radius::Search => search::antipodal(automatic(), farthest, &mut |kernels| {
            let [here, there] = kernels.map(|kernel| seen(viewpoint, kernel));
            Ok(Seen::count(&here?, &there?))
        }),
        Radius::Opposite => {
            let center = statistics.centroid;
            let mirror: [f64; 3] =
                core::array::from_fn(|axis| center[axis] + (center[axis] - viewpoint[axis]));
            // Out of range, or at the centroid, there is no other side.
            let reach = blocks
                .farthest_distance(points, mirror)
                .unwrap_or(f64::INFINITY);
            let opposite = if mirror == viewpoint {
                None
            } else {
                search::opposite(reach.max(farthest), farthest, &mut |kernel| {
                    Ok(Seen::count(
                        &seen(viewpoint, kernel)?,
                        &seen(mirror, kernel)?,
                    ))
                })?
            };
            Ok(opposite.unwrap_or_else(|| from_radius(automatic(), farthest)))
        }
        Radius::Absolute(_) | Radius::Exponent(_) => given(choice, farthest),
    }
}
