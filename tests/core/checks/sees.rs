//! Points that are not in the cloud: the answer of a cloud with the point added.

use hidden_point_removal::{Inversion, Radius};

use super::options;
use crate::common::added::{check as compare, places};
use crate::common::rng::Rng;
use crate::common::scenes::Scene;

pub fn check(scene: &Scene, rng: &mut Rng) -> Result<(), String> {
    let mut options = options(scene, rng);
    if let Inversion::Spherical = options.inversion
        && rng.chance(4)
    {
        let radius = rng.pick(&[Radius::Auto, Radius::Exponent(2.0), Radius::Exponent(7.0)]);
        options = options.with_radius(radius);
    }
    let places = places(rng, scene, 5);
    compare(scene, &options, &places, "sees");
    Ok(())
}
