//! The viewer, and points by the direction in which they are seen.

use alloc::vec::Vec;
use core::ops::Range;
use glam::DVec3;

use crate::base::allocation::{OutOfMemory, push, with_capacity};
use crate::base::real::{larger, square_root};
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

/// Boxes around runs of rays, level by level.
pub(super) struct Rays {
    pub all: Vec<Ray>,
    levels: Vec<Vec<Bounds>>,
    /// A range that no ray of a run exceeds, for each run.
    pub farthest: Vec<f64>,
}

impl Rays {
    /// Rays in an order in which neighbors are near each other.
    pub(super) fn of(all: Vec<Ray>) -> Result<Self, OutOfMemory> {
        let mut levels = Vec::new();
        let mut level: Vec<Bounds> = with_capacity(all.len().div_ceil(FANOUT))?;
        let mut farthest = with_capacity(all.len().div_ceil(FANOUT))?;
        for run in all.chunks(FANOUT) {
            farthest.push(run.iter().fold(0.0, |most, ray| larger(most, ray.range)));
            level.push(Bounds::around(run.iter().map(|ray| ray.place.to_array())));
        }
        while level.len() > FANOUT {
            let mut above: Vec<Bounds> = with_capacity(level.len().div_ceil(FANOUT))?;
            for run in level.chunks(FANOUT) {
                let mut bounds = Bounds::EMPTY;
                run.iter().for_each(|inner| bounds.union(inner));
                above.push(bounds);
            }
            push(&mut levels, level)?;
            level = above;
        }
        push(&mut levels, level)?;
        Ok(Self {
            all,
            levels,
            farthest,
        })
    }

    /// The rays of a run, and their box.
    pub(super) fn run(&self, run: usize) -> (&[Ray], &Bounds) {
        let start = run * FANOUT;
        let end = self.all.len().min(start + FANOUT);
        (&self.all[start..end], &self.levels[0][run])
    }

    pub(super) fn runs(&self) -> usize {
        self.levels[0].len()
    }

    /// Lists the runs that may hold rays at most the root of `reach` beside a box of places.
    pub(super) fn list(
        &self,
        around: &Bounds,
        reach: f64,
        runs: &mut Vec<u32>,
    ) -> Result<(), OutOfMemory> {
        runs.clear();
        let top = self.levels.len() - 1;
        self.descend(top, 0..self.levels[top].len(), around, reach, runs)
    }

    fn descend(
        &self,
        level: usize,
        nodes: Range<usize>,
        around: &Bounds,
        reach: f64,
        runs: &mut Vec<u32>,
    ) -> Result<(), OutOfMemory> {
        for node in nodes {
            if self.levels[level][node].gap_squared(around) > reach {
                continue;
            }
            if level == 0 {
                push(runs, node as u32)?;
            } else {
                let start = node * FANOUT;
                let end = self.levels[level - 1].len().min(start + FANOUT);
                self.descend(level - 1, start..end, around, reach, runs)?;
            }
        }
        Ok(())
    }
}
