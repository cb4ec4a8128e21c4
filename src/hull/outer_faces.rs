//! A complete hull gives more than the visible points: its outer faces as triangles of
//! points, its edges, and the face through which the ray of any point leaves the hull.

use alloc::vec::Vec;

use super::flipped::Flipped;
use super::incremental::Hull;
use super::locate::Location;
use super::memory::Memory;
use super::topology::{FaceId, Vertex};
use crate::base::allocation::{OutOfMemory, filled};
use crate::cloud::points::Points;
use crate::flip::inversion::Flip;

/// The outer faces of the complete hull of one view.
pub(crate) struct OuterFaces<'a> {
    hull: &'a Hull,
    flipped: Flipped<'a>,
    /// The face near which each point was located last.
    witnesses: &'a [FaceId],
    /// Any outer face.
    first: FaceId,
}

impl Memory {
    /// The outer faces of the hull that was found last: the hull of `points` as `flip` moves
    /// them. Points that are exactly on a face cut it. `None` where there is no hull, because
    /// all points are in one plane with the viewpoint.
    pub(crate) fn outer_faces<'a>(
        &'a mut self,
        points: &'a Points,
        flip: &Flip,
    ) -> Result<Option<OuterFaces<'a>>, OutOfMemory> {
        if !self.holds_hull {
            return Ok(None);
        }
        let flip = flip.rescaled_for(points);
        let flipped = Flipped {
            points,
            flip,
            blocks: &[],
        };
        self.hull.cut_by(&self.on_boundary, &flipped)?;
        let first = self.hull.outer_face();
        Ok(first.map(|first| OuterFaces {
            hull: &self.hull,
            flipped,
            witnesses: self.witnesses(),
            first,
        }))
    }
}

impl OuterFaces<'_> {
    /// The ends of every edge of an outer face, as points, each edge once.
    pub(crate) fn edges(&self) -> impl Iterator<Item = [u32; 2]> + '_ {
        let hull = self.hull;
        self.outer().flat_map(move |(id, corners)| {
            let [a, b, c] = corners.map(|vertex| hull.point(vertex));
            let twins = hull.surface.face(id).twins;
            let ends = [[a, b], [b, c], [c, a]];
            // An edge between two outer faces is listed by the face with the lower number.
            let is_told = move |edge: &usize| {
                let other = twins[*edge].face();
                id < other || !hull.is_outer(other)
            };
            (0..3).filter(is_told).map(move |edge| ends[edge])
        })
    }

    /// A copy that can be used after the hull is gone. It holds the triangles, and for each
    /// `wanted` point the triangle through which its ray leaves the hull.
    pub(crate) fn snapshot(&self, wanted: &dyn Fn(usize) -> bool) -> Result<Snapshot, OutOfMemory> {
        let mut triangles = filled(self.hull.surface.slots(), [Snapshot::NONE; 3])?;
        let mut under = filled(self.flipped.len(), Snapshot::NONE)?;
        for (id, corners) in self.outer() {
            let corners = corners.map(|vertex| self.hull.point(vertex));
            triangles[id as usize] = corners;
            for point in corners {
                under[point as usize] = Snapshot::VERTEX;
            }
        }
        let mut last = self.first;
        for (point, under) in under.iter_mut().enumerate() {
            if *under == Snapshot::VERTEX || !wanted(point) {
                continue;
            }
            if let Some(q) = self.flipped.get_out_of_line(point as u32) {
                let hint = self.hull.nearer_hint(q, last, self.witnesses[point]);
                let (Location::Inside(face) | Location::Boundary(face) | Location::Outside(face)) =
                    self.hull.locate(q, hint);
                last = face;
                *under = face;
            }
        }
        Ok(Snapshot { triangles, under })
    }

    fn outer(&self) -> impl Iterator<Item = (FaceId, [Vertex; 3])> + '_ {
        let alive = self.hull.surface.alive();
        alive
            .filter(|(id, _)| self.hull.is_outer(*id))
            .map(|(id, face)| (id, face.vertices))
    }
}

/// The outer faces of a hull that may be gone.
pub(crate) struct Snapshot {
    /// The corners of each outer face as points, by the number of the face; `NONE` for other
    /// numbers.
    triangles: Vec<[u32; 3]>,
    /// For each point an index into `triangles`, or `VERTEX`. It is `NONE` for points at the
    /// viewpoint and for points that are not wanted.
    under: Vec<u32>,
}

/// Where the ray of a point leaves a hull.
pub(crate) enum Exit {
    /// At the point itself, which is a vertex.
    Vertex,
    /// Through the triangle of these points.
    Triangle([u32; 3]),
    /// The point is at the viewpoint.
    Nowhere,
}

impl Snapshot {
    const NONE: u32 = u32::MAX;
    const VERTEX: u32 = u32::MAX - 1;

    pub(crate) fn triangles(&self) -> impl Iterator<Item = [u32; 3]> + '_ {
        let triangles = self.triangles.iter().copied();
        triangles.filter(|corners| corners[0] != Self::NONE)
    }

    /// The exit of a point that was wanted.
    pub(crate) fn exit(&self, point: usize) -> Exit {
        match self.under[point] {
            Self::VERTEX => Exit::Vertex,
            Self::NONE => Exit::Nowhere,
            face => Exit::Triangle(self.triangles[face as usize]),
        }
    }
}

impl Hull {
    /// Makes vertices of the points that are exactly on an outer face. A point that coincides
    /// with a vertex is left out.
    pub(super) fn cut_by(
        &mut self,
        on_boundary: &[u32],
        flipped: &Flipped,
    ) -> Result<(), OutOfMemory> {
        let Some(mut hint) = self.outer_face() else {
            return Ok(());
        };
        for &point in on_boundary {
            let Some(q) = flipped.get_out_of_line(point) else {
                continue;
            };
            if let Location::Boundary(face) = self.locate(q, hint) {
                hint = self.cut(point, q, face)?;
            }
        }
        Ok(())
    }
}
