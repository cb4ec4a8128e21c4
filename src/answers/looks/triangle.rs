//! An outer face of a look's hull, back in its place.

use glam::DVec3;

use crate::answers::looks::corners::Corners;
use crate::base::real::{root_of_largest, square_root};
use crate::hull::Vertex;

/// An outer face of a hull, with its corners back in their places.
pub(crate) struct Triangle {
    normal: DVec3,
    /// normal·x on the plane of the triangle.
    height: f64,
    /// The mean local spacing of the corners.
    pub(crate) size: f64,
    pub(crate) longest: f64,
}

impl Triangle {
    pub(crate) fn of(vertices: [Vertex; 3], corners: &Corners) -> Self {
        let [a, b, c] = vertices.map(|vertex| corners.at(vertex));
        let size = (a.spacing + b.spacing + c.spacing) / 3.0;
        let [a, b, c] = [a.place, b.place, c.place];
        let (ab, bc, ca) = (b - a, c - b, a - c);
        let normal = ab.cross(c - a);
        Self {
            normal,
            height: normal.dot(a),
            size,
            longest: root_of_largest([ab, bc, ca].map(DVec3::length_squared)),
        }
    }

    /// How far behind the triangle's plane a place is, along its ray. It is NaN where the plane is
    /// seen edge-on. The place is relative to the viewpoint, unless all rays go `ahead`.
    pub(super) fn behind(&self, place: DVec3, ahead: Option<DVec3>) -> f64 {
        let Some(ahead) = ahead else {
            return (1.0 - self.crossing(place)) * square_root(place.length_squared());
        };
        (self.normal.dot(place) - self.height) / self.normal.dot(ahead)
    }

    /// Where the triangle's plane crosses the ray to `place`, in units of the place's distance.
    pub(crate) fn crossing(&self, place: DVec3) -> f64 {
        self.height / self.normal.dot(place)
    }

    /// Whether the triangle faces the viewer: its normal is within 60° of the ray to `place`.
    pub(crate) fn is_facing(&self, place: DVec3, ahead: Option<DVec3>) -> bool {
        let ray = ahead.unwrap_or(place);
        let along = self.normal.dot(ray);
        along * along >= 0.25 * (self.normal.length_squared() * ray.length_squared())
    }
}
