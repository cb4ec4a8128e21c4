//! A cloud's points as one view flips them, each computed when it is asked for.

use glam::DVec3;

use crate::cloud::points::Points;
use crate::flip::inversion::Flip;

/// The points of a cloud, as one view flips them.
pub(super) struct Flipped<'a> {
    pub points: &'a Points,
    pub flip: Flip,
}

impl Flipped<'_> {
    pub(super) fn len(&self) -> usize {
        self.points.len()
    }

    #[inline]
    pub(super) fn position(&self, index: u32) -> [f64; 3] {
        self.points.get(index as usize)
    }

    /// The flipped point, or `None` for a point at the viewpoint.
    #[inline]
    pub(super) fn get(&self, index: u32) -> Option<DVec3> {
        self.flip.apply(self.position(index))
    }

    /// The same, where it is called too rarely to be worth copies of it.
    #[inline(never)]
    pub(super) fn get_out_of_line(&self, index: u32) -> Option<DVec3> {
        self.get(index)
    }

    pub(super) fn reach(&self) -> f64 {
        self.flip.reach()
    }

    pub(super) fn viewpoint(&self) -> DVec3 {
        self.flip.viewpoint()
    }

    /// The largest |q| there can be, before it is rescaled.
    pub(super) fn largest_reach(&self) -> f64 {
        self.flip.largest_length()
    }

    pub(super) fn depth_between(&self, near: f64, far: f64) -> f64 {
        self.flip.depth_between(near, far)
    }

    pub(super) fn hidden_from(&self, length: f64) -> f64 {
        self.flip.hidden_from(length)
    }

    /// Whether squares of distances neither over- nor underflow.
    pub(super) fn keeps_depth(&self) -> bool {
        (1e-100..1e100).contains(&self.largest_reach())
    }
}
