//! The definition in four and more dimensions, one small linear program a point.
//!
//! λq ∉ K for every λ > 1 exactly when no sum Σ cⱼqⱼ = q with cⱼ ≥ 0 has Σ cⱼ < 1. The simplex
//! method finds the least Σ cⱼ. Its basis holds as many points as there are dimensions, and
//! their cone holds q. A point beyond their plane m·x = 1 enters the basis. At the end q is
//! hidden where m·q < 1. A point that was beyond one plane is likely to be beyond another, so
//! such points are tried first, and all others only before q is called visible (Clarkson: More
//! output-sensitive geometric algorithms, 1994).
//!
//! All of this is rounded. A point within `TOLERANCE` of the boundary is visible.

use alloc::vec::Vec;

use crate::base::allocation::{OutOfMemory, filled, push, reserve, with_capacity};
use crate::base::beat;

/// The tolerance of m·q − 1: the distance from the plane relative to the plane's own distance.
pub(super) const TOLERANCE: f64 = 1e-10;
/// A number that counts as 0 where coordinates have size 1.
const NOTHING: f64 = 1e-12;
/// The largest number of simplex steps for one point; about twenty are usual.
const MOST_STEPS: usize = 10_000;

/// Marks the visible points among flipped ones, which are rows of `dimension` numbers.
pub(super) fn mark_visible(q: &[f64], dimension: usize) -> Result<Vec<bool>, OutOfMemory> {
    let count = q.len() / dimension;
    let mut visible = filled(count, false)?;
    let frame = Frame::new(q, dimension)?;
    let rank = frame.corners.len();
    if rank == 0 {
        return Ok(visible);
    }
    let mut solver = Solver::new(&frame.points, &frame.corners)?;
    for (point, visible) in visible.iter_mut().enumerate() {
        *visible = solver.is_visible(point)?;
    }
    Ok(visible)
}

/// Points with as many coordinates as they span dimensions. Leaving out the other coordinates
/// maps their subspace one-to-one, and keeps rays, planes and convexity.
struct Frame {
    points: Vec<f64>,
    /// The points that span all, as many as there are dimensions.
    corners: Vec<usize>,
}

impl Frame {
    /// Elimination, with the largest pivot among all points and coordinates.
    fn new(q: &[f64], dimension: usize) -> Result<Self, OutOfMemory> {
        let largest = q.iter().fold(0.0f64, |most, x| most.max(x.abs()));
        let mut scaled: Vec<f64> = with_capacity(q.len())?;
        scaled.extend(q.iter().map(|x| x / largest));
        let mut rest: Vec<f64> = with_capacity(q.len())?;
        rest.extend_from_slice(&scaled);

        let mut corners = Vec::new();
        let mut kept = filled(dimension, false)?;
        while corners.len() < dimension && largest > 0.0 {
            let mut at = 0;
            for i in 0..rest.len() {
                if rest[i].abs() > rest[at].abs() {
                    at = i;
                }
            }
            if rest[at].abs() <= NOTHING {
                break;
            }
            let (corner, axis) = (at / dimension, at % dimension);
            corners.push(corner);
            kept[axis] = true;
            let pivot: Vec<f64> = rest[corner * dimension..][..dimension].to_vec();
            for row in rest.chunks_exact_mut(dimension) {
                let times = row[axis] / pivot[axis];
                for (x, p) in row.iter_mut().zip(&pivot) {
                    *x -= times * p;
                }
                row[axis] = 0.0;
            }
        }
        let mut points: Vec<f64> = with_capacity(q.len() / dimension * corners.len())?;
        for row in scaled.chunks_exact(dimension) {
            let kept = row.iter().zip(&kept).filter(|(_, kept)| **kept);
            points.extend(kept.map(|(x, _)| x));
        }
        Ok(Self { points, corners })
    }
}

struct Solver<'a> {
    points: &'a [f64],
    rank: usize,
    /// The inverse of the basis of the spanning corners.
    start: Vec<f64>,
    /// Points that were beyond some plane.
    likely: Vec<usize>,
    /// The inverse of the present basis, row by row, and the share of each of its points in
    /// the sum.
    inverse: Vec<f64>,
    shares: Vec<f64>,
    plane: Vec<f64>,
    direction: Vec<f64>,
}

impl<'a> Solver<'a> {
    fn new(points: &'a [f64], corners: &'a [usize]) -> Result<Self, OutOfMemory> {
        let rank = corners.len();
        let mut solver = Self {
            points,
            rank,
            start: filled(rank * rank, 0.0)?,
            likely: Vec::new(),
            inverse: filled(rank * rank, 0.0)?,
            shares: filled(rank, 0.0)?,
            plane: filled(rank, 0.0)?,
            direction: filled(rank, 0.0)?,
        };
        reserve(&mut solver.likely, rank)?;
        solver.likely.extend_from_slice(corners);
        // The corners replace the unit vectors one by one, each where it fits best.
        for i in 0..rank {
            solver.inverse[i * rank + i] = 1.0;
        }
        let mut taken = filled(rank, false)?;
        for &corner in corners {
            solver.aim(corner);
            let free = (0..rank).filter(|&row| !taken[row]);
            let size = |row: &usize| solver.direction[*row].abs();
            let Some(row) = free.max_by(|a, b| size(a).total_cmp(&size(b))) else {
                break;
            };
            taken[row] = true;
            solver.replace(row);
        }
        solver.start.copy_from_slice(&solver.inverse);
        Ok(solver)
    }

    #[inline]
    fn at(&self, point: usize) -> &'a [f64] {
        &self.points[point * self.rank..][..self.rank]
    }

    fn is_visible(&mut self, query: usize) -> Result<bool, OutOfMemory> {
        self.begin(query);
        if self.direction.iter().all(|x| x.abs() <= NOTHING) {
            return Ok(false); // At the viewpoint once flipped: no ray leaves there.
        }
        for _ in 0..MOST_STEPS {
            beat::steps(1 + self.points.len() / 64);
            self.find_plane();
            let beyond = match self.farthest_beyond(self.likely.iter().copied()) {
                Some(point) => point,
                None if self.height(query) < 1.0 - TOLERANCE => return Ok(false),
                None => match self.farthest_beyond(0..self.points.len() / self.rank) {
                    Some(point) => {
                        push(&mut self.likely, point)?;
                        point
                    }
                    None => return Ok(true),
                },
            };
            if !self.enter(beyond) {
                break;
            }
        }
        self.find_plane();
        Ok(self.height(query) >= 1.0 - TOLERANCE)
    }

    /// A basis of `query` and corners. The sum is moved a little into their cone, by a different
    /// amount for each. So every step gains, and no basis comes twice.
    fn begin(&mut self, query: usize) {
        self.inverse.copy_from_slice(&self.start);
        self.aim(query);
        let size = |row: &usize| self.direction[*row].abs();
        let row = (0..self.rank).max_by(|a, b| size(a).total_cmp(&size(b)));
        let row = row.unwrap_or(0);
        for (k, share) in self.shares.iter_mut().enumerate() {
            *share = 1e-12 * (1.0 + 0.618 * (k + 1) as f64);
        }
        self.shares[row] = 1.0;
        if self.direction[row].abs() > NOTHING {
            self.replace(row);
        }
    }

    /// Sets `direction` to the shares of the basis that make up `point`.
    fn aim(&mut self, point: usize) {
        let place = self.at(point);
        let rows = self.inverse.chunks_exact(self.rank);
        for (share, row) in self.direction.iter_mut().zip(rows) {
            *share = dot(row, place);
        }
    }

    /// Replaces row `row` of the basis by the point that `direction` belongs to.
    fn replace(&mut self, row: usize) {
        let rank = self.rank;
        let pivot = self.direction[row];
        for k in 0..rank {
            self.inverse[row * rank + k] /= pivot;
        }
        for other in (0..rank).filter(|&other| other != row) {
            let times = self.direction[other];
            for k in 0..rank {
                self.inverse[other * rank + k] -= times * self.inverse[row * rank + k];
            }
        }
    }

    /// The plane m·x = 1 through the basis.
    fn find_plane(&mut self) {
        self.plane.fill(0.0);
        for row in self.inverse.chunks_exact(self.rank) {
            for (m, x) in self.plane.iter_mut().zip(row) {
                *m += x;
            }
        }
    }

    #[inline]
    fn height(&self, point: usize) -> f64 {
        dot(&self.plane, self.at(point))
    }

    fn farthest_beyond(&self, points: impl Iterator<Item = usize>) -> Option<usize> {
        let mut most = 1.0 + 0.1 * TOLERANCE;
        let mut farthest = None;
        for point in points {
            let height = self.height(point);
            if height > most {
                most = height;
                farthest = Some(point);
            }
        }
        farthest
    }

    /// Takes `point` into the basis, in place of the point whose share reaches 0 first; false
    /// where rounding leaves no such point.
    fn enter(&mut self, point: usize) -> bool {
        self.aim(point);
        let mut leaving: Option<(f64, usize)> = None;
        for row in 0..self.rank {
            let use_up = self.direction[row];
            if use_up > NOTHING {
                let step = self.shares[row] / use_up;
                if leaving.is_none_or(|(least, _)| step < least) {
                    leaving = Some((step, row));
                }
            }
        }
        let Some((step, row)) = leaving else {
            return false;
        };
        for (share, use_up) in self.shares.iter_mut().zip(&self.direction) {
            *share = (*share - step * use_up).max(0.0);
        }
        self.shares[row] = step;
        self.replace(row);
        true
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |sum, (x, y)| sum + x * y)
}
