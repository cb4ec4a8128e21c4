//! The nearest neighbors of points, by boxes over runs of the Hilbert curve.
//!
//! The order of the points is the index. Level 0 holds boxes over `LEAF` points each, every
//! higher level boxes over `FANOUT` boxes of the level below: 4 bytes a point. Coordinates
//! break ties, so that neighbors depend on the set of points alone.

use alloc::vec::Vec;

use crate::base::allocation::{OutOfMemory, with_capacity};
use crate::cloud::points::Points;
use crate::cloud::spatial::Bounds;

/// Points in a leaf box, and boxes in a box one level up.
const LEAF: usize = 16;
const FANOUT: usize = 8;

pub(crate) fn distance_squared(a: [f64; 3], b: [f64; 3]) -> f64 {
    let v = [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    v[0] * v[0] + v[1] * v[1] + v[2] * v[2]
}

/// Answers which points are nearest to one of them.
pub(crate) struct Neighbors<'a> {
    points: &'a Points,
    levels: Vec<Vec<Bounds>>,
}

impl<'a> Neighbors<'a> {
    /// The index of distinct `points`, which are in the order of the Hilbert curve.
    pub(crate) fn new(points: &'a Points) -> Result<Self, OutOfMemory> {
        let mut level: Vec<Bounds> = with_capacity(points.len().div_ceil(LEAF))?;
        for start in (0..points.len()).step_by(LEAF) {
            let mut bounds = Bounds::EMPTY;
            for index in start..points.len().min(start + LEAF) {
                bounds.include(points.get(index));
            }
            level.push(bounds);
        }
        let mut levels = Vec::new();
        while level.len() > FANOUT {
            let mut above: Vec<Bounds> = with_capacity(level.len().div_ceil(FANOUT))?;
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
        Ok(Self { points, levels })
    }

    /// Fills `nearest` with the nearest other points of point `query`. It takes as many as it has
    /// room for, or all of them.
    pub(crate) fn find(&self, query: usize, nearest: &mut Nearest) {
        nearest.found.clear();
        // The leaf of the query comes first, then its neighbors, level by level. So a small
        // bound is known before far boxes are looked at.
        let mut own = query / LEAF;
        self.scan_leaf(own, query, nearest);
        for (level, boxes) in self.levels.iter().enumerate() {
            let is_top = level + 1 == self.levels.len();
            let first = if is_top { 0 } else { own / FANOUT * FANOUT };
            let end = if is_top { boxes.len() } else { first + FANOUT };
            for node in first..end.min(boxes.len()) {
                if node != own {
                    self.descend(level, node, query, nearest);
                }
            }
            own /= FANOUT;
        }
    }

    fn descend(&self, level: usize, node: usize, query: usize, nearest: &mut Nearest) {
        let bounds = &self.levels[level][node];
        // A box at exactly the worst distance may hold a point that wins the tie.
        if bounds.distance_squared(self.points.get(query)) > nearest.worst() {
            return;
        }
        if level == 0 {
            return self.scan_leaf(node, query, nearest);
        }
        let below = self.levels[level - 1].len();
        for child in node * FANOUT..((node + 1) * FANOUT).min(below) {
            self.descend(level - 1, child, query, nearest);
        }
    }

    fn scan_leaf(&self, leaf: usize, query: usize, nearest: &mut Nearest) {
        let center = self.points.get(query);
        let end = self.points.len().min((leaf + 1) * LEAF);
        for index in leaf * LEAF..end {
            if index != query {
                let place = self.points.get(index);
                nearest.offer(Neighbor {
                    squared: distance_squared(center, place),
                    place,
                    index: index as u32,
                });
            }
        }
    }
}

/// One of the points near another.
#[derive(Clone, Copy)]
pub(crate) struct Neighbor {
    /// The squared distance.
    pub squared: f64,
    pub place: [f64; 3],
    pub index: u32,
}

impl Neighbor {
    fn is_before(&self, other: &Self) -> bool {
        (self.squared, self.place) < (other.squared, other.place)
    }
}

/// The nearest points met so far, nearest first, ties by coordinates.
pub(crate) struct Nearest {
    found: Vec<Neighbor>,
    most: usize,
}

impl Nearest {
    /// An empty list with room for `most` points, at least one.
    pub(crate) fn with_capacity(most: usize) -> Result<Self, OutOfMemory> {
        let found = with_capacity(most)?;
        Ok(Self { found, most })
    }

    pub(crate) fn found(&self) -> &[Neighbor] {
        &self.found
    }

    fn worst(&self) -> f64 {
        if self.found.len() < self.most {
            f64::INFINITY
        } else {
            self.found[self.most - 1].squared
        }
    }

    /// Adds a point, if it is among the nearest.
    pub(crate) fn offer(&mut self, new: Neighbor) {
        if self.found.len() == self.most {
            if !new.is_before(&self.found[self.most - 1]) {
                return;
            }
            self.found.pop();
        }
        let slot = self.found.partition_point(|other| other.is_before(&new));
        self.found.insert(slot, new);
    }
}
