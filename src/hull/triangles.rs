//! The outer faces as triangles of points, for reconstruction.

use alloc::vec::Vec;
use glam::DVec3;

use crate::base::allocation::OutOfMemory;
use crate::hull::dual_plane::Plane;
use crate::hull::flipped::Flipped;
use crate::hull::incremental::Hull;
use crate::hull::predicates::{Sign, side_of_origin};
use crate::hull::topology::{Face, FaceId, HalfEdge};

impl Hull {
    /// The outer faces, counter-clockwise seen from the viewpoint, every vertex set
    /// once. The points of `on_boundary` are exactly on a face, and cut it. A point that
    /// coincides with a vertex has no triangle.
    pub(super) fn outer_triangles(
        &mut self,
        on_boundary: &[u32],
        flipped: &Flipped,
    ) -> Result<Vec<[u32; 3]>, OutOfMemory> {
        self.cut_by(on_boundary, flipped)?;
        let mut triangles = Vec::new();
        let outer = || {
            let faces = self.surface.alive().map(|(_, face)| face);
            faces.filter(|face| self.vertices.is_outer(face))
        };
        triangles.try_reserve_exact(outer().count())?;
        // Counter-clockwise seen from outside is clockwise from the viewpoint.
        triangles.extend(outer().map(|face| {
            let [a, b, c] = face.vertices.map(|v| self.vertices.points[v as usize]);
            [a, c, b]
        }));
        Ok(triangles)
    }

    /// Cuts the outer face that `q` is exactly on. If `q` is on an edge, the face across is cut,
    /// too. Returns an outer face near `q`.
    pub(super) fn cut(&mut self, point: u32, q: DVec3, id: FaceId) -> Result<FaceId, OutOfMemory> {
        let face = self.surface.face(id);
        let mut edges = (0..3).filter(|&edge| self.is_on_edge(face, edge, q));
        let edge = edges.next().map(|edge| HalfEdge::new(id, edge as u32));
        if edges.next().is_some() {
            return Ok(id); // At a vertex.
        }
        let vertex = self.vertices.add(point, q)?;
        self.surface.open_at(id, edge)?;
        self.fill_cavity(vertex)
    }

    fn is_on_edge(&self, face: &Face<Plane>, edge: usize, q: DVec3) -> bool {
        let tail = self.vertices.at(face.vertices[edge]);
        let head = self.vertices.at(face.vertices[(edge + 1) % 3]);
        side_of_origin(tail, head, q) == Sign::Zero
    }
}
