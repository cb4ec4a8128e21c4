//! Repeatable random numbers for unit tests.

use alloc::vec::Vec;
use glam::DVec3;

pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// A number below `n`, by a linear congruential generator.
    pub(crate) fn below(&mut self, n: u64) -> u64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % n
    }

    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.below(1 << 30) as f64 / f64::from(1 << 30))
    }

    /// A unit vector.
    pub(crate) fn direction(&mut self) -> DVec3 {
        loop {
            let v = DVec3::from_array(core::array::from_fn(|_| self.between(-1.0, 1.0)));
            if (0.01..1.0).contains(&v.length_squared()) {
                return v.normalize();
            }
        }
    }

    /// Points on a bumpy surface around the origin, in the order of their longitude.
    pub(crate) fn bumpy(&mut self, count: usize) -> Vec<[f64; 3]> {
        let place = |_| {
            let u = self.direction();
            ((1.0 + 1.5 * u.x * u.y * u.z) * u).to_array()
        };
        let mut places: Vec<[f64; 3]> = (0..count).map(place).collect();
        places.sort_by_key(|p| (f64::atan2(p[1], p[0]) * 6.0) as i64 * 100 + (p[2] * 9.0) as i64);
        places
    }
}
