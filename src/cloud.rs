//! The cloud: checked positions in spatial order, duplicates grouped, and what
//! does not depend on the viewpoint. Built once, asked many times.

use alloc::vec::Vec;
use core::fmt;

use crate::error::Error;
use crate::points::{Points, Position};
use crate::spacing::Statistics;
use crate::spatial::{Bounds, HilbertCurve, sort_by_coordinates};

/// The largest number of points in one cloud: hull faces are numbered in 30
/// bits, and a hull has up to two faces a point.
pub const MAX_POINTS: usize = 1 << 28;

/// What becomes of points with a NaN or infinite coordinate.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum NonFinite {
    /// The cloud is refused with [`Error::NonFinite`].
    #[default]
    Error,
    /// They keep their indices, are never visible and hide nothing.
    Skip,
}

/// A point cloud, prepared for visibility queries.
///
/// Building costs one sort, O(n log n); each query reuses it. Memory: 16 bytes
/// a point for `f32` positions, 28 for `f64`.
pub struct PointCloud {
    /// Distinct finite points along the Hilbert curve.
    pub(crate) points: Points,
    /// The caller's indices in the order of `points`, equal points side by side.
    order: Vec<u32>,
    /// Where each distinct point's indices start in `order`, with an end mark;
    /// empty where no two points are equal, and `order[k]` is the only one.
    starts: Vec<u32>,
    len: usize,
    skipped: usize,
    pub(crate) statistics: Statistics,
}

impl PointCloud {
    /// Prepares `positions`, in any units.
    ///
    /// # Errors
    /// [`Error::NonFinite`], [`Error::TooManyPoints`], [`Error::OutOfMemory`].
    pub fn new<P: Position>(positions: &[P]) -> Result<Self, Error> {
        Self::with_non_finite(positions, NonFinite::Error)
    }

    /// Like [`PointCloud::new`], with a choice about points that are not finite.
    ///
    /// # Errors
    /// As [`PointCloud::new`].
    pub fn with_non_finite<P: Position>(
        positions: &[P],
        non_finite: NonFinite,
    ) -> Result<Self, Error> {
        if positions.len() > MAX_POINTS {
            return Err(Error::TooManyPoints {
                count: positions.len(),
            });
        }
        let (bounds, skipped) = survey(positions, non_finite)?;
        let keyed = sort_along_curve(positions, &bounds, positions.len() - skipped)?;

        let mut points: Vec<P> = Vec::new();
        let mut order = Vec::new();
        let mut starts = Vec::new();
        points.try_reserve_exact(keyed.len())?;
        order.try_reserve_exact(keyed.len())?;
        let mut previous = None;
        for &(_, index) in &keyed {
            let point = positions[index as usize].without_negative_zero();
            if previous != Some(point.widen()) {
                previous = Some(point.widen());
                if !starts.is_empty() {
                    starts.try_reserve(1)?;
                    starts.push(order.len() as u32);
                }
                points.push(point);
            } else if starts.is_empty() {
                // The first duplicate: until here, every group held one index.
                starts.try_reserve(points.len())?;
                starts.extend(0..points.len() as u32);
            }
            order.push(index);
        }
        if !starts.is_empty() {
            starts.try_reserve(1)?;
            starts.push(order.len() as u32);
        }
        drop(keyed);

        let points = P::store(points);
        let statistics = Statistics::measure(&points, &bounds)?;
        Ok(Self {
            points,
            order,
            starts,
            len: positions.len(),
            skipped,
            statistics,
        })
    }

    /// How many points were given, skipped ones included.
    #[must_use]
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether no points were given.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// How many points were left out because they are not finite.
    #[must_use]
    pub fn skipped(&self) -> usize {
        self.skipped
    }

    /// The caller's indices of distinct point `k`.
    pub(crate) fn indices_of(&self, k: usize) -> &[u32] {
        if self.starts.is_empty() {
            &self.order[k..=k]
        } else {
            &self.order[self.starts[k] as usize..self.starts[k + 1] as usize]
        }
    }
}

impl fmt::Debug for PointCloud {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("PointCloud")
            .field("len", &self.len)
            .field("skipped", &self.skipped)
            .finish_non_exhaustive()
    }
}

/// Checks every coordinate; returns the box of the finite points and how many are not.
fn survey<P: Position>(positions: &[P], non_finite: NonFinite) -> Result<(Bounds, usize), Error> {
    let mut bounds = Bounds::EMPTY;
    let mut bad = 0;
    let mut first = 0;
    for (index, position) in positions.iter().enumerate() {
        let p = position.widen();
        if is_finite(p) {
            bounds.include(p);
        } else {
            if bad == 0 {
                first = index;
            }
            bad += 1;
        }
    }
    if bad > 0 && non_finite == NonFinite::Error {
        return Err(Error::NonFinite { count: bad, first });
    }
    Ok((bounds, bad))
}

fn is_finite(p: [f64; 3]) -> bool {
    p.iter().all(|x| x.is_finite())
}

/// The finite points' indices along the curve, ties by coordinates, then by index.
fn sort_along_curve<P: Position>(
    positions: &[P],
    bounds: &Bounds,
    finite: usize,
) -> Result<Vec<(u64, u32)>, Error> {
    let curve = HilbertCurve::new(bounds);
    let mut keyed: Vec<(u64, u32)> = Vec::new();
    keyed.try_reserve_exact(finite)?;
    for (index, position) in positions.iter().enumerate() {
        let p = position.widen();
        if is_finite(p) {
            keyed.push((curve.key(p), index as u32));
        }
    }
    keyed.sort_unstable();
    // What shares a cell, mostly duplicates: along a curve inside it, and then by
    // coordinates.
    let point = |index: u32| positions[index as usize].without_negative_zero().widen();
    let mut same_key = Vec::new();
    for cell in runs_of_equal_keys(&mut keyed) {
        for (key, index) in cell.iter_mut() {
            *key = curve.key_in_cell(point(*index));
        }
        cell.sort_unstable();
        for run in runs_of_equal_keys(cell) {
            same_key.clear();
            same_key.try_reserve(run.len())?;
            same_key.extend(run.iter().map(|&(_, index)| (point(index), index)));
            sort_by_coordinates(&mut same_key);
            for (slot, &(_, index)) in run.iter_mut().zip(&same_key) {
                slot.1 = index;
            }
        }
    }
    Ok(keyed)
}

fn runs_of_equal_keys(keyed: &mut [(u64, u32)]) -> impl Iterator<Item = &mut [(u64, u32)]> {
    keyed
        .chunk_by_mut(|a, b| a.0 == b.0)
        .filter(|run| run.len() > 1)
}
