//! View-independent statistics of a cloud: centroid, spread and spacing.
//!
//! All sums run over the distinct points in their canonical order (see
//! `spatial`), so permuting or duplicating the input changes no bit.

use alloc::vec::Vec;

use crate::error::Error;
use crate::points::Points;
use crate::spatial::Bounds;

/// Neighbors whose mean distance is a point's spacing.
const NEIGHBORS: usize = 6;
/// Points whose spacing is measured; beyond that the mean hardly moves.
const SAMPLES: usize = 2048;
/// Points in a leaf box, and boxes in a box one level up.
const LEAF: usize = 16;
const FANOUT: usize = 8;

/// What the automatic radius needs to know of a cloud.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Statistics {
    /// Distinct finite points.
    pub count: usize,
    /// Mean of the distinct points.
    pub centroid: [f64; 3],
    /// Mean squared distance from the centroid.
    pub variance: f64,
    /// Mean distance to the 6 nearest other points (to all others where there
    /// are fewer), averaged over an even sample; 0 below two points.
    pub spacing: f64,
}

impl Statistics {
    /// Measures `points`: distinct, finite, along the Hilbert curve.
    pub(crate) fn measure(points: &Points, bounds: &Bounds) -> Result<Self, Error> {
        if points.len() == 0 {
            return Ok(Self::default());
        }
        let count = points.len() as f64;
        // Sums relative to a corner of the box keep the detail of georeferenced clouds.
        let corner = bounds.min;
        let mut sum = [0.0; 3];
        for p in points.iter() {
            for axis in 0..3 {
                sum[axis] += p[axis] - corner[axis];
            }
        }
        let centroid: [f64; 3] = core::array::from_fn(|axis| corner[axis] + sum[axis] / count);
        let mut squares = 0.0;
        for p in points.iter() {
            squares += distance_squared(p, centroid);
        }
        Ok(Self {
            count: points.len(),
            centroid,
            variance: squares / count,
            spacing: mean_spacing(points)?,
        })
    }
}

pub(crate) fn distance_squared(a: [f64; 3], b: [f64; 3]) -> f64 {
    let v = [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    v[0] * v[0] + v[1] * v[1] + v[2] * v[2]
}

fn mean_spacing(points: &Points) -> Result<f64, Error> {
    let n = points.len();
    if n < 2 {
        return Ok(0.0);
    }
    let boxes = BoxTree::new(points)?;
    let samples = n.min(SAMPLES);
    let mut sum = 0.0;
    for sample in 0..samples {
        // The middle of each of `samples` even runs of the curve.
        let index = ((2 * sample as u64 + 1) * n as u64 / (2 * samples as u64)) as usize;
        let nearest = boxes.nearest(points, index);
        let mut distances = 0.0;
        for &squared in nearest.found() {
            distances += libm::sqrt(squared);
        }
        sum += distances / nearest.found().len() as f64;
    }
    Ok(sum / samples as f64)
}

/// Boxes over runs of the curve: level 0 over `LEAF` points each, every higher
/// level over `FANOUT` boxes of the level below.
struct BoxTree {
    levels: Vec<Vec<Bounds>>,
}

impl BoxTree {
    fn new(points: &Points) -> Result<Self, Error> {
        let mut level: Vec<Bounds> = Vec::new();
        level.try_reserve_exact(points.len().div_ceil(LEAF))?;
        for start in (0..points.len()).step_by(LEAF) {
            let mut bounds = Bounds::EMPTY;
            for index in start..points.len().min(start + LEAF) {
                bounds.include(points.get(index));
            }
            level.push(bounds);
        }
        let mut levels = Vec::new();
        while level.len() > FANOUT {
            let mut above: Vec<Bounds> = Vec::new();
            above.try_reserve_exact(level.len().div_ceil(FANOUT))?;
            for run in level.chunks(FANOUT) {
                let mut bounds = Bounds::EMPTY;
                for below in run {
                    bounds.union(below);
                }
                above.push(bounds);
            }
            levels.push(level);
            level = above;
        }
        levels.push(level);
        Ok(Self { levels })
    }

    /// The squared distances from point `query` to its nearest others.
    fn nearest(&self, points: &Points, query: usize) -> Nearest {
        let mut nearest = Nearest::new();
        // The query's own leaf first: it bounds the search from the start.
        let own = query / LEAF;
        nearest.scan_leaf(points, own, query);
        let top = self.levels.len() - 1;
        for root in 0..self.levels[top].len() {
            self.descend(points, top, root, query, own, &mut nearest);
        }
        nearest
    }

    fn descend(
        &self,
        points: &Points,
        level: usize,
        node: usize,
        query: usize,
        own: usize,
        nearest: &mut Nearest,
    ) {
        let bounds = &self.levels[level][node];
        if bounds.distance_squared(points.get(query)) >= nearest.worst() {
            return;
        }
        if level == 0 {
            if node != own {
                nearest.scan_leaf(points, node, query);
            }
            return;
        }
        let below = self.levels[level - 1].len();
        for child in node * FANOUT..((node + 1) * FANOUT).min(below) {
            self.descend(points, level - 1, child, query, own, nearest);
        }
    }
}

/// The smallest `NEIGHBORS` squared distances met so far, ascending.
struct Nearest {
    squared: [f64; NEIGHBORS],
    len: usize,
}

impl Nearest {
    fn new() -> Self {
        Self {
            squared: [f64::INFINITY; NEIGHBORS],
            len: 0,
        }
    }

    fn worst(&self) -> f64 {
        self.squared[NEIGHBORS - 1]
    }

    fn found(&self) -> &[f64] {
        &self.squared[..self.len]
    }

    fn scan_leaf(&mut self, points: &Points, leaf: usize, query: usize) {
        let center = points.get(query);
        let end = points.len().min((leaf + 1) * LEAF);
        for index in leaf * LEAF..end {
            if index != query {
                self.offer(distance_squared(center, points.get(index)));
            }
        }
    }

    fn offer(&mut self, squared: f64) {
        if squared < self.worst() || self.len < NEIGHBORS {
            let mut slot = self.len.min(NEIGHBORS - 1);
            while slot > 0 && self.squared[slot - 1] > squared {
                self.squared[slot] = self.squared[slot - 1];
                slot -= 1;
            }
            self.squared[slot] = squared;
            self.len = (self.len + 1).min(NEIGHBORS);
        }
    }
}
