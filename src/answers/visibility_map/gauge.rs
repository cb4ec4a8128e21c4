//! How numbers of a map depend on the flip: g of a distance, and back.

use glam::Vec4;

use crate::flip::inversion::Flip;

/// Stands for an unknown bound; at least [`UNKNOWN`] also after all means.
pub(super) const NONE: f32 = 1e30;
pub(super) const UNKNOWN: f32 = 1e20;
/// Stands for a direction in which nothing is hidden.
pub(super) const NOWHERE: f32 = f32::MAX;
/// The largest distance in a map, where points can be hidden. A test takes a cell with a larger one as
/// unknown.
pub(super) const MOST: f64 = 1e30;
/// Champions that are nearer are left out, and no distance in a map is less. Single precision may flush a smaller one to 0.
pub(super) const LEAST: f32 = 1e-30;
pub(super) const UNIT: f32 = 0.5 * f32::EPSILON;

/// How numbers in a window depend on the flip.
#[derive(Clone, Copy)]
pub(super) struct Gauge<'a> {
    flip: &'a Flip,
    /// S, and 2R, rounded down, where the flip is one on a sphere.
    length: f64,
    twice: Option<f32>,
    /// For looks: how far behind a surface points are hidden.
    pub behind: Option<f32>,
}

impl<'a> Gauge<'a> {
    /// `None` where no distance would be left. `nearest`: a distance of the nearest champions.
    pub(super) fn new(flip: &'a Flip, nearest: f64, behind: Option<f64>) -> Option<Self> {
        let twice = flip.diameter();
        let length = twice.unwrap_or_else(|| flip.most_beyond(nearest));
        let known =
            (1e-25..1e25).contains(&twice.unwrap_or(1.0)) && (1e-280..1e280).contains(&length);
        known.then_some(Self {
            flip,
            length,
            twice: twice.map(|x| x as f32 * (1.0 - f32::EPSILON)),
            behind: behind.map(|x| x as f32),
        })
    }

    /// G of points at these distances.
    #[inline(always)]
    pub(super) fn bound(&self, d: Vec4) -> Vec4 {
        let d = d * (1.0 + 16.0 * UNIT);
        match self.twice {
            Some(twice) => d / (Vec4::splat(twice) - d),
            None => self.other(d, |d| self.length / self.flip.reach_at(d) - 1.0),
        }
    }

    /// The distances of these G.
    #[inline(always)]
    pub(super) fn distance(&self, bound: Vec4) -> Vec4 {
        match self.twice {
            Some(twice) => bound / (bound + 1.0) * twice * (1.0 + 16.0 * UNIT),
            None => self.other(bound, |bound| {
                self.flip.distance_at(self.length / (1.0 + bound))
            }),
        }
    }

    #[inline(never)]
    fn other(&self, numbers: Vec4, of: impl Fn(f64) -> f64) -> Vec4 {
        numbers.map(|x| {
            if x < UNKNOWN {
                (of(f64::from(x)).clamp(0.0, 1e31) * (1.0 + 1e-6)) as f32
            } else {
                NONE
            }
        })
    }
}
