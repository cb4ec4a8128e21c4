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

// The number of a sector.

/// One of several sectors that a view is divided into, one for each thread. A sector needs nothing from the
/// others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Sector {
    pub number: u32,
    pub count: u32,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::random::Random;
    use alloc::vec::Vec;

    const DIAMETER: f64 = 20.0;

    fn sphere(center: DVec3, radius: f64) -> Sphere {
        let center = center.to_array();
        Sphere { center, radius }
    }

    /// The largest m·q of vectors q up to `reach` long, at most `angle` away from `axis`.
    fn largest(m: DVec3, axis: DVec3, angle: f64, reach: f64) -> f64 {
        let between = m.angle_between(axis);
        m.length() * (between - angle).max(0.0).cos() * reach
    }

    #[test]
    fn the_bound_of_a_sphere_is_the_largest_in_its_cone() {
        let mut random = Random::new(1);
        let viewpoint = DVec3::new(1.0, -2.0, 0.5);
        for _ in 0..2000 {
            let distance = random.between(0.5, 4.0);
            let radius = distance * random.between(0.0, 0.49);
            let axis = random.direction();
            let m = random.between(0.1, 3.0) * random.direction();
            let cone = Cone::of(
                &sphere(viewpoint + distance * axis, radius),
                viewpoint,
                DIAMETER,
            );
            assert!(!cone.is_everywhere());
            let reach = DIAMETER - (distance - radius);
            let expected = largest(m, axis, (radius / distance).asin(), reach);
            let bound = cone.bound(m, m.length());
            assert!(
                (bound - expected).abs() < 1e-9 * m.length() * reach,
                "{bound}, {expected}"
            );
            // The spread is at least the chord of the angle, and not much more.
            let chord = 2.0 * (0.5 * (radius / distance).asin()).sin();
            assert!(cone.spread() >= chord && cone.spread() < 1.05 * chord + 1e-11);
        }
    }

    /// Of a single place, too, the bounds are larger than any rounding.
    #[test]
    fn bounds_have_a_margin() {
        let cone = Cone::of(&sphere(2.0 * DVec3::X, 0.0), DVec3::ZERO, DIAMETER);
        assert!((MARGIN..2.0 * MARGIN).contains(&cone.spread()));
        let m = 3.0 * DVec3::X;
        let above = cone.bound(m, 3.0) / (3.0 * 18.0) - 1.0;
        assert!(above > 0.5 * MARGIN && above < 2.0 * MARGIN);
    }

    #[test]
    fn near_spheres_are_everywhere() {
        let everywhere = |center, radius| {
            let cone = Cone::of(&sphere(center, radius), DVec3::ZERO, DIAMETER);
            let m = DVec3::new(0.0, 0.0, 2.0);
            let is_bound = (cone.bound(m, 2.0) - 2.0 * DIAMETER).abs() < 1e-9;
            cone.is_everywhere() && is_bound
        };
        assert!(everywhere(DVec3::ZERO, 0.0));
        assert!(everywhere(DVec3::X, 2.0));
        assert!(everywhere(2.0 * DVec3::Y, 1.0));
        assert!(everywhere(DVec3::new(1e-120, 0.0, 0.0), 0.0));
        assert!(everywhere(DVec3::X, f64::INFINITY));
        assert!(!everywhere(2.0 * DVec3::Y, 0.99));
    }

    #[test]
    fn the_cone_around_points_is_tight() {
        let mut random = Random::new(2);
        for round in 0..500 {
            let axis = random.direction();
            let width = random.between(0.0, 0.4);
            let count = 1 + round % 9;
            let points: Vec<DVec3> = (0..count)
                .map(|_| {
                    let u = (axis + width * random.direction()).normalize();
                    random.between(0.5, 9.0) * u
                })
                .collect();
            let cone = Cone::around(&points);
            assert!(!cone.is_everywhere());
            let mut least = 1.0f64;
            let mut longest = 0.0f64;
            for q in &points {
                least = least.min(cone.axis.dot(q.normalize()));
                longest = longest.max(q.length());
            }
            assert!((cone.axis.length() - 1.0).abs() < 1e-12);
            let mean = points
                .iter()
                .fold(DVec3::ZERO, |sum, q| sum + q.normalize());
            assert!(cone.axis.dot(mean.normalize()) > 1.0 - 1e-12);
            assert!(cone.cos < least && cone.cos > least - 1e-11);
            assert!((cone.sin * cone.sin + cone.cos * cone.cos - 1.0).abs() < 1e-12);
            assert!(cone.reach > longest && cone.reach < longest * (1.0 + 1e-11));
        }
        // Points that are far apart are bounded by their length alone.
        for apart in [&[DVec3::X, DVec3::Y][..], &[DVec3::X, -DVec3::X]] {
            let cone = Cone::around(apart);
            assert!(cone.is_everywhere());
            assert!((cone.bound(DVec3::Z, 1.0) - 1.0).abs() < 1e-9);
        }
        let none = Cone::around(&[]);
        assert!(none.bound(DVec3::Z, 1.0) <= 0.0);
    }

    #[test]
    fn a_wider_cone_holds_what_has_turned() {
        let viewpoint = DVec3::ZERO;
        for (radius, turn) in [(0.1, 0.2), (0.3, 0.5), (0.0, 0.1), (0.45, 0.0)] {
            let cone = Cone::of(&sphere(DVec3::X, radius), viewpoint, DIAMETER);
            let angle = radius.asin() + f64::asin(turn);
            let wide = cone.widened(f64::asin(turn).cos(), turn);
            assert!((wide.cos - angle.cos()).abs() < 1e-12);
            assert!((wide.sin - angle.sin()).abs() < 1e-12);
            assert_eq!((wide.axis, wide.reach), (cone.axis, cone.reach));
        }
        let everywhere = Cone::of(&sphere(DVec3::X, 2.0), viewpoint, DIAMETER);
        assert!(everywhere.widened(0.9, 0.1).is_everywhere());
    }

    #[test]
    fn roots_of_negative_numbers_are_zero() {
        assert_eq!([-1.0, 0.0, 4.0].map(positive_root), [0.0, 0.0, 2.0]);
    }
}
