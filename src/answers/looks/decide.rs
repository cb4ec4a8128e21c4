//! How a look decides: by its hull's vertices and triangles, back in their places.

use alloc::vec::Vec;
use glam::DVec3;

use super::corners::Corners;
use super::look::{Look, Verdicts};
use super::part::{Left, Part};
use crate::base::allocation::{OutOfMemory, filled};
use crate::base::real::square_root;
use crate::hull::{Exit, FaceId, OuterFaces};

/// A triangle of the hull is surface if its longest edge is at most this many local spacings.
const SOLID: f64 = 4.0;
/// Surface hides a point that lies more than this many local spacings behind it, along the ray.
const BEHIND: f64 = 1.0;
/// A hull vertex counts as visible only if c is at least this many local spacings of the vertices
/// beside it. A hull that is too loose for its samples has vertices behind the surface.
const RING: f64 = 0.02;
/// The score of a vertex is less by up to this share, the wider its ring is.
const LESS_SURE: f64 = 0.1;
/// The score of a point whose ray crosses surface, by its depth in local spacings:
/// [`SURE`] / (1 + exp((depth − [`HALF`]) / [`SOFT`])).
const SURE: f64 = 0.97;
const HALF: f64 = 1.2;
const SOFT: f64 = 0.4;
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
    fn of(face: FaceId, faces: &OuterFaces, corners: &Corners) -> Self {
        let triangle = faces.corners(face);
        let [a, b, c] = corners.places_of(triangle);
        let (ab, bc, ca) = (b - a, c - b, a - c);
        let normal = ab.cross(c - a);
        Self {
            face,
            normal,
            height: normal.dot(a),
            size: corners.size(triangle),
            longest: square_root(
                ab.length_squared()
                    .max(bc.length_squared())
                    .max(ca.length_squared()),
            ),
        }
    }

    /// How far behind the triangle's plane a place is, along its ray. It is NaN where the plane is
    /// seen edge-on.
    fn behind(&self, ray: DVec3) -> f64 {
        // Where the plane crosses the ray, in units of the place's distance.
        let crossing = self.height / self.normal.dot(ray);
        (1.0 - crossing) * square_root(ray.length_squared())
    }
}

impl Verdicts<'_> {
    /// Lets a look decide the points that it is sure of. Returns the points that take part in the
    /// next look: those that are undecided, and the corners of the triangles before them.
    #[inline(never)]
    pub(super) fn take(
        &mut self,
        look: &Look,
        faces: &mut OuterFaces,
        part: &Part,
    ) -> Result<Left, OutOfMemory> {
        let viewpoint = look.flip.viewpoint();
        let corners = Corners::of(faces, self.points, part, viewpoint)?;
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
            let Exit::Face(face) = faces.exit(own as u32) else {
                self.decide(point, true, 1.0);
                continue;
            };
            let triangle = match last.take() {
                Some(triangle) if triangle.face == face => triangle,
                _ => Triangle::of(face, faces, &corners),
            };
            let behind = triangle.behind(DVec3::from_array(self.points.get(point)) - viewpoint);
            if triangle.longest <= SOLID * triangle.size {
                self.judge(point, behind / triangle.size);
            } else if look.is_last && behind > triangle.longest {
                self.decide(point, false, FAR);
            } else {
                left.takes_part[own] = true;
                for corner in faces.points_of(face) {
                    left.takes_part[corner as usize] = true;
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
        faces: &OuterFaces,
        part: &Part,
        corners: &Corners,
    ) -> Result<Left, OutOfMemory> {
        let numbered = faces.points_of_vertices();
        let rings = if look.scale < RING * corners.widest || !self.scores.is_empty() {
            corners.rings(faces)?
        } else {
            // The ring of every vertex is narrow enough.
            Vec::new()
        };
        let count = part.len(self.points);
        let mut left = Left {
            takes_part: filled(count, false)?,
            spacing: filled(count, f64::INFINITY)?,
        };
        for (vertex, &own) in numbered.iter().enumerate().skip(1) {
            let spacing = corners.spacing[vertex];
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

    /// Decides a point whose ray leaves the hull by surface, `depth` local spacings before it.
    fn judge(&mut self, point: usize, depth: f64) {
        // A triangle that is seen edge-on hides the point.
        let score = if self.scores.is_empty() || depth.is_nan() {
            0.0
        } else {
            let exponent = ((depth - HALF) / SOFT).clamp(-50.0, 50.0);
            SURE / (1.0 + libm::exp(exponent))
        };
        self.decide(point, depth <= BEHIND, score);
    }
}
