//! A complete hull gives more than the visible points: its outer faces as triangles, and the
//! face through which the ray of any point leaves the hull.

use crate::base::allocation::OutOfMemory;
use crate::cloud::points::Points;
use crate::flip::inversion::Flip;
use crate::hull::dual_plane::Plane;
use crate::hull::flipped::Flipped;
use crate::hull::incremental::Hull;
use crate::hull::locate::Location;
use crate::hull::memory::Memory;
use crate::hull::predicates::{Sign, side_of_origin};
use crate::hull::topology::{Face, FaceId, HalfEdge, Surface, Vertex};
use alloc::vec::Vec;
use glam::DVec3;

/// A factor for places that are certainly in the hull, if their ray leaves it.
const NEAR: f64 = 1e-30;

/// The outer faces of a complete hull, as its viewer sees them.
pub(crate) trait OuterFaces {
    /// All numbers of faces are below this.
    fn slots(&self) -> usize;

    /// The corners of a face. `None` if it is no outer face.
    fn corners(&self, id: FaceId) -> Option<[Vertex; 3]>;

    /// Passes the edges that a face, which is no outer face, has in common with outer faces.
    fn border(&self, id: FaceId, pass: &mut dyn FnMut([Vertex; 2]));

    /// The point of the cloud that each vertex is, by the vertex's number. Some of the vertices
    /// may have no outer face. The first number is the ghost vertex's, and its point has no meaning.
    fn points_of_vertices(&self) -> &[u32];

    /// Where the ray of a point that is no vertex leaves the hull.
    fn exit(&mut self, point: u32) -> Exit;
}

/// The outer faces of the hull of one view.
pub(crate) struct FlippedFaces<'a> {
    hull: &'a Hull,
    flipped: Flipped<'a>,
    visible: &'a [bool],
    /// A factor that moves points along their rays into the hull; a power of two.
    inward: f64,
    /// The face by which the last ray left. The next walk starts there.
    last: FaceId,
}

/// Where the ray of a point leaves the hull.
pub(crate) enum Exit {
    /// Through this outer face, and its corners.
    Face(FaceId, [Vertex; 3]),
    /// The point is at the viewpoint. For a direction: the point is exactly on the boundary.
    Nowhere,
}

impl Memory {
    /// The outer faces of the hull that was found last: the hull of `points` as `flip` moves
    /// them. Points that are exactly on a face cut it. `farthest` is the largest distance of the
    /// points from the viewpoint. `None` where there is no hull, because all points are in one
    /// plane with the viewpoint.
    pub(crate) fn outer_faces<'a>(
        &'a mut self,
        points: &'a Points,
        flip: &Flip,
        farthest: f64,
    ) -> Result<Option<FlippedFaces<'a>>, OutOfMemory> {
        if !self.holds_hull() {
            return Ok(None);
        }
        let flipped = Flipped::of(points, &[], flip);
        self.hull.cut_by(&self.on_boundary, &flipped)?;
        let first = self.hull.outer_face();
        Ok(first.map(|first| FlippedFaces {
            hull: &self.hull,
            inward: flip.inward(farthest),
            flipped,
            visible: &self.visible,
            last: first,
        }))
    }
}

/// Passes the edges that the face `id` of `surface` has in common with its outer `faces`.
pub(super) fn border_of<T: Copy>(
    surface: &Surface<T>,
    id: FaceId,
    faces: &dyn OuterFaces,
    pass: &mut dyn FnMut([Vertex; 2]),
) {
    let face = surface.face(id);
    if face.is_alive() {
        for (edge, twin) in face.twins.iter().enumerate() {
            if faces.corners(twin.face()).is_some() {
                pass([face.vertices[edge], face.vertices[(edge + 1) % 3]]);
            }
        }
    }
}

impl OuterFaces for FlippedFaces<'_> {
    fn slots(&self) -> usize {
        self.hull.surface.slots()
    }

    fn corners(&self, id: FaceId) -> Option<[Vertex; 3]> {
        let corners = self.hull.corners(id);
        corners.filter(|_| self.hull.is_outer(id))
    }

    fn border(&self, id: FaceId, pass: &mut dyn FnMut([Vertex; 2])) {
        border_of(&self.hull.surface, id, self, pass);
    }

    fn points_of_vertices(&self) -> &[u32] {
        &self.hull.vertices.points
    }

    fn exit(&mut self, point: u32) -> Exit {
        // Among points that are no vertices, the marked ones are at the viewpoint, or at the same
        // place as a vertex after the flip.
        if self.visible[point as usize] && self.flipped.get_out_of_line(point).is_none() {
            return Exit::Nowhere;
        }
        // The point is in the hull. A place before it on its ray is found by the same walk, and no
        // flip has to be computed.
        let v = self.flipped.relative(point) * self.inward;
        match self.hull.locate(v, self.last) {
            Location::Inside(face) | Location::Boundary(face) => self.last = face,
            // The flip rounds the direction, and the ray of the unrounded one passes the hull.
            Location::Outside(_) => self.exit_of_flipped(point),
        }
        Exit::Face(self.last, self.hull.surface.face(self.last).vertices)
    }
}

impl FlippedFaces<'_> {
    /// Where the flip puts a vertex.
    pub(crate) fn flipped(&self, vertex: Vertex) -> DVec3 {
        let point = self.hull.vertices.points[vertex as usize];
        self.flipped.get_out_of_line(point).unwrap_or_default()
    }

    /// The outer face through which the ray to `place` leaves the hull, and its corners. `None` if there
    /// is none. The place is relative to the viewpoint and as far from it as the farthest point.
    pub(crate) fn exit_towards(&mut self, place: DVec3) -> Option<(FaceId, [Vertex; 3])> {
        let place = place * self.inward;
        // A wide face may be nearer to the viewpoint.
        for q in [place, place * NEAR] {
            match self.hull.locate_out_of_line(q, self.last) {
                Location::Inside(face) | Location::Boundary(face) => {
                    self.last = face;
                    return Some((face, self.hull.surface.face(face).vertices));
                }
                Location::Outside(face) if self.hull.is_outer(face) => self.last = face,
                Location::Outside(beyond) => {
                    // The walk has left the outer faces. The next one starts where it left them.
                    let twins = self.hull.surface.face(beyond).twins;
                    let left = twins.map(HalfEdge::face);
                    if let Some(&last) = left.iter().find(|&&face| self.hull.is_outer(face)) {
                        self.last = last;
                    }
                    return None;
                }
            }
        }
        None
    }

    #[cold]
    fn exit_of_flipped(&mut self, point: u32) {
        if let Some(q) = self.flipped.get_out_of_line(point) {
            let (Location::Inside(face) | Location::Boundary(face) | Location::Outside(face)) =
                self.hull.locate(q, self.last);
            self.last = face;
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
            if let Location::Boundary(face) = self.locate_out_of_line(q, hint) {
                hint = self.cut(point, q, face)?;
            }
        }
        Ok(())
    }
}

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
