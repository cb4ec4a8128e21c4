//! The outer faces as triangles of points, for reconstruction.

use alloc::vec::Vec;
use glam::DVec3;

use super::Flipped;
use super::incremental::Hull;
use super::locate::Location;
use super::plane::Plane;
use super::topology::{Face, FaceId};
use crate::error::Error;
use crate::predicates::{Sign, side_of_origin};

impl Hull {
    /// The outer faces, counter-clockwise seen from the viewpoint, every vertex set
    /// once. Points that are exactly on a face, `on_boundary`, cut it; those that fall
    /// together with a vertex have no triangle.
    pub(super) fn outer_triangles(
        &mut self,
        on_boundary: &[u32],
        flipped: &Flipped,
    ) -> Result<Vec<[u32; 3]>, Error> {
        let Some(mut hint) = self.outer_face() else {
            return Ok(Vec::new());
        };
        for &point in on_boundary {
            let Some(q) = flipped.get_out_of_line(point) else {
                continue;
            };
            if let Location::Boundary(face) = self.locate(q, hint) {
                hint = self.cut(point, q, face)?;
            }
        }
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

    /// Cuts the outer face that `q` is exactly on, and where `q` is on an edge, the face
    /// across, too; returns an outer face near `q`.
    fn cut(&mut self, point: u32, q: DVec3, id: FaceId) -> Result<FaceId, Error> {
        let face = self.surface.face(id);
        let mut edges = (0..3).filter(|&edge| self.is_on_edge(face, edge, q));
        let across = edges.next().map(|edge| face.twins[edge].face());
        if edges.next().is_some() {
            return Ok(id); // At a vertex.
        }
        let cut = [
            face.vertices,
            self.surface.face(across.unwrap_or(id)).vertices,
        ];
        let vertex = self.vertices.add(point, q)?;
        let vertices = &self.vertices;
        let conflicts = |face: &Face<Plane>| cut.contains(&face.vertices);
        self.surface
            .insert(vertex, id, conflicts, |corners| vertices.plane(corners))?;
        let is_outer = |&id: &FaceId| self.vertices.is_outer(self.surface.face(id));
        let outer = self.surface.fan().iter().copied().find(is_outer);
        Ok(outer.expect("parts of an outer face are outer"))
    }

    fn is_on_edge(&self, face: &Face<Plane>, edge: usize, q: DVec3) -> bool {
        let tail = self.vertices.at(face.vertices[edge]);
        let head = self.vertices.at(face.vertices[(edge + 1) % 3]);
        side_of_origin(tail, head, q) == Sign::Zero
    }
}
