//! The areas of spherical triangles, and of their projections to the ground.

use core::f64::consts::PI;
use glam::DVec3;

use crate::base::real::{larger, smaller, square_root};

/// The areas of triangles between unit vectors.
#[derive(Default)]
pub(super) struct Areas {
    /// In steradians.
    pub solid_angle: f64,
    /// Of the parts above the horizon, on the ground under a sphere of radius 1.
    projected: f64,
}

impl Areas {
    pub(super) fn add(&mut self, corners: [DVec3; 3], up: DVec3) {
        self.solid_angle += solid_angle(corners);
        self.projected += projected(corners, up);
    }

    /// The share of the sky in the upper half of the sphere, weighted by the cosine from up.
    pub(super) fn sky_view_factor(&self) -> f64 {
        smaller(larger(1.0 - self.projected / PI, 0.0), 1.0)
    }
}

/// The solid angle between three unit vectors (Van Oosterom and Strackee 1983).
fn solid_angle([a, b, c]: [DVec3; 3]) -> f64 {
    let volume = a.dot(b.cross(c)).abs();
    2.0 * libm::atan2(volume, 1.0 + a.dot(b) + b.dot(c) + c.dot(a))
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
        sum += edge_height(down, upwards, up);
    }
    0.5 * sum.abs()
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
