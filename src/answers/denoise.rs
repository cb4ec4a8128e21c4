//! Removes noise that is the same everywhere: points move to the plane of their neighbors. Looks are at the moved points.

use alloc::vec::Vec;
use glam::DVec3;

use crate::base::allocation::{OutOfMemory, with_capacity};
use crate::cloud::neighbors::{Nearest, Neighbors};
use crate::cloud::plane::{least_axis, outer_product};
use crate::cloud::point_cloud::PointCloud;
use crate::cloud::points::Points;

impl PointCloud {
    /// The cloud in which every point is projected on the least-squares plane of itself and its `k` nearest other
    /// points. Indices stay. Equal points count once.
    pub(crate) fn denoised(&self, k: usize) -> Result<Self, OutOfMemory> {
        let points = &self.sequence.points;
        let neighbors = Neighbors::new(points)?;
        let mut nearest = Nearest::with_capacity(k)?;
        let mut moved: Vec<[f64; 3]> = with_capacity(points.len())?;
        for point in 0..points.len() {
            neighbors.find(point, &mut nearest);
            moved.push(on_plane(points.get(point), &nearest, points));
        }
        self.moved(&moved)
    }
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
