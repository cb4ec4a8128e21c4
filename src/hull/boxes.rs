//! Does a hull hide everything in a box?
//!
//! On each ray, the point where it enters the box is flipped farthest. So only the sides of the box
//! that face the viewpoint count. A piece of such a side is a rectangle. All its points are at least
//! as far as its nearest point, at distance d. The flip multiplies a point v by a factor s that
//! decreases with the distance, so all flipped points of the piece, and of everything behind it,
//! are in the pyramid of the origin and the four corners times s(d). K is convex and contains the
//! origin. So if K goes on beyond these four points, the whole pyramid is hidden. If it does not,
//! the rectangle is cut in four: a smaller one has a larger d, and its pyramid is smaller.

use glam::DVec3;

use super::kept::KeptHull;
use super::topology::FaceId;
use crate::base::real::square_root;

/// How often a rectangle is cut in four.
const CUTS: u32 = 7;
/// How many rectangles are tried for one box.
const MOST_TRIED: u32 = 4096;
/// A bound of all roundings, relative to the coordinates: about twenty of them.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Whether the hull certainly hides every point between `min` and `max`. The coordinates are
/// finite, and all points are within the reach of the flip.
#[inline(never)]
pub(crate) fn hides_box(hull: &KeptHull, min: [f64; 3], max: [f64; 3]) -> bool {
    let viewpoint = hull.viewpoint();
    let (min, max) = (DVec3::from_array(min), DVec3::from_array(max));
    // The box relative to the viewpoint, a little larger than it is, for all roundings below.
    let (min, max) = (min - viewpoint, max - viewpoint);
    let margin = min.abs().max(max.abs()).max_element() * ROUNDING;
    let (min, max) = (min - margin, max + margin);
    let mut search = Search {
        hull,
        hint: hull.first_hint(),
        tried: 0,
    };
    let mut is_outside = false;
    for axis in 0..3 {
        let side = if min[axis] > 0.0 {
            min[axis]
        } else if max[axis] < 0.0 {
            max[axis]
        } else {
            continue;
        };
        is_outside = true;
        let (mut low, mut high) = (min, max);
        low[axis] = side;
        high[axis] = side;
        if !search.hides(Rectangle { low, high, axis }, 0) {
            return false;
        }
    }
    // A box around the viewpoint has no side that faces it.
    is_outside
}

/// A rectangle perpendicular to an axis.
#[derive(Clone, Copy)]
struct Rectangle {
    low: DVec3,
    high: DVec3,
    axis: usize,
}

struct Search<'a> {
    hull: &'a KeptHull,
    hint: FaceId,
    tried: u32,
}

impl Search<'_> {
    fn hides(&mut self, rectangle: Rectangle, cuts: u32) -> bool {
        self.tried += 1;
        let Rectangle { low, high, axis } = rectangle;
        let nearest = DVec3::ZERO.clamp(low, high);
        if self.hides_at(nearest, &rectangle.corners()) {
            return true;
        }
        // The flipped nearest point is in the pyramid of every smaller piece that holds it.
        let is_open = !self.hides_at(nearest, &[nearest]);
        if is_open || cuts == CUTS || self.tried > MOST_TRIED {
            return false;
        }
        let [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
        let middle = low * 0.5 + high * 0.5;
        (0..4).all(|quarter| {
            let mut piece = rectangle;
            for (bit, axis) in [(1, u), (2, v)] {
                if quarter & bit == 0 {
                    piece.high[axis] = middle[axis];
                } else {
                    piece.low[axis] = middle[axis];
                }
            }
            self.hides(piece, cuts + 1)
        })
    }

    /// Whether K goes on beyond each of `places`, multiplied by the factor of the point `nearest`.
    fn hides_at(&mut self, nearest: DVec3, places: &[DVec3]) -> bool {
        let distance = square_root(nearest.dot(nearest)) * (1.0 - ROUNDING);
        let factor = self.hull.most_factor(distance);
        places
            .iter()
            .all(|&place| self.hull.covers(place * factor, &mut self.hint))
    }
}

impl Rectangle {
    fn corners(&self) -> [DVec3; 4] {
        let [u, v] = [(self.axis + 1) % 3, (self.axis + 2) % 3];
        core::array::from_fn(|corner| {
            let mut place = self.low;
            if corner & 1 == 1 {
                place[u] = self.high[u];
            }
            if corner & 2 == 2 {
                place[v] = self.high[v];
            }
            place
        })
    }
}
