//! Which triangles between visible points are surface, and which are sky; and their areas.

use alloc::vec::Vec;
use core::f64::consts::PI;

use glam::DVec3;

use crate::answers::looks::{Corners, Triangle};
use crate::base::allocation::{OutOfMemory, filled, push};
use crate::base::real::{larger, power_of_two_below, smaller, square_root};
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

    /// The areas of the triangles that are surface. `flipped` gives a vertex as the hull has it.
    pub(super) fn areas(
        &self,
        faces: &dyn OuterFaces,
        flipped: &dyn Fn(Vertex) -> DVec3,
        up: DVec3,
    ) -> Areas {
        let mut areas = Areas::default();
        for (id, corners) in outer(faces) {
            if self.kinds[id as usize] != Kind::Sky {
                let directions = corners.map(|vertex| self.directions.at(vertex).place);
                let normal =
                    |edge: usize| normal(flipped(corners[edge]), flipped(corners[(edge + 1) % 3]));
                areas.add(directions, &normal, up);
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

/// The areas of triangles between unit vectors.
#[derive(Default)]
pub(super) struct Areas {
    solid_angle: f64,
    /// Of the parts above the horizon, on the ground under a sphere of radius 1.
    projected: f64,
}

/// Corners with a smaller cosine are opposite to each other: their rounded directions do not tell the great circle through
/// both. Their places in the hull do.
const OPPOSITE: f64 = -0.999;

impl Areas {
    /// Adds the area of a triangle. `normal` gives that of the great circle through a corner and the next one.
    fn add(&mut self, corners: [DVec3; 3], normal: &dyn Fn(usize) -> DVec3, up: DVec3) {
        for edge in 0..3 {
            let [a, b, c] = [0, 1, 2].map(|k| corners[(edge + k) % 3]);
            if a.dot(b) < OPPOSITE {
                // Cut at a third or at two thirds of the edge, where c is not opposite.
                let along = normal(edge).cross(a) * square_root(0.75);
                let [third, other] = [along + a * 0.5, along - a * 0.5];
                let cut = if third.dot(c) > other.dot(c) {
                    third
                } else {
                    other
                };
                // The edge between c and the cut is asked for no normal.
                let own = |k: usize| normal((edge + k) % 3);
                self.add([a, cut, c], &own, up);
                self.add([cut, b, c], &own, up);
                return;
            }
        }
        // Van Oosterom and Strackee 1983.
        let [a, b, c] = corners;
        let cosine = 1.0 + a.dot(b) + b.dot(c) + c.dot(a);
        self.solid_angle += 2.0 * libm::atan2(a.dot(b.cross(c)).abs(), cosine);
        self.projected += projected(corners, up);
    }

    /// How much of the sphere it is, in steradians.
    pub(super) fn solid_angle(&self) -> f64 {
        smaller(self.solid_angle, 4.0 * PI)
    }

    /// The share of the sky in the upper half of the sphere, weighted by the cosine from up.
    pub(super) fn sky_view_factor(&self) -> f64 {
        smaller(larger(1.0 - self.projected / PI, 0.0), 1.0)
    }
}

/// The area of the part above the horizon, projected along `up` to the ground (Lambert 1760): half the
/// sum, over the edges, of the angle times the height of the edge's normal.
fn projected(corners: [DVec3; 3], up: DVec3) -> f64 {
    // At most one edge goes down through the horizon, and one up.
    let (mut down, mut upwards) = (None, None);
    let mut sum = 0.0;
    for (edge, &tail) in corners.iter().enumerate() {
        let head = corners[(edge + 1) % 3];
        let [from, to] = [tail, head].map(|end| end.dot(up));
        let crossing = || tail * (to / (to - from)) - head * (from / (to - from));
        sum += match (from >= 0.0, to >= 0.0) {
            (true, true) => edge_height(tail, head, up),
            (true, false) => edge_height(tail, *down.insert(crossing()), up),
            (false, true) => edge_height(*upwards.insert(crossing()), head, up),
            (false, false) => 0.0,
        };
    }
    if let (Some(down), Some(upwards)) = (down, upwards) {
        // Against the clock along the horizon, also half of it.
        let sine = square_root(down.cross(upwards).length_squared());
        sum += libm::atan2(sine, down.dot(upwards));
    }
    0.5 * sum
}

/// The angle between two directions, times the height of the unit vector perpendicular to both.
fn edge_height(tail: DVec3, head: DVec3, up: DVec3) -> f64 {
    let normal = tail.cross(head);
    let sine = square_root(normal.length_squared());
    if sine > 0.0 {
        libm::atan2(sine, tail.dot(head)) / sine * normal.dot(up)
    } else {
        0.0
    }
}

/// The direction of a × b, also where nearly all digits cancel.
fn normal(a: DVec3, b: DVec3) -> DVec3 {
    let [a, b] = [a, b].map(|v| v * power_of_two_below(1.0 / v.abs().max_element()));
    let difference = |i: usize, j: usize| {
        let (one, other) = (a[i] * b[j], a[j] * b[i]);
        // What each product lost in rounding.
        let lost = libm::fma(a[i], b[j], -one) - libm::fma(a[j], b[i], -other);
        (one - other) + lost
    };
    let normal = DVec3::new(difference(1, 2), difference(2, 0), difference(0, 1));
    // It may be so short that its square is 0.
    let normal = normal * power_of_two_below(1.0 / normal.abs().max_element());
    normal / square_root(normal.length_squared())
}
