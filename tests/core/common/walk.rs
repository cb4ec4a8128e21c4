//! Viewpoints that move by steps of all sizes.

use hidden_point_removal::{Options, Radius};

use super::flip::{distance, farthest};
use super::rng::Rng;

/// A viewpoint on its way around and through a cloud.
pub struct Walk<'a> {
    points: &'a [[f64; 3]],
    center: [f64; 3],
    /// The distance from the center to the farthest point.
    size: f64,
    pub viewpoint: [f64; 3],
    pub options: Options,
    /// Whether the options are likely to be refused.
    wrong: bool,
}

impl<'a> Walk<'a> {
    pub fn new(points: &'a [[f64; 3]], viewpoint: [f64; 3], options: Options) -> Self {
        let mut low = [f64::INFINITY; 3];
        let mut high = [f64::NEG_INFINITY; 3];
        for p in points {
            for axis in 0..3 {
                low[axis] = low[axis].min(p[axis]);
                high[axis] = high[axis].max(p[axis]);
            }
        }
        let center = match points.is_empty() {
            true => viewpoint,
            false => core::array::from_fn(|axis| 0.5 * low[axis] + 0.5 * high[axis]),
        };
        Self {
            points,
            center,
            size: farthest(points, center),
            viewpoint,
            options,
            wrong: false,
        }
    }

    /// Moves on: mostly by a small part of the distance, with the same options.
    pub fn step(&mut self, rng: &mut Rng) {
        if self.wrong || rng.chance(12) {
            self.wrong = rng.chance(6);
            self.options.radius = match self.wrong {
                true => self.wrong_radius(rng),
                false => self.any_radius(rng),
            };
        }
        self.viewpoint = match rng.below(40) {
            0 => self.viewpoint,
            1 => self.place(rng, 4.0),
            2 => self.place(rng, 0.9),
            3 if !self.points.is_empty() => rng.pick(self.points),
            4 if !self.points.is_empty() => {
                // On the way to a point, or beyond it.
                let to = rng.pick(self.points);
                let part = rng.between(-1.5, 1.5);
                core::array::from_fn(|i| self.viewpoint[i] + (to[i] - self.viewpoint[i]) * part)
            }
            _ => {
                let part = part(rng);
                self.near(rng, part)
            }
        };
    }

    /// Moves in any direction by `part` of the distance from the center, or of the cloud's
    /// size if that is larger.
    pub fn near(&self, rng: &mut Rng, part: f64) -> [f64; 3] {
        let distance = distance(self.viewpoint, self.center).max(0.1 * self.size);
        let direction = rng.direction();
        core::array::from_fn(|i| self.viewpoint[i] + direction[i] * distance * part)
    }

    /// Any place whose distance from the center is at most `sizes` times the cloud's size.
    pub fn place(&self, rng: &mut Rng, sizes: f64) -> [f64; 3] {
        let p = rng.in_ball();
        core::array::from_fn(|i| self.center[i] + p[i] * sizes * self.size)
    }

    /// Ordinary, tiny and huge radii.
    fn any_radius(&self, rng: &mut Rng) -> Radius {
        let exponents = [0.0, 0.1, 0.5, 1.0, 2.0, 2.5, 3.0, 4.0, 7.0, 14.0];
        match rng.below(8) {
            0..4 => Radius::Auto,
            // Too small as soon as the viewpoint is farther away.
            4 => Radius::Absolute(self.farthest() * rng.between(1.0, 30.0)),
            _ => Radius::Exponent(rng.pick(&exponents)),
        }
    }

    fn wrong_radius(&self, rng: &mut Rng) -> Radius {
        let half = Radius::Absolute(0.5 * self.farthest());
        rng.pick(&[
            half,
            Radius::Absolute(0.0),
            Radius::Absolute(f64::NAN),
            Radius::Absolute(f64::MAX),
            Radius::Exponent(-1.0),
            Radius::Exponent(400.0),
        ])
    }

    fn farthest(&self) -> f64 {
        farthest(self.points, self.viewpoint)
    }
}

/// From 1e-9 to 0.5. Small and large values are equally frequent.
fn part(rng: &mut Rng) -> f64 {
    let digits = rng.below(10) as i32;
    (0..digits).fold(rng.between(0.1, 0.5), |part, _| part * 0.1)
}
