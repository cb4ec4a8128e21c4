//! The definition in four and more dimensions, one small linear program a point.
//!
//! λq ∉ K for every λ > 1 exactly if some plane holds q, has the origin below it and no point
//! above it: m·q = 1 and m·(p − q) ≤ 0 for every p. The simplex method looks for it. Its basis
//! holds q and as many other points as a plane through q needs. A point above the plane enters the
//! basis. If no other point can leave for it, then these points hold a point of q's ray beyond q,
//! and q is hidden. A point that was above one plane is likely to be above another, so such points
//! are tried first, and all others only before q is called visible (Clarkson: More
//! output-sensitive geometric algorithms, 1994).
//!
//! The steps are rounded, their end is proved. Any plane is good for a visible point, if all
//! others are below it by more than rounding. In all other cases the last basis is inverted
//! exactly, and further steps are exact.

use alloc::vec::Vec;

use crate::base::allocation::{OutOfMemory, fill, filled, push, reserve};
use crate::base::beat;
use crate::dimensions::flat::{Frame, Plane, subtract};
use crate::dimensions::residues::Exact;

/// A share of a vector in a basis that counts as 0 in rounded steps.
const NOTHING: f64 = 1e-11;
/// The largest number of rounded steps for one point; about twenty are usual.
const MOST_STEPS: usize = 1_000;
/// After so many exact steps the points with the lowest numbers are exchanged, which ends for sure
/// (Bland's rule).
const PATIENCE: usize = 50;

/// Marks the visible points among `count` flipped ones.
pub(super) fn mark_visible(frame: Frame, count: usize) -> Result<Vec<bool>, OutOfMemory> {
    let mut visible = filled(count, false)?;
    if frame.corners.is_empty() {
        return Ok(visible); // All points are at the viewpoint once flipped: no ray leaves there.
    }
    let mut solver = Solver::new(frame, count)?;
    for (point, visible) in visible.iter_mut().enumerate() {
        *visible = solver.is_visible(point)?;
    }
    Ok(visible)
}

struct Solver {
    /// The points, and the viewpoint as one more.
    points: Vec<f64>,
    count: usize,
    rank: usize,
    corners: Vec<usize>,
    exact: Exact,
    /// Points that were above some plane.
    likely: Vec<usize>,
    /// The point in question. It is in the basis as it is, other points as differences from it.
    query: usize,
    basis: Vec<usize>,
    /// The inverse of the basis, row by row, if it is not stale.
    inverse: Vec<f64>,
    stale: bool,
    /// How much of each difference in the basis makes up a vector that stays the same. So every
    /// step gains, and no basis comes twice.
    shares: Vec<f64>,
    direction: Vec<f64>,
    plane: Plane,
}

/// A look at all points from a plane.
enum Found {
    Above(usize),
    AllBelow,
    Doubt,
}

impl Solver {
    fn new(frame: Frame, count: usize) -> Result<Self, OutOfMemory> {
        let rank = frame.corners.len();
        let mut points = frame.points;
        reserve(&mut points, rank)?;
        points.resize((count + 1) * rank, 0.0);
        let mut solver = Self {
            points,
            count,
            rank,
            corners: frame.corners,
            exact: Exact::new(frame.integers),
            likely: Vec::new(),
            query: count,
            basis: Vec::new(),
            inverse: Vec::new(),
            stale: true,
            shares: Vec::new(),
            direction: Vec::new(),
            plane: Plane::default(),
        };
        solver.exact.prepare()?;
        fill(&mut solver.basis, rank, 0)?;
        fill(&mut solver.inverse, rank * rank, 0.0)?;
        fill(&mut solver.shares, rank, 0.0)?;
        fill(&mut solver.direction, rank, 0.0)?;
        fill(&mut solver.plane.normal, rank, 0.0)?;
        reserve(&mut solver.likely, rank)?;
        solver.likely.extend_from_slice(&solver.corners);
        Ok(solver)
    }

    fn at(&self, point: usize) -> &[f64] {
        &self.points[point * self.rank..][..self.rank]
    }

    fn is_visible(&mut self, query: usize) -> Result<bool, OutOfMemory> {
        if self.at(query).iter().all(|&x| x == 0.0) {
            return Ok(false); // At the viewpoint once flipped: no ray leaves there.
        }
        self.begin(query);
        for (k, share) in self.shares.iter_mut().enumerate() {
            *share = 1.0 + 0.618 * (k + 1) as f64 % 1.0;
        }
        let mut above = None;
        for _ in 0..MOST_STEPS {
            beat::steps(1 + self.points.len() / 64);
            self.find_plane();
            above = self.highest(self.likely.iter().copied());
            if above.is_none() {
                match self.look_at_all() {
                    Found::Above(point) => {
                        push(&mut self.likely, point)?;
                        above = Some(point);
                    }
                    Found::AllBelow => return Ok(true),
                    Found::Doubt => break,
                }
            }
            if !above.is_some_and(|point| self.enter(point)) {
                break;
            }
        }
        self.is_visible_exactly(above)
    }

    /// Takes the basis of the last point, with `query` in place of the point that it can replace
    /// best.
    fn begin(&mut self, query: usize) {
        self.aim_at_place(query);
        if self.stale || !self.direction.iter().all(|share| share.is_finite()) {
            self.take_corners();
            self.aim_at_place(query);
        }
        let row = self.largest_share(0);
        self.query = query;
        self.exchange(row);
        self.build();
    }

    /// Sets `direction` to the shares of the basis points' places that make up the place of
    /// `point`.
    fn aim_at_place(&mut self, point: usize) {
        let query = core::mem::replace(&mut self.query, self.count);
        self.aim(point);
        if query != self.count {
            let others: f64 = self.direction[1..].iter().sum();
            self.direction[0] -= others;
        }
        self.query = query;
    }

    /// The row, from `first` on, with the largest share.
    #[inline(never)]
    fn largest_share(&self, first: usize) -> usize {
        let size = |row: &usize| self.direction[*row].abs();
        let row = (first..self.rank).max_by(|a, b| size(a).total_cmp(&size(b)));
        row.unwrap_or(first)
    }

    /// Takes all corners as the basis.
    fn take_corners(&mut self) {
        self.stale = false;
        self.query = self.count;
        self.basis.copy_from_slice(&self.corners);
        self.build();
    }

    /// Puts the point in question into the basis.
    fn exchange(&mut self, place: usize) {
        self.basis[place] = self.query;
        self.basis.swap(0, place);
    }

    /// Inverts the basis. Its points replace the unit vectors one by one, each where it fits best.
    #[inline(never)]
    fn build(&mut self) {
        let rank = self.rank;
        self.inverse.fill(0.0);
        for k in 0..rank {
            self.inverse[k * rank + k] = 1.0;
        }
        for place in 0..rank {
            // Rows before `place` are taken.
            self.aim(self.basis[place]);
            let row = self.largest_share(place);
            self.direction.swap(row, place);
            for k in 0..rank {
                self.inverse.swap(row * rank + k, place * rank + k);
            }
            self.replace(place);
        }
    }

    /// Sets `direction` to the shares of the basis that make up `point`.
    #[inline(never)]
    fn aim(&mut self, point: usize) {
        let origin = if point == self.query {
            self.count
        } else {
            self.query
        };
        let at = |point| &self.points[point * self.rank..][..self.rank];
        let (place, origin) = (at(point), at(origin));
        let rows = self.inverse.chunks_exact(self.rank);
        for (share, row) in self.direction.iter_mut().zip(rows) {
            let axes = row.iter().zip(place).zip(origin);
            *share = axes.fold(0.0, |sum, ((x, p), o)| sum + x * (p - o));
        }
    }

    /// Replaces row `row` of the basis by the vector that `direction` belongs to.
    #[inline(never)]
    fn replace(&mut self, row: usize) {
        let pivot = self.direction[row];
        let (before, rest) = self.inverse.split_at_mut(row * self.rank);
        let (own, after) = rest.split_at_mut(self.rank);
        own.iter_mut().for_each(|x| *x /= pivot);
        let others = before.chunks_exact_mut(self.rank);
        let others = others.chain(after.chunks_exact_mut(self.rank));
        let shares = self.direction.iter().enumerate();
        let shares = shares.filter(|(other, _)| *other != row);
        for (other, (_, &times)) in others.zip(shares) {
            subtract(other, times, own);
        }
    }

    /// The plane through the basis.
    fn find_plane(&mut self) {
        let row = &self.inverse[..self.rank];
        self.plane.normal.copy_from_slice(row);
        self.plane
            .bound(0.0, &self.points[self.query * self.rank..][..self.rank]);
    }

    /// The highest of these points that are above the plane for sure.
    fn highest(&self, points: impl Iterator<Item = usize>) -> Option<usize> {
        let mut most = 0.0;
        let mut highest = None;
        let query = self.at(self.query);
        for point in points {
            let place = self.at(point);
            if self.plane.product(place) <= self.plane.below + most {
                continue;
            }
            let (height, error) = self.plane.height(place, query);
            if height > error && height > most {
                most = height;
                highest = Some(point);
            }
        }
        highest
    }

    /// Turns the plane a little, so that the other points of the basis are below it, and looks
    /// whether all others are.
    fn look_at_all(&mut self) -> Found {
        let rank = self.rank;
        let mut turned = Plane::default();
        core::mem::swap(&mut turned.normal, &mut self.direction);
        turned.normal.copy_from_slice(&self.plane.normal);
        for place in 1..rank {
            let (height, error) = self
                .plane
                .height(self.at(self.basis[place]), self.at(self.query));
            let row = &self.inverse[place * rank..][..rank];
            subtract(&mut turned.normal, height + 4.0 * error, row);
        }
        let query = self.at(self.query);
        turned.bound(0.0, query);
        let (mut most, mut found) = (0.0, Found::AllBelow);
        let places = self.points.chunks_exact(rank);
        for (point, place) in places.take(self.count).enumerate() {
            if turned.product(place) < turned.below {
                continue;
            }
            let (height, error) = turned.height(place, query);
            if height < -error || point == self.query {
                continue;
            }
            let (height, error) = self.plane.height(place, query);
            if height > error && height > most {
                most = height;
                found = Found::Above(point);
            } else if most == 0.0 {
                found = Found::Doubt;
            }
        }
        core::mem::swap(&mut turned.normal, &mut self.direction);
        found
    }

    /// Takes `point` into the basis, in place of the point whose share reaches 0 first; false
    /// where there is no such point.
    fn enter(&mut self, point: usize) -> bool {
        self.aim(point);
        let sizes = self.direction[1..].iter().map(|share| share.abs());
        let nothing = NOTHING * sizes.fold(0.0, f64::max);
        let mut leaving: Option<(f64, usize)> = None;
        for row in 1..self.rank {
            let use_up = self.direction[row];
            if use_up > nothing {
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
        self.basis[row] = point;
        true
    }

    /// Goes on from the present basis with exact signs; `above` is a point that may be above its
    /// plane.
    fn is_visible_exactly(&mut self, mut above: Option<usize>) -> Result<bool, OutOfMemory> {
        let mut left_out = 0;
        while !self.exact.invert(&self.basis, self.query) {
            // Rounding has lost the basis. One of these is a basis, since the corners are.
            self.basis.copy_from_slice(&self.corners);
            self.exchange(left_out % self.rank);
            self.stale = true;
            left_out += 1;
        }
        for step in 0.. {
            let hint = above.take();
            let hint = hint.filter(|&point| self.exact.share(point, 0) > 0.0);
            let Some(point) = hint.or_else(|| self.above_exactly(step > PATIENCE)) else {
                return Ok(true);
            };
            let uses_up = |row: &usize| self.exact.share(point, *row) > 0.0;
            let rows = (1..self.rank).filter(uses_up);
            let Some(row) = rows.min_by_key(|&row| self.basis[row]) else {
                return Ok(false);
            };
            self.basis[row] = point;
            self.stale = true;
            // False where a prime had to be exchanged.
            while !self.exact.invert(&self.basis, self.query) {}
        }
        Ok(false)
    }

    /// The highest point above the plane through the basis, or the first one.
    fn above_exactly(&mut self, first: bool) -> Option<usize> {
        for axis in 0..self.rank {
            self.plane.normal[axis] = self.exact.plane_at(axis);
        }
        let query = self.query * self.rank;
        let relative = self.exact.error();
        self.plane
            .bound(relative, &self.points[query..][..self.rank]);
        let (mut most, mut highest) = (0.0, None);
        for point in (0..self.count).filter(|&point| point != self.query) {
            if self.plane.product(self.at(point)) < self.plane.below {
                continue;
            }
            let (mut height, error) = self.plane.height(self.at(point), self.at(self.query));
            // A height that is not a number is in doubt, too.
            let certain = height.abs() > error;
            if !certain {
                height = self.exact.share(point, 0);
            }
            if height > most {
                (most, highest) = (height, Some(point));
                if first {
                    break;
                }
            }
        }
        highest
    }
}
