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

    /// The cone of these flipped points.
    pub(super) fn around(points: &[DVec3]) -> Self {
        let mut reach = 0.0;
        let mut sum = DVec3::ZERO;
        for q in points {
            let length = square_root(q.dot(*q));
            sum += *q / length;
            if length > reach {
                reach = length;
            }
        }
        reach *= 1.0 + MARGIN;
        let length = square_root(sum.dot(sum));
        let axis = sum / length;
        let least = points.iter().fold(1.0, |least, q| {
            let cos = axis.dot(*q) / square_root(q.dot(*q));
            if cos < least { cos } else { least }
        });
        // The cosine of 30°; the comparison also refuses a NaN.
        if length > 0.0 && least > 0.87 {
            let cos = least - MARGIN;
            let sin = positive_root(1.0 - cos * cos);
            return Self {
                axis,
                cos,
                sin,
                reach,
            };
        }
        Self {
            axis: DVec3::ZERO,
            cos: 0.0,
            sin: 1.0,
            reach,
        }
    }

    pub(super) fn is_everywhere(&self) -> bool {
        self.sin == 1.0
    }

    /// An upper bound of m·q. `length` is the length of m.
    #[inline]
    pub(super) fn bound(&self, m: DVec3, length: f64) -> f64 {
        let along = m.dot(self.axis);
        let across = positive_root(length * length - along * along);
        // The largest m·u in the cone. It is |m| if the cone holds the direction of m.
        let largest = if self.sin == 1.0 || along * self.sin >= across * self.cos {
            length
        } else {
            along * self.cos + across * self.sin
        };
        (largest + MARGIN * length) * self.reach
    }

    /// The cone of all directions that are in this cone after they turned by an angle up to 30°.
    pub(super) fn widened(&self, cos: f64, sin: f64) -> Self {
        if self.is_everywhere() {
            return *self;
        }
        Self {
            cos: self.cos * cos - self.sin * sin,
            sin: self.sin * cos + self.cos * sin,
            ..*self
        }
    }

    /// An upper bound of the distance from `axis` to a direction in the cone.
    pub(super) fn spread(&self) -> f64 {
        // The angle is below 30° unless the cone is everywhere; 2·sin(15°) < 1.036·sin(30°).
        1.04 * self.sin + MARGIN
    }
}

/// √x, or 0 where rounding made x negative.
pub(super) fn positive_root(x: f64) -> f64 {
    if x > 0.0 { square_root(x) } else { 0.0 }
}
