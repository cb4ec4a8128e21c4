//! The areas of spherical triangles, and of their projections to the ground.

use core::f64::consts::{PI, TAU};
use glam::DVec3;

use crate::base::real::{larger, smaller, square_root};

/// The areas of triangles between unit vectors.
#[derive(Default)]
pub(super) struct Areas {
    solid_angle: f64,
    /// Of the parts above the horizon, on the ground under a sphere of radius 1.
    projected: f64,
}

/// A triangle is uncertain where both the sine and the cosine of half its area, times the same number, are below this:
/// where two corners are opposite to each other, any great circle passes through both. So is half a sphere.
const CERTAIN: f64 = 1e-6;

impl Areas {
    /// Adds the area of a triangle. Returns false where rounded corners do not tell it.
    pub(super) fn add(&mut self, corners: [DVec3; 3], up: DVec3) -> bool {
        // Van Oosterom and Strackee 1983.
        let [a, b, c] = corners;
        let sine = a.dot(b.cross(c)).abs();
        let cosine = 1.0 + a.dot(b) + b.dot(c) + c.dot(a);
        if larger(sine, cosine) < CERTAIN {
            return false;
        }
        self.solid_angle += 2.0 * libm::atan2(sine, cosine);
        self.projected += projected(corners, up);
        true
    }

    /// Adds a pixel of an image whose rows are between these cosines from up, the larger one first.
    pub(super) fn add_pixel(&mut self, [high, low]: [f64; 2], columns: usize) {
        let across = TAU / columns as f64;
        self.solid_angle += across * (high - low);
        let (high, low) = (larger(high, 0.0), larger(low, 0.0));
        self.projected += 0.5 * across * (high * high - low * low);
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
