//! The nearest neighbors of points, by boxes over runs of the Hilbert curve.
//!
//! The order of the points is the index. Level 0 holds boxes over `LEAF` points each, every
//! higher level boxes over `FANOUT` boxes of the level below: 4 bytes a point. Coordinates
//! break ties, so that neighbors depend on the set of points alone.

#[cfg(test)]
mod tests;

use alloc::vec::Vec;
use core::ops::Range;
use glam::DVec3;

use crate::base::FULL;
use crate::base::allocation::{OutOfMemory, with_capacity};
use crate::base::beat;
use crate::base::real::{larger, square_root};
use crate::cloud::points::Points;
use crate::cloud::spatial::Bounds;

/// Points in a leaf box, and boxes in a box one level up.
const LEAF: usize = 16;
const FANOUT: usize = 8;
/// The most leaves that are kept for the next query.
const AROUND: usize = 256;

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
            let leaf = start..points.len().min(start + LEAF);
            level.push(Bounds::around(leaf.map(|index| points.get(index))));
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
    /// room for, or all of them. It is fast if the queries before were in the same leaf.
    pub(crate) fn find(&self, query: usize, nearest: &mut Nearest) {
        beat::step();
        let Nearest { best, nearby } = nearest;
        best.start(query, self.points);
        // The points next to the query in the spatial order come first. So a small bound is known
        // before other boxes are looked at.
        let own = query / LEAF;
        let side = self.beside(own);
        self.scan_leaf(own, query, best);
        for leaf in side.clone().filter(|&leaf| leaf != own) {
            self.scan_leaf(leaf, query, best);
        }
        let center = self.points.get(query);
        if nearby.leaf != own {
            // A list does not pay for a single query of a leaf.
            nearby.leaf = own;
            nearby.reach = -1.0;
            nearby.is_complete = false;
        } else if best.worst() > nearby.reach {
            // Most other queries of this leaf find their neighbors in this reach, too.
            self.list_nearby(2.0 * best.worst(), nearby);
        }
        if nearby.is_complete {
            for &leaf in &nearby.leaves {
                // A box at exactly the worst distance may hold a point that wins the tie.
                if self.levels[0][leaf as usize].distance_squared(center) <= best.worst() {
                    self.scan_leaf(leaf as usize, query, best);
                }
            }
        } else {
            let (top, nodes) = self.top();
            self.descend(top, nodes, query, &side, best);
        }
    }

    /// The highest level, and its nodes.
    fn top(&self) -> (usize, Range<usize>) {
        let top = self.levels.len() - 1;
        (top, 0..self.levels[top].len())
    }

    /// The leaf `own` and the leaves before and after it.
    fn beside(&self, own: usize) -> Range<usize> {
        own.saturating_sub(1)..self.levels[0].len().min(own + 2)
    }

    /// Lists the leaves that are at most the root of `reach` away from the leaf of `nearby`.
    fn list_nearby(&self, reach: f64, nearby: &mut NearbyLeaves) {
        nearby.reach = reach;
        nearby.is_complete = true;
        nearby.leaves.clear();
        let (top, nodes) = self.top();
        self.list(top, nodes, nearby);
    }

    fn list(&self, level: usize, nodes: Range<usize>, nearby: &mut NearbyLeaves) {
        let own = self.levels[0][nearby.leaf];
        let first = nodes.start;
        for (after, bounds) in self.levels[level][nodes].iter().enumerate() {
            if !nearby.is_complete || bounds.gap_squared(&own) > nearby.reach {
                continue;
            }
            let node = first + after;
            if level > 0 {
                self.list(level - 1, self.children(level, node), nearby);
            } else if !self.beside(nearby.leaf).contains(&node) {
                nearby.is_complete = nearby.leaves.len() < nearby.leaves.capacity();
                if nearby.is_complete {
                    nearby.leaves.push(node as u32);
                }
            }
        }
    }

    fn children(&self, level: usize, node: usize) -> Range<usize> {
        node * FANOUT..((node + 1) * FANOUT).min(self.levels[level - 1].len())
    }

    /// Scans all leaves of the nodes, except the `known` ones, where they may hold near points.
    fn descend(
        &self,
        level: usize,
        nodes: Range<usize>,
        query: usize,
        known: &Range<usize>,
        best: &mut Best,
    ) {
        let center = self.points.get(query);
        let first = nodes.start;
        for (after, bounds) in self.levels[level][nodes].iter().enumerate() {
            if bounds.distance_squared(center) > best.worst() {
                continue;
            }
            let node = first + after;
            if level > 0 {
                self.descend(level - 1, self.children(level, node), query, known, best);
            } else if !known.contains(&node) {
                self.scan_leaf(node, query, best);
            }
        }
    }

    /// How far before or behind `place`, along `normal`, the nearest point is that is at least `near` and
    /// at most `far` away along it, and at most `beside` from it. Infinite where there is none.
    pub(crate) fn along(
        &self,
        place: [f64; 3],
        normal: DVec3,
        beside: f64,
        near: f64,
        far: f64,
    ) -> f64 {
        beat::step();
        let mut line = Line {
            place: DVec3::from_array(place),
            normal,
            beside,
            near,
            far,
            nearest: f64::INFINITY,
        };
        let (top, nodes) = self.top();
        self.descend_along(top, nodes, &mut line);
        line.nearest
    }

    fn descend_along(&self, level: usize, nodes: Range<usize>, line: &mut Line) {
        let first = nodes.start;
        for (after, bounds) in self.levels[level][nodes].iter().enumerate() {
            let node = first + after;
            if !line.may_meet(bounds) {
                continue;
            }
            if level > 0 {
                self.descend_along(level - 1, self.children(level, node), line);
                continue;
            }
            for index in node * LEAF..self.points.len().min((node + 1) * LEAF) {
                line.meet(self.points.get(index));
            }
        }
    }

    fn scan_leaf(&self, leaf: usize, query: usize, best: &mut Best) {
        let center = self.points.get(query);
        let end = self.points.len().min((leaf + 1) * LEAF);
        let mut worst = best.worst();
        for index in leaf * LEAF..end {
            let squared = distance_squared(center, self.points.get(index));
            if squared <= worst && index != query {
                let index = index as u32;
                best.offer(Neighbor { squared, index }, self.points);
                worst = best.worst();
            }
        }
    }
}

/// What is met along a line through a place.
struct Line {
    place: DVec3,
    normal: DVec3,
    beside: f64,
    near: f64,
    far: f64,
    nearest: f64,
}

impl Line {
    /// How far a place is along the line, and beside it.
    fn measure(&self, place: DVec3) -> [f64; 2] {
        let v = place - self.place;
        let along = v.dot(self.normal);
        let beside = v - self.normal * along;
        [along.abs(), square_root(beside.length_squared())]
    }

    /// Whether a box may hold a nearer point than the nearest one.
    fn may_meet(&self, bounds: &Bounds) -> bool {
        let [min, max] = [bounds.min, bounds.max].map(DVec3::from_array);
        let half = max * 0.5 - min * 0.5;
        let radius = square_root(half.length_squared());
        let [along, beside] = self.measure(min + half);
        // Not `<=` alone: what overflows may be met.
        !(beside - radius > self.beside || along - radius > self.far.min(self.nearest))
    }

    fn meet(&mut self, point: [f64; 3]) {
        let [along, beside] = self.measure(DVec3::from_array(point));
        if beside <= self.beside && along >= self.near && along <= self.far.min(self.nearest) {
            self.nearest = along;
        }
    }
}

/// One of the points near another.
#[derive(Clone, Copy)]
pub(crate) struct Neighbor {
    /// The squared distance.
    pub squared: f64,
    pub index: u32,
}

impl Neighbor {
    /// Whether this point is exactly as far as `other`, and before it by its coordinates.
    #[inline]
    fn wins_tie(&self, other: &Self, points: &Points) -> bool {
        self.squared == other.squared && {
            let [own, other] = [self, other].map(|point| points.get(point.index as usize));
            own < other
        }
    }
}

/// The nearest points of one query, and what is known for the next query.
pub(crate) struct Nearest {
    best: Best,
    nearby: NearbyLeaves,
}

/// The nearest points met so far, nearest first, ties by coordinates.
struct Best {
    query: u32,
    found: Vec<Neighbor>,
    most: usize,
    /// The square of a distance within which there are as many.
    within: f64,
}

/// The leaves around the leaf of the last query.
struct NearbyLeaves {
    leaf: usize,
    /// The square of the largest distance from that leaf, or -1 before they are listed.
    reach: f64,
    leaves: Vec<u32>,
    /// Whether there was room for all of them.
    is_complete: bool,
}

impl Nearest {
    /// An empty list with room for `most` points, at least one.
    pub(crate) fn with_capacity(most: usize) -> Result<Self, OutOfMemory> {
        Ok(Self {
            best: Best {
                query: 0,
                found: with_capacity(most)?,
                most,
                within: f64::INFINITY,
            },
            nearby: NearbyLeaves {
                leaf: usize::MAX,
                reach: 0.0,
                leaves: with_capacity(AROUND)?,
                is_complete: false,
            },
        })
    }

    pub(crate) fn found(&self) -> &[Neighbor] {
        &self.best.found
    }
}

impl Best {
    /// Begins a query. The last one was mostly near, and its points tell how far those of this one are at most.
    fn start(&mut self, query: usize, points: &Points) {
        self.within = f64::INFINITY;
        // Without looks, samples are asked, which are far from each other.
        if FULL && self.found.len() == self.most {
            let center = points.get(query);
            let squared = |index: u32| distance_squared(center, points.get(index as usize));
            let last = self.found.iter().map(|near| squared(near.index));
            self.within = last.fold(squared(self.query), larger);
        }
        self.query = query as u32;
        self.found.clear();
    }

    fn worst(&self) -> f64 {
        if self.found.len() < self.most {
            self.within
        } else {
            self.found[self.most - 1].squared
        }
    }

    /// Adds a point, if it is among the nearest.
    #[inline]
    fn offer(&mut self, new: Neighbor, points: &Points) {
        let comes_after =
            |other: &Neighbor| other.squared > new.squared || new.wins_tie(other, points);
        if self.found.len() < self.most {
            self.found.push(new);
        } else if !self.found.last().is_some_and(comes_after) {
            return;
        }
        // The last one makes room. Few have to move, so a loop is faster than a copy of memory.
        let mut slot = self.found.len() - 1;
        while slot > 0 && comes_after(&self.found[slot - 1]) {
            self.found[slot] = self.found[slot - 1];
            slot -= 1;
        }
        self.found[slot] = new;
    }
}
