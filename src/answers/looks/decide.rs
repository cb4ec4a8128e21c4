//! How a look decides: by its hull's vertices and triangles, back in their places.

use alloc::vec::Vec;
use glam::DVec3;

use super::corners::{Corner, Corners};
use super::look::{Look, Verdicts};
use super::part::{Left, Part};
use crate::base::allocation::{OutOfMemory, filled};
use crate::base::real::{root_of_largest, square_root};
use crate::cloud::points::Points;
use crate::hull::{Exit, FaceId, OuterFaces, Vertex};

/// A triangle of the hull is surface if its longest edge is at most this many local spacings.
const SOLID: f64 = 4.0;
/// Surface hides a point that lies farther behind it, along the ray, than this share of the
/// triangle's longest edge.
const BEHIND: f64 = 0.45;
/// A hull vertex counts as visible only if c is at least this many local spacings of the vertices
/// beside it. A hull that is too loose for its samples has vertices behind the surface.
const RING: f64 = 0.02;
/// The score of a vertex is less by up to this share, the wider its ring is.
const LESS_SURE: f64 = 0.1;
/// The score of a point whose ray crosses surface, by its depth in longest edges of the triangle:
/// [`SURE`] / (1 + (depth / [`HALF`])²).
const SURE: f64 = 0.97;
const HALF: f64 = 0.6;
/// The score of a point that is farther behind a triangle of the last look than the triangle is
/// long, where the triangle is no surface.
const FAR: f64 = 0.05;

/// An outer face of a look's hull, with its corners back in their places.
struct Triangle {
    face: FaceId,
    normal: DVec3,
    /// normal·x on the plane of the triangle.
    height: f64,
    /// The mean local spacing of the corners.
    size: f64,
    longest: f64,
}

impl Triangle {
    fn of(face: FaceId, vertices: [Vertex; 3], corners: &Corners) -> Self {
        let [a, b, c] = vertices.map(|vertex| corners.at(vertex));
        let size = (a.spacing + b.spacing + c.spacing) / 3.0;
        let [a, b, c] = [a.place, b.place, c.place];
        let (ab, bc, ca) = (b - a, c - b, a - c);
        let normal = ab.cross(c - a);
        Self {
            face,
            normal,
            height: normal.dot(a),
            size,
            longest: root_of_largest([ab, bc, ca].map(DVec3::length_squared)),
        }
    }

    /// How far behind the triangle's plane a place is, along its ray. It is NaN where the plane is
    /// seen edge-on. The place is relative to the viewpoint, unless all rays go `ahead`.
    fn behind(&self, place: DVec3, ahead: Option<DVec3>) -> f64 {
        let Some(ahead) = ahead else {
            // Where the plane crosses the ray, in units of the place's distance.
            let crossing = self.height / self.normal.dot(place);
            return (1.0 - crossing) * square_root(place.length_squared());
        };
        (self.normal.dot(place) - self.height) / self.normal.dot(ahead)
    }
}

impl Verdicts {
    /// Lets a look decide the points that it is sure of. Returns the points that take part in the
    /// next look: those that are undecided, and the corners of the triangles before them.
    #[inline(never)]
    pub(super) fn take(
        &mut self,
        look: &Look,
        points: &Points,
        faces: &mut dyn OuterFaces,
        part: &Part,
    ) -> Result<Left, OutOfMemory> {
        let corners = Corners::of(faces, points, part, look.origin)?;
        let mut left = self.take_vertices(look, faces, part, &corners)?;
        let mut last: Option<Triangle> = None;
        for own in 0..left.spacing.len() {
            let point = part.place(own);
            if !self.is_open(point) {
                continue;
            }
            // Only vertices have a spacing.
            if left.spacing[own] < f64::INFINITY {
                left.takes_part[own] = true;
                continue;
            }
            let Exit::Face(face, vertices) = faces.exit(own as u32) else {
                self.decide(point, true, 1.0);
                continue;
            };
            let triangle = match last.take() {
                Some(triangle) if triangle.face == face => triangle,
                _ => Triangle::of(face, vertices, &corners),
            };
            let place = DVec3::from_array(points.get(point)) - look.origin;
            let behind = triangle.behind(place, look.ahead);
            if triangle.longest <= SOLID * triangle.size {
                self.judge(point, behind / triangle.longest);
            } else if look.is_last && behind > triangle.longest {
                self.decide(point, false, FAR);
            } else {
                left.takes_part[own] = true;
                let numbered = faces.points_of_vertices();
                for corner in vertices {
                    left.takes_part[numbered[corner as usize] as usize] = true;
                }
            }
            last = Some(triangle);
        }
        Ok(left)
    }

    /// Decides for the vertices, and notes the local spacing of each one.
    #[inline(never)]
    fn take_vertices(
        &mut self,
        look: &Look,
        faces: &dyn OuterFaces,
        part: &Part,
        corners: &Corners,
    ) -> Result<Left, OutOfMemory> {
        let numbered = faces.points_of_vertices();
        let rings = if look.scale < RING * corners.widest || !self.scores.is_empty() {
            corners.rings()?
        } else {
            // The ring of every vertex is narrow enough.
            Vec::new()
        };
        let count = part.len(self.of.len());
        let mut left = Left {
            takes_part: filled(count, false)?,
            spacing: filled(count, f64::INFINITY)?,
        };
        for (vertex, &own) in numbered.iter().enumerate().skip(1) {
            let Corner { spacing, .. } = corners.at(vertex as Vertex);
            if spacing == f64::INFINITY {
                continue;
            }
            left.spacing[own as usize] = spacing;
            let point = part.place(own as usize);
            let width = rings
                .get(vertex)
                .map_or(0.0, |ring| RING * ring / look.scale);
            if self.is_open(point) && width <= 1.0 {
                let score = look.score * (1.0 - LESS_SURE * square_root(width));
                self.decide(point, true, score);
            }
        }
        Ok(left)
    }

    /// Decides a point whose ray leaves the hull by surface, `depth` longest edges before it.
    fn judge(&mut self, point: usize, depth: f64) {
        // A triangle that is seen edge-on hides the point: its depth is infinite or NaN.
        let is_visible = depth <= BEHIND;
        if self.scores.is_empty() {
            self.decide(point, is_visible, 0.0);
        } else {
            let far = depth / HALF;
            let score = SURE / (1.0 + far * far);
            let score = if score > 0.0 { score } else { 0.0 };
            self.decide(point, is_visible, score);
        }
    }
}
