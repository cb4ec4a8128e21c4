//! Which triangles between visible points are surface, and which are sky.

use alloc::vec::Vec;
use glam::DVec3;

use crate::answers::looks::{Corners, Triangle};
use crate::answers::panorama::areas::Areas;
use crate::base::allocation::{OutOfMemory, filled, push};
use crate::base::real::square_root;
use crate::base::sort::percentile;
use crate::hull::{FaceId, OuterFaces, Vertex};

/// How much longer a triangle may be than [`PERCENTILE`] percent of those that face the viewer. Between samples that
/// lie at random are wide gaps, on a lattice none: a fixed length of 6 spacings would close 1.2 % of the sphere above an
/// open box of 2,200 lattice points, this one .4 %. Of a closed room of 100,000 random points, neither leaves sky.
const LONGER: f64 = 2.5;
const PERCENTILE: usize = 90;
/// The longest triangle, in spacings, where none faces the viewer.
const USUAL: f64 = 6.0;

/// What an outer face is.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Sky,
    /// The corners are beside each other as the viewer sees them, but may be on two surfaces.
    Beside,
    Surface,
}

/// The outer faces of the hull of visible points.
pub(super) struct Surface {
    /// The vertices at their places, and as unit vectors.
    places: Corners,
    directions: Corners,
    /// By the number of the face.
    kinds: Vec<Kind>,
    /// Surface whose area pixels tell, by the number of the face.
    pub(super) in_pixels: Vec<bool>,
}

impl Surface {
    /// `place` gives the place of a point, relative to the viewpoint.
    pub(super) fn of(
        faces: &dyn OuterFaces,
        place: &dyn Fn(u32) -> DVec3,
    ) -> Result<Self, OutOfMemory> {
        let direction = |own: u32| {
            let place = place(own);
            place / square_root(place.length_squared())
        };
        let unknown = |_: u32| f64::INFINITY;
        let places = Corners::of(faces, place, &unknown)?.smoothed()?;
        let directions = Corners::of(faces, &direction, &unknown)?.smoothed()?;
        Ok(Self {
            kinds: kinds(faces, &places, &directions)?,
            in_pixels: filled(faces.slots(), false)?,
            places,
            directions,
        })
    }

    /// The range in a direction, and the vertex that is nearest by angle; `None` for the sky. The
    /// ray in this direction leaves the hull by this face.
    pub(super) fn at(
        &self,
        face: FaceId,
        corners: [Vertex; 3],
        direction: DVec3,
    ) -> Option<(f64, Vertex)> {
        let kind = self.kinds[face as usize];
        if kind == Kind::Sky {
            return None;
        }
        let [mut nearest, others @ ..] = corners;
        let near = |vertex| self.directions.at(vertex).place.dot(direction);
        for other in others {
            if near(other) > near(nearest) {
                nearest = other;
            }
        }
        let place = |vertex| self.places.at(vertex).place;
        let range = if kind == Kind::Surface {
            // The triangle's point in this direction is between its corners along it. A plane that is
            // seen edge-on crosses the ray anywhere.
            let [a, b, c] = corners.map(|vertex| place(vertex).dot(direction));
            let crossing = Triangle::of(corners, &self.places).crossing(direction);
            crossing.max(a.min(b).min(c)).min(a.max(b).max(c))
        } else {
            square_root(place(nearest).length_squared())
        };
        Some((range, nearest))
    }

    /// The areas of the triangles that are surface, but for those that pixels tell.
    pub(super) fn areas(&mut self, faces: &dyn OuterFaces, up: DVec3) -> Areas {
        let mut areas = Areas::default();
        for (id, corners) in outer(faces) {
            if self.kinds[id as usize] != Kind::Sky {
                let corners = corners.map(|vertex| self.directions.at(vertex).place);
                self.in_pixels[id as usize] = !areas.add(corners, up);
            }
        }
        areas
    }
}

/// Tells surface from sky.
fn kinds(
    faces: &dyn OuterFaces,
    places: &Corners,
    directions: &Corners,
) -> Result<Vec<Kind>, OutOfMemory> {
    let length = |triangle: &Triangle| triangle.longest / triangle.size;
    let mut lengths = Vec::new();
    for (_, corners) in outer(faces) {
        let triangle = Triangle::of(corners, places);
        if triangle.is_facing(places.at(corners[0]).place, None) {
            push(&mut lengths, length(&triangle))?;
        }
    }
    let longest = percentile(&lengths, PERCENTILE)?.map_or(USUAL, |usual| LONGER * usual);
    let mut kinds = filled(faces.slots(), Kind::Sky)?;
    for (id, corners) in outer(faces) {
        let is_short = |among| length(&Triangle::of(corners, among)) <= longest;
        if is_short(places) {
            kinds[id as usize] = Kind::Surface;
        } else if is_short(directions) {
            kinds[id as usize] = Kind::Beside;
        }
    }
    Ok(kinds)
}

fn outer(faces: &dyn OuterFaces) -> impl Iterator<Item = (FaceId, [Vertex; 3])> {
    (0..faces.slots() as FaceId).filter_map(|id| Some((id, faces.corners(id)?)))
}
