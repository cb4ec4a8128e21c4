//! Sheets that lie near each other: the two sides of a board, shelves, walls. A quadric takes them for
//! noise. Two planes tell them from it, since sheets without noise lie on them.

use glam::{DMat3, DVec3};

use crate::base::allocation::{OutOfMemory, with_capacity};
use crate::base::real::square_root;
use crate::base::sort::{Keyed, ordered, percentile, sort_keyed};
use crate::cloud::neighbors::Neighbors;
use crate::cloud::plane::{least_axis, outer_product};

/// Neighbors of the small and the large surroundings of a point.
pub(crate) const NEAR: [usize; 2] = [16, 32];
/// How many places are measured where that takes more than the quadrics of all samples.
pub(crate) const PLACES: usize = 512;
/// The percentile that counts where edges and corners are to be left out.
pub(crate) const LOW: usize = 25;
/// A point is on the next sheet if it lies from the first to the second number of spacings before or behind a place,
/// and at most one local spacing beside its normal.
const NEXT: [f64; 2] = [0.7, 30.0];

/// A measured point.
pub(crate) struct Sample {
    pub point: u32,
    pub place: [f64; 3],
    /// The normal of the plane of its 16 nearest points, of either sign.
    pub normal: DVec3,
    /// The mean distance to its 6 nearest points.
    pub spacing: f64,
    /// What does not grow of the distances off the quadrics, in spacings.
    pub noise: f64,
}

/// Every so many-th sample, so that at most [`PLACES`] are left.
pub(crate) fn some(samples: &[Sample]) -> impl Iterator<Item = &Sample> {
    samples
        .iter()
        .step_by(samples.len().div_ceil(PLACES).max(1))
}

/// How far places lie off two parallel planes, which are on both sides of the widest gap along `normal`: the root of the
/// mean square. The sum of squares is divided by the number of places above 4.
pub(crate) fn off_two_planes(places: &[DVec3], normal: DVec3, order: &mut [Keyed]) -> f64 {
    for (number, item) in (0..).zip(&mut *order) {
        *item = (ordered(places[number as usize].dot(normal)), number);
    }
    sort_keyed(order);
    let place = |(_, number): &Keyed| places[*number as usize];
    let height = |at: usize| place(&order[at]).dot(normal);
    let gap = |at: usize| height(at) - height(at - 1);
    let mut cut = 1;
    for at in 1..order.len() {
        if gap(at) > gap(cut) {
            cut = at;
        }
    }
    let (low, high) = order.split_at(cut);
    let mut spread = DMat3::ZERO;
    for sheet in [low, high] {
        let sum = sheet
            .iter()
            .fold(DVec3::ZERO, |sum, item| sum + place(item));
        let mean = sum / sheet.len() as f64;
        for item in sheet {
            spread += outer_product(place(item) - mean);
        }
    }
    let normal = least_axis(spread);
    let squares = normal.dot(spread * normal).max(0.0);
    square_root(squares / (places.len() as f64 - 4.0))
}

/// The distance from a sheet to the next one, along its normal: the low percentile over the samples. The far sheet shines
/// through wide gaps first, so a distance counts as (usual ÷ local spacing)² times as long. It is infinite where most
/// places have no other sheet near. `usual` is the usual spacing.
#[inline(never)]
pub(crate) fn next_sheet(
    neighbors: &Neighbors,
    samples: &[Sample],
    usual: f64,
) -> Result<f64, OutOfMemory> {
    let [near, far] = NEXT;
    let mut distances = with_capacity(PLACES)?;
    for Sample {
        place,
        normal,
        spacing,
        ..
    } in some(samples)
    {
        let next = neighbors.along(*place, *normal, *spacing, near * spacing, far * usual);
        let narrower = usual / spacing;
        distances.push(next * (narrower * narrower));
    }
    Ok(percentile(&distances, LOW)?.unwrap_or(f64::INFINITY))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::allocation::filled;
    use alloc::vec::Vec;

    #[test]
    fn sheets_lie_on_two_planes_and_noise_does_not() {
        let at = |k: usize, z: f64| DVec3::new((k % 6) as f64, (k / 6) as f64 + 0.1 * z, z);
        let mut order = filled(33, (0, 0)).unwrap();
        let mut off = |height: &dyn Fn(usize) -> f64| {
            let places: Vec<DVec3> = (0..33).map(|k| at(k, height(k))).collect();
            off_two_planes(&places, DVec3::Z, &mut order)
        };
        assert!(off(&|k| (k % 2) as f64) < 1e-9);
        assert!(off(&|k| ((k * 7) % 33) as f64 / 33.0) > 0.1);
    }
}
