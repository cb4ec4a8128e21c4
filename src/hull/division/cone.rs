//! Bounds of flipped points from the cone of their directions.

use glam::DVec3;

use crate::base::real::square_root;
use crate::cloud::blocks::Sphere;

/// A limit of the error of all roundings in a bound, relative to the bound's largest term.
pub(super) const MARGIN: f64 = 1e-12;

/// Bounds of a group of flipped points: their directions lie within an angle around `axis`, and
/// none is farther than `reach` from the origin.
#[derive(Clone, Copy)]
pub(super) struct Cone {
    pub axis: DVec3,
    pub cos: f64,
    /// The sine of the angle; 1 for points in all directions.
    pub sin: f64,
    pub reach: f64,
}

impl Cone {
    /// The cone of the points in `sphere`, seen from `viewpoint` and flipped with
    /// R = `diameter`/2.
    pub(super) fn of(sphere: &Sphere, viewpoint: DVec3, diameter: f64) -> Self {
        let v = DVec3::from_array(sphere.center) - viewpoint;
        let distance = square_root(v.dot(v));
        // Squares must not have underflowed. The comparison also refuses a NaN.
        if distance > 1e-100 && sphere.radius < 0.5 * distance {
            let sin = sphere.radius / distance;
            Self {
                axis: v / distance,
                cos: square_root(1.0 - sin * sin),
                sin,
                reach: diameter - (distance - sphere.radius),
            }
        } else {
            Self {
                axis: DVec3::ZERO,
                cos: 0.0,
                sin: 1.0,
                reach: diameter,
            }
        }
    }

    pub(super) fn is_everywhere(&self) -> bool {
        self.sin == 1.0
    }

    /// An upper bound of m·q. `length` is the length of m.
    pub(super) fn bound(&self, m: DVec3, length: f64) -> f64 {
        let along = m.dot(self.axis);
        let across = positive_root(length * length - along * along);
        // The largest m·u in the cone. It is |m| if the cone holds the direction of m.
        let largest = if self.is_everywhere() || along * self.sin >= across * self.cos {
            length
        } else {
            along * self.cos + across * self.sin
        };
        (largest + MARGIN * length) * self.reach
    }

    /// A lower bound of n·u in the cone, for a unit vector n.
    pub(super) fn least(&self, n: DVec3) -> f64 {
        let along = n.dot(self.axis);
        let across = positive_root(1.0 - along * along);
        if self.is_everywhere() || along <= 0.0 {
            return -1.0;
        }
        along * self.cos - across * self.sin - MARGIN
    }
}

/// √x, or 0 where rounding made x negative.
pub(super) fn positive_root(x: f64) -> f64 {
    if x > 0.0 { square_root(x) } else { 0.0 }
}
