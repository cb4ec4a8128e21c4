//! Where the seams between sectors are.

use alloc::vec::Vec;
use glam::{DVec2, DVec3};

use super::cone::Cone;
use crate::base::allocation::{OutOfMemory, with_capacity};
use crate::base::sort::sort_keyed;

/// The number of sampled blocks whose directions decide where the seams are.
const SAMPLES: usize = 1024;

/// Half-planes that meet in a line through the viewpoint. Angles around this line are measured
/// on the diamond |x| + |y| = 1 instead of the circle: four quarters of length 1.
pub(super) struct Fan {
    right: DVec3,
    up: DVec3,
    /// The angles of the half-planes, ascending; sector k lies between k and k + 1, and the
    /// last one between the last and the first.
    angles: Vec<f64>,
    pub(super) clearance: f64,
}

impl Fan {
    #[inline(never)]
    pub(super) fn new(
        blocks: &[Cone],
        ahead: DVec3,
        seen: &[bool],
        count: usize,
    ) -> Result<Self, OutOfMemory> {
        let step = sample_step(blocks.len());
        let sample = || blocks.iter().step_by(step).map(|cone| cone.axis);
        // Angles begin behind: seen from outside, nothing is there.
        let right = -ahead.try_normalize().unwrap_or(DVec3::X);
        // Across the direction in which the cloud looks longest, so that seams are short.
        let mut up = DVec3::ZERO;
        let mut longest = f64::NEG_INFINITY;
        for axis in DVec3::AXES {
            let across = (axis - right * right.dot(axis)).try_normalize();
            let Some(across) = across else { continue };
            let spread: f64 = sample().map(|u| u.dot(across) * u.dot(across)).sum();
            if spread > longest {
                (up, longest) = (across, spread);
            }
        }
        let mut fan = Self {
            right,
            up,
            angles: Vec::new(),
            clearance: 0.0,
        };
        // Each angle comes with the work that its block stands for. The angles are sorted by
        // their bits. For numbers that are not negative, this is the order of the numbers.
        let mut angles: Vec<(u64, u32)> = with_capacity(SAMPLES)?;
        let work = |&seen: &bool| if seen { SEEN } else { 1 };
        angles.extend(
            sample()
                .map(|u| fan.angle(u).to_bits())
                .zip(seen.iter().map(work)),
        );
        sort_keyed(&mut angles);
        let mut total = 0;
        for (_, work) in &mut angles {
            total += *work;
            *work = total;
        }
        let sines: f64 = blocks.iter().step_by(step).map(|cone| cone.sin).sum();
        fan.clearance = BAND * sines / angles.len().max(1) as f64;
        fan.angles.try_reserve_exact(count)?;
        if count == 2 {
            // The first seam is one plane, so that each side is at most a half of all directions.
            let first = halving(&angles);
            fan.angles.extend([first, first + 2.0]);
        } else {
            fan.angles.push(0.0);
            for k in 1..count {
                let until = (u64::from(total) * k as u64 / count as u64) as u32;
                let next = angles.partition_point(|&(_, work)| work <= until);
                let angle = angles
                    .get(next)
                    .map_or(4.0, |&(bits, _)| f64::from_bits(bits));
                fan.angles.push(angle);
            }
        }
        Ok(fan)
    }

    #[inline(never)]
    fn angle(&self, u: DVec3) -> f64 {
        let (x, y) = (u.dot(self.right), u.dot(self.up));
        let sum = x.abs() + y.abs();
        if sum == 0.0 {
            0.0
        } else if y >= 0.0 {
            1.0 - x / sum
        } else {
            3.0 + x / sum
        }
    }

    pub(super) fn sector_of(&self, u: DVec3) -> usize {
        let angle = self.angle(u);
        let passed = self.angles.iter().filter(|&&seam| seam <= angle).count();
        // A direction before the first seam belongs to the last sector.
        (passed + self.angles.len() - 1) % self.angles.len()
    }

    /// The normals of the two half-planes around a sector, outward.
    pub(super) fn seams(&self, sector: usize) -> [DVec3; 2] {
        let normal = |angle: f64| {
            let y = if angle < 2.0 { 1.0 } else { -1.0 };
            let x = if angle < 2.0 {
                1.0 - angle
            } else {
                angle - 3.0
            };
            let on_diamond = DVec2::new(x, y * (1.0 - x.abs()));
            let normal = on_diamond.perp().normalize();
            self.right * normal.x + self.up * normal.y
        };
        let next = self.angles[(sector + 1) % self.angles.len()];
        [-normal(self.angles[sector]), normal(next)]
    }
}

/// The width of the band beyond a seam, in mean radii of the blocks as seen. Points beyond
/// the band are far.
const BAND: f64 = 1.0;
/// The work of a visible point; the work of a hidden one is 1.
const SEEN: u32 = 4;

/// The angle a below 2 for which half of the work lies between a and a + 2. `angles` are
/// ascending, each with the work up to it.
fn halving(angles: &[(u64, u32)]) -> f64 {
    let until = |end: f64| {
        let count = angles.partition_point(|&(bits, _)| f64::from_bits(bits) < end);
        if count == 0 { 0 } else { angles[count - 1].1 }
    };
    let total = until(f64::INFINITY);
    let imbalance = |first: f64| (2 * (until(first + 2.0) - until(first))).abs_diff(total);
    let candidates = angles.iter().map(|&(bits, _)| f64::from_bits(bits) % 2.0);
    candidates
        .min_by_key(|&first| imbalance(first))
        .unwrap_or(0.0)
}

/// The step from one block of the sample to the next.
pub(super) fn sample_step(blocks: usize) -> usize {
    blocks.div_ceil(SAMPLES).max(1)
}
