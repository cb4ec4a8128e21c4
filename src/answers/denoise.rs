//! Noise handling. Before a view, points move to the plane of their neighbors. After the view,
//! neighbors vote.

use alloc::vec::Vec;
use glam::DVec3;

use crate::base::allocation::with_capacity;
use crate::base::error::{Error, in_range};
use crate::cloud::neighbors::{Nearest, Neighbors};
use crate::cloud::plane::{least_axis, outer_product};
use crate::cloud::point_cloud::{PointCloud, Voters};
use crate::cloud::points::Points;
use crate::view::options::Options;

/// A point is voted visible when more than this many fifths of itself and its neighbors are
/// visible. The share is 0.4 rather than a half, because the operator has more false negatives
/// than false positives.
const FIFTHS: usize = 2;

/// Neighbors are kept for later views only where a point has at most this many.
const MOST_KEPT: usize = 64;

impl PointCloud {
    /// The denoised cloud, for many views. [`Options::denoise`] asks the same cloud. Every point is
    /// projected on the least-squares plane of itself and its `k` nearest other points. Indices
    /// stay. Equal points count once. Where there are fewer than `k` distinct other points, all of
    /// them count.
    ///
    /// Takes O(n (log n + k²)) time, some microseconds a point.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] unless 1 ≤ `k` < the number of present points;
    /// [`Error::OutOfMemory`].
    pub fn denoised(&self, k: usize) -> Result<Self, Error> {
        let mut moved: Vec<[f64; 3]> = with_capacity(self.sequence.points.len())?;
        self.for_each_neighborhood("denoise", k, &mut |point, nearest| {
            let points = &self.sequence.points;
            moved.push(on_plane(points.get(point), nearest, points));
        })?;
        Ok(self.moved(&moved)?)
    }

    /// Keeps the neighbors that vote, if the options ask for a vote.
    pub(crate) fn keep_voters(&mut self, options: &Options) -> Result<(), Error> {
        let Some(k) = options.vote.filter(|&k| k <= MOST_KEPT) else {
            return Ok(());
        };
        if self.kept.voters.as_ref().is_none_or(|voters| voters.k != k) {
            self.kept.voters = None;
            self.kept.voters = Some(self.voters(k)?);
        }
        Ok(())
    }

    /// Every distinct point and its `k` nearest other points vote on whether it is visible.
    pub(crate) fn vote(&self, k: usize, visible: &[bool]) -> Result<Vec<bool>, Error> {
        if let Some(voters) = self.kept.voters.as_ref().filter(|voters| voters.k == k) {
            return voters.vote(visible);
        }
        let mut voted: Vec<bool> = with_capacity(visible.len())?;
        self.for_each_neighborhood("vote", k, &mut |point, nearest| {
            let others = nearest.found().iter().map(|other| other.index);
            voted.push(is_voted(point, others, visible));
        })?;
        Ok(voted)
    }

    /// The `k` nearest other points of every distinct point.
    pub(crate) fn voters(&self, k: usize) -> Result<Voters, Error> {
        let points = self.sequence.points.len();
        let each = k.min(points.saturating_sub(1));
        let mut others: Vec<u32> = with_capacity(points.saturating_mul(each))?;
        self.for_each_neighborhood("vote", k, &mut |_, nearest| {
            others.extend(nearest.found().iter().map(|other| other.index));
        })?;
        Ok(Voters { k, each, others })
    }

    /// Refuses a number of neighbors that is larger than the number of other points.
    pub(crate) fn check_neighbors(&self, option: &'static str, k: usize) -> Result<(), Error> {
        let most = self.sequence.present().saturating_sub(1);
        in_range(option, k as f64, 1.0, most as f64)?;
        Ok(())
    }

    /// Visits the distinct points in their order, each with its `k` nearest other points.
    fn for_each_neighborhood(
        &self,
        option: &'static str,
        k: usize,
        visit: &mut dyn FnMut(usize, &Nearest),
    ) -> Result<(), Error> {
        self.check_neighbors(option, k)?;
        let points = &self.sequence.points;
        let neighbors = Neighbors::new(points)?;
        let mut nearest = Nearest::with_capacity(k)?;
        for point in 0..points.len() {
            neighbors.find(point, &mut nearest);
            visit(point, &nearest);
        }
        Ok(())
    }
}

impl Voters {
    /// Every distinct point and its neighbors vote on whether it is visible.
    pub(crate) fn vote(&self, visible: &[bool]) -> Result<Vec<bool>, Error> {
        let mut voted: Vec<bool> = with_capacity(visible.len())?;
        voted.extend((0..visible.len()).map(|point| {
            let others = &self.others[point * self.each..][..self.each];
            is_voted(point, others.iter().copied(), visible)
        }));
        Ok(voted)
    }
}

fn is_voted(point: usize, others: impl ExactSizeIterator<Item = u32>, visible: &[bool]) -> bool {
    let voters = others.len() + 1;
    let seen =
        others.filter(|&other| visible[other as usize]).count() + usize::from(visible[point]);
    5 * seen > FIFTHS * voters
}

/// `p` projected on the least-squares plane of itself and `nearest`; `p` where that overflows.
pub(crate) fn on_plane(p: [f64; 3], nearest: &Nearest, points: &Points) -> [f64; 3] {
    let p = DVec3::from_array(p);
    // Coordinates relative to p keep the detail of georeferenced clouds.
    let others = || {
        nearest
            .found()
            .iter()
            .map(|other| DVec3::from_array(points.get(other.index as usize)) - p)
    };
    let count = nearest.found().len() as f64 + 1.0;
    let mean = others().fold(DVec3::ZERO, |sum, v| sum + v) / count;
    let mut covariance = outer_product(-mean);
    for v in others() {
        covariance += outer_product(v - mean);
    }
    let normal = least_axis(covariance);
    let moved = p + normal * normal.dot(mean);
    if moved.is_finite() { moved } else { p }.to_array()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::real::square_root;
    use crate::cloud::points::Given;
    use crate::cloud::sequence::Sequence;
    use crate::cloud::spatial::{Bounds, HilbertCurve};

    #[test]
    fn a_point_above_a_lattice_moves_most_of_the_way_down() {
        for tilt in [0.0, 0.75] {
            // A slope, and one point a little above it along its normal.
            let length = square_root(1.0 + tilt * tilt);
            let mut points = alloc::vec![[-0.5 * tilt / length, 0.0, 0.5 / length]];
            for i in 0..49 {
                let [x, y] = [i % 7, i / 7].map(|x| f64::from(x as u8) - 3.0);
                if i != 24 {
                    points.push([x, y, tilt * x]);
                }
            }
            let mut bounds = Bounds::EMPTY;
            points.iter().for_each(|&p| bounds.include(p));
            let curve = HilbertCurve::new(&bounds);
            let sorted = Sequence::sorted(Given::Double(&points), 0, points.len(), &curve).unwrap();
            let neighbors = Neighbors::new(&sorted.points).unwrap();
            let query = sorted.points.iter().position(|p| p == points[0]).unwrap();
            let mut nearest = Nearest::with_capacity(48).unwrap();
            neighbors.find(query, &mut nearest);
            // The plane runs through the mean of all 49.
            let left = on_plane(points[0], &nearest, &sorted.points).map(|x| x * length);
            let expected = [-0.5 * tilt, 0.0, 0.5].map(|x| x / 49.0);
            for (a, b) in left.into_iter().zip(expected) {
                assert!((a - b).abs() < 1e-2 * (1.0 + tilt), "{left:?}");
            }
        }
    }
}
