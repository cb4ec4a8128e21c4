//! Clouds, viewpoints and inversions of walks.

use hidden_point_removal::{Exponential, Inversion};

use super::rng::Rng;
use super::scenes::KINDS;
use super::shapes::{self, Points};

/// A cloud and a viewpoint. The cloud is mostly large enough for a map of directions.
pub fn subject(rng: &mut Rng) -> (&'static str, Points, [f64; 3]) {
    let n = match rng.below(4) {
        0 => rng.below(2100),
        _ => 2100 + rng.below(8000),
    };
    if rng.chance(4) {
        // The viewpoint is in the plane of one wall, of two walls, or of none.
        let points = shapes::room(rng, n);
        let mut viewpoint = rng.in_ball().map(|x| x * 6.0);
        viewpoint[0] = rng.pick(&[4.0, -4.0, viewpoint[0]]);
        viewpoint[2] = rng.pick(&[1.25, -1.25, viewpoint[2]]);
        return ("room", points, viewpoint);
    }
    if rng.chance(6) {
        // The viewpoint is far away, at distances of all magnitudes.
        let far = 10f64.powf(rng.between(0.5, 10.0));
        let viewpoint = rng.direction().map(|x| x * far);
        return ("bumpy from far", shapes::bumpy(rng, n), viewpoint);
    }
    let kind = &KINDS[rng.below(KINDS.len())];
    let scene = kind.scene(rng.bits(), n);
    (kind.name, scene.points, scene.viewpoint)
}

pub fn inversion(rng: &mut Rng) -> Inversion {
    match rng.below(3) {
        0 => Inversion::Power(rng.between(1.001, 4.0)),
        1 => Inversion::Exponential(Exponential::Auto),
        _ => Inversion::Exponential(Exponential::Scale(10f64.powf(rng.between(-6.0, 1.0)))),
    }
}
