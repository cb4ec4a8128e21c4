//! The complete hull of a cloud, kept to be asked about points that are not in the cloud.
//!
//! A point that is added to the cloud, alone, is hidden exactly if its ray stays in K beyond it.
//! So one walk answers for it, and the hull stays as it is.
//!
//! If the whole cloud is in one plane (or line) with the viewpoint, K is flat. Then vertices e and
//! −e beside the plane make it a body. Its section with the plane is K, because the middle of e and
//! −e is the origin. So the same walk answers for points in the plane. Other points are visible.

use glam::DVec3;

use crate::base::allocation::OutOfMemory;
use crate::cloud::blocks::Sphere;
use crate::cloud::points::Points;
use crate::flip::inversion::Flip;
use crate::hull::flat::collinear_with_origin;
use crate::hull::flipped::Flipped;
use crate::hull::locate::Location;
use crate::hull::memory::Memory;
use crate::hull::outer_boundary::mark_visible;
use crate::hull::predicates::{Sign, side_of_origin};
use crate::hull::topology::FaceId;

/// A hull that answers for points outside of its cloud.
pub(crate) struct KeptHull {
    memory: Memory,
    flip: Flip,
    span: Span,
    /// Any outer face; 0 if there is no hull.
    first: FaceId,
}

/// The flipped points that span the linear hull of K.
enum Span {
    Point,
    Line(DVec3),
    Plane(DVec3, DVec3),
    Space,
}

impl KeptHull {
    /// The hull of `points` as `flip` moves them. `blocks` are the spheres around their blocks, or
    /// none.
    #[inline(never)]
    pub(crate) fn of(points: &Points, blocks: &[Sphere], flip: &Flip) -> Result<Self, OutOfMemory> {
        let mut memory = Memory::new();
        let flip = flip.rescaled_for(points);
        mark_visible(points, blocks, &flip, &mut memory)?;
        let mut kept = Self {
            memory,
            flip,
            span: Span::Space,
            first: 0,
        };
        if !kept.memory.holds_hull() {
            kept.span = kept.thicken(points)?;
        }
        kept.first = kept.memory.hull.outer_face().unwrap_or(0);
        Ok(kept)
    }

    /// Which of the points are visible.
    pub(crate) fn visible(&self) -> &[bool] {
        self.memory.visible()
    }

    pub(super) fn viewpoint(&self) -> DVec3 {
        self.flip.viewpoint()
    }

    /// The start of the first walk.
    pub(crate) fn first_hint(&self) -> FaceId {
        self.first
    }

    /// Whether the cloud would hide a point at `position`. `hint` is the face near which the last
    /// point was located. `None` where coordinates of the flipped point are too small to decide;
    /// then the point has to be added to the cloud.
    #[inline(never)]
    pub(crate) fn hides(&self, position: [f64; 3], hint: &mut FaceId) -> Option<bool> {
        let Some(q) = self.flip.apply(position) else {
            return Some(false);
        };
        let is_exact = self.flip.scales_exactly(position);
        is_exact.then(|| self.covers(q, hint))
    }

    /// An upper bound of the length of all flipped points at least `distance` from the viewpoint.
    pub(super) fn most_beyond(&self, distance: f64) -> f64 {
        self.flip.most_beyond(distance)
    }

    /// Whether K goes on beyond `q` in its direction. `q` is flipped, and scaled as the hull is.
    #[inline(never)]
    pub(super) fn covers(&self, q: DVec3, hint: &mut FaceId) -> bool {
        // The bounds of errors hold up to 5/8 of the reach. No point of the cloud is farther out.
        const FARTHEST: f64 = 0.625;
        // The comparison also refuses a NaN.
        let is_near = (q / self.flip.reach()).length_squared() <= FARTHEST * FARTHEST;
        if !is_near || !self.spans(q) {
            return false;
        }
        match self.memory.hull.locate_out_of_line(q, *hint) {
            Location::Inside(face) => {
                *hint = face;
                true
            }
            Location::Boundary(face) => {
                *hint = face;
                false
            }
            Location::Outside(_) => false,
        }
    }

    /// Whether `q` is in the linear hull of K.
    fn spans(&self, q: DVec3) -> bool {
        match self.span {
            Span::Space => true,
            Span::Plane(a, b) => side_of_origin(a, b, q) == Sign::Zero,
            Span::Line(a) => collinear_with_origin(a, q),
            Span::Point => false,
        }
    }

    /// Makes a hull in space of points that are in one plane with the viewpoint.
    #[cold]
    fn thicken(&mut self, points: &Points) -> Result<Span, OutOfMemory> {
        let flip = self.flip;
        let flipped = Flipped::of(points, &[], &flip);
        let at = |index| flipped.get_out_of_line(index);
        let all = || (0..flipped.len() as u32).filter_map(at);
        let Some(a) = all().next() else {
            return Ok(Span::Point);
        };
        let b = all().find(|&b| !collinear_with_origin(a, b));
        // The length of the added vertices is about that of the others.
        let length = all().fold(0.0f64, |most, q| most.max(q.abs().max_element()));
        let second = b.unwrap_or_else(|| beside(length, &|e| !collinear_with_origin(a, e)));
        let e = beside(length, &|e| side_of_origin(a, second, e) != Sign::Zero);
        let mut corners = [a, second, e].map(|q| (u32::MAX, q));
        if side_of_origin(a, second, e) == Sign::Negative {
            corners.swap(0, 1);
        }
        let opposite = match b {
            Some(_) => [-e, -e],
            None => [-e, -second],
        };
        let hull = &mut self.memory.hull;
        hull.start(corners, flip.reach())?;
        let mut hint = 0;
        let visible = (0..flipped.len() as u32).filter(|&k| self.memory.visible[k as usize]);
        for q in opposite.into_iter().chain(visible.filter_map(at)) {
            hint = match hull.locate_out_of_line(q, hint) {
                Location::Outside(face) => hull.insert_out_of_line(u32::MAX, q, face)?,
                Location::Boundary(face) | Location::Inside(face) => face,
            };
        }
        Ok(b.map_or(Span::Line(a), |b| Span::Plane(a, b)))
    }
}

/// A vector of this length along the first axis for which `is_beside` holds.
fn beside(length: f64, is_beside: &dyn Fn(DVec3) -> bool) -> DVec3 {
    let mut axes = DVec3::AXES.into_iter().map(|axis| axis * length);
    // One of the axes is beside every plane.
    axes.find(|&e| is_beside(e)).unwrap_or(DVec3::ZERO)
}
