//! The viewer, and points by the direction in which they are seen.

use alloc::vec::Vec;
use glam::DVec3;

use crate::base::allocation::{OutOfMemory, push, with_capacity};
use crate::base::real::square_root;
use crate::cloud::blocks::FANOUT;
use crate::cloud::spatial::Bounds;

/// From where a cloud is looked at.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Projection {
    Perspective([f64; 3]),
    /// Along this unit vector, from infinitely far.
    Parallel(DVec3),
}

/// Where a point is, as the viewer sees it.
#[derive(Clone, Copy)]
pub(super) struct Ray {
    /// The unit vector to the point. Along a direction: its place across.
    pub place: DVec3,
    pub range: f64,
    pub point: u32,
}

impl Ray {
    /// The ray to a place that is relative to the viewpoint, unless all rays go `ahead`.
    pub(super) fn to(v: DVec3, ahead: Option<DVec3>, point: usize) -> Self {
        let point = point as u32;
        if let Some(ahead) = ahead {
            let range = v.dot(ahead);
            let place = v - ahead * range;
            return Self {
                place,
                range,
                point,
            };
        }
        let range = square_root(v.length_squared());
        let place = v / range;
        Self {
            place,
            range,
            point,
        }
    }
}

/// Boxes around the rays of runs of points. The points follow the cloud's order, so the rays of a
/// run are near each other.
pub(super) struct Rays {
    rays: Vec<Ray>,
    /// A box and the largest range in it, level by level.
    levels: Vec<Vec<(Bounds, f64)>>,
}

impl Rays {
    pub(super) fn of(rays: Vec<Ray>) -> Result<Self, OutOfMemory> {
        let mut levels = Vec::new();
        let mut level: Vec<(Bounds, f64)> = with_capacity(rays.len().div_ceil(FANOUT))?;
        for run in rays.chunks(FANOUT) {
            let bounds = Bounds::around(run.iter().map(|ray| ray.place.to_array()));
            let ranges = run.iter().map(|ray| ray.range);
            level.push((bounds, ranges.fold(f64::NEG_INFINITY, f64::max)));
        }
        while level.len() > FANOUT {
            let mut above: Vec<(Bounds, f64)> = with_capacity(level.len().div_ceil(FANOUT))?;
            for run in level.chunks(FANOUT) {
                let mut all = (Bounds::EMPTY, f64::NEG_INFINITY);
                for (bounds, range) in run {
                    all.0.union(bounds);
                    all.1 = all.1.max(*range);
                }
                above.push(all);
            }
            push(&mut levels, level)?;
            level = above;
        }
        push(&mut levels, level)?;
        Ok(Self { rays, levels })
    }

    pub(super) fn len(&self) -> usize {
        self.rays.len()
    }

    /// Visits rays that are at least `range` long and at most the root of `reach` beside `place`.
    /// The visitor may return a shorter reach.
    pub(super) fn visit(
        &self,
        place: DVec3,
        range: f64,
        reach: f64,
        visitor: &mut dyn FnMut(f64, &Ray) -> Option<f64>,
    ) {
        let mut search = Search {
            place,
            range,
            reach,
            visitor,
        };
        let top = self.levels.len() - 1;
        for node in 0..self.levels[top].len() {
            search.descend(self, top, node);
        }
    }
}

struct Search<'a> {
    place: DVec3,
    range: f64,
    reach: f64,
    visitor: &'a mut dyn FnMut(f64, &Ray) -> Option<f64>,
}

impl Search<'_> {
    fn descend(&mut self, among: &Rays, level: usize, node: usize) {
        let (bounds, longest) = &among.levels[level][node];
        if *longest < self.range || bounds.distance_squared(self.place.to_array()) > self.reach {
            return;
        }
        let start = node * FANOUT;
        if level > 0 {
            for child in start..among.levels[level - 1].len().min(start + FANOUT) {
                self.descend(among, level - 1, child);
            }
            return;
        }
        for ray in &among.rays[start..among.rays.len().min(start + FANOUT)] {
            let squared = (ray.place - self.place).length_squared();
            if ray.range >= self.range
                && squared <= self.reach
                && let Some(shorter) = (self.visitor)(squared, ray)
            {
                self.reach = shorter;
            }
        }
    }
}
