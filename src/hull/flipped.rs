//! The points of a cloud as one view flips them. Each is computed when it is needed.

use glam::DVec3;

use crate::cloud::blocks::Sphere;
use crate::cloud::points::Points;
use crate::flip::inversion::Flip;

/// The points of a cloud, as one view flips them.
pub(super) struct Flipped<'a> {
    pub points: &'a Points,
    pub flip: Flip,
    /// The spheres around blocks of points, if they are known.
    pub blocks: &'a [Sphere],
}

impl<'a> Flipped<'a> {
    /// The points as `flip` moves them, scaled where they are extreme. `blocks` may be empty.
    pub(super) fn of(points: &'a Points, blocks: &'a [Sphere], flip: &Flip) -> Self {
        Self {
            points,
            flip: flip.rescaled_for(points),
            blocks,
        }
    }

    pub(super) fn len(&self) -> usize {
        self.points.len()
    }

    #[inline]
    pub(super) fn position(&self, index: u32) -> [f64; 3] {
        self.points.get(index as usize)
    }

    /// The point relative to the viewpoint.
    #[inline]
    pub(super) fn relative(&self, index: u32) -> DVec3 {
        DVec3::from_array(self.position(index)) - self.flip.viewpoint()
    }

    /// The flipped point, or `None` for a point at the viewpoint.
    #[inline]
    pub(super) fn get(&self, index: u32) -> Option<DVec3> {
        self.flip.apply(self.position(index))
    }

    /// The same as `get`, but not inlined: for callers that run rarely.
    #[inline(never)]
    pub(super) fn get_out_of_line(&self, index: u32) -> Option<DVec3> {
        self.get(index)
    }

    pub(super) fn reach(&self) -> f64 {
        self.flip.reach()
    }

    /// Whether squares of distances neither overflow nor underflow.
    pub(super) fn keeps_depth(&self) -> bool {
        (1e-100..1e100).contains(&self.reach())
    }
}
