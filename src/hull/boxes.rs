//! Does a hull hide everything in a box?
//!
//! On each ray, the point where it enters the box is flipped farthest. So only the sides of the box
//! that face the viewpoint count. A piece of such a side is a rectangle. All points of the piece, and
//! everything behind it, are at least as far as the nearest point of the piece. So no flipped point is
//! longer than that of the nearest point, ℓ. Let u₁ … u₄ be the unit vectors to the corners. The
//! vectors up to the length ℓ between these directions are in the pyramid of the origin and the four
//! points uᵢ·ℓ ÷ f: Σλᵢuᵢ with Σλᵢ = 1 is at least f long (`chord`). K is convex and contains the
//! origin. So if K goes on beyond these four points, the whole pyramid is hidden. If it does not, the
//! piece is cut in two: its parts are farther or narrower, and their pyramids are smaller.

use glam::DVec3;

use crate::base::real::square_root;
use crate::hull::kept::KeptHull;
use crate::hull::topology::FaceId;

/// How many rectangles are tried for one box.
const MOST_TRIED: u32 = 4096;
/// How often a rectangle is cut in two.
const MOST_CUTS: u32 = 24;
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
        let corners = rectangle.corners();
        let units = corners.map(|corner| corner / length(corner));
        let nearest = DVec3::ZERO.clamp(rectangle.low, rectangle.high);
        let most = self.hull.most_beyond(length(nearest) * (1.0 - ROUNDING));
        let reach = most * (1.0 + ROUNDING) / chord(&units);
        if units.iter().all(|&unit| self.covers(unit * reach)) {
            return true;
        }
        // The flipped nearest point is in the pyramid of every smaller piece that holds it.
        let is_open = !self.covers(nearest / length(nearest) * most);
        if is_open || cuts == MOST_CUTS || self.tried > MOST_TRIED {
            return false;
        }
        // The piece is cut across the side that makes its pyramid larger.
        let loss = |from: usize, to: usize| {
            let apart = units[from] - units[to];
            let [from, to] =
                [from, to].map(|corner| self.hull.most_beyond(length(corners[corner])));
            0.375 * apart.dot(apart) * most + (from - to).abs()
        };
        let [u, v] = rectangle.axes();
        let along_u = loss(0, 1).max(loss(2, 3));
        let along_v = loss(0, 2).max(loss(1, 3));
        let axis = if along_u > along_v { u } else { v };
        let middle = rectangle.low[axis] * 0.5 + rectangle.high[axis] * 0.5;
        let [mut below, mut above] = [rectangle; 2];
        below.high[axis] = middle;
        above.low[axis] = middle;
        self.hides(below, cuts + 1) && self.hides(above, cuts + 1)
    }

    fn covers(&mut self, q: DVec3) -> bool {
        self.hull.covers(q, &mut self.hint)
    }
}

impl Rectangle {
    fn axes(&self) -> [usize; 2] {
        [(self.axis + 1) % 3, (self.axis + 2) % 3]
    }

    /// The low corner, then the corner along the first axis, along the second one, and along both.
    fn corners(&self) -> [DVec3; 4] {
        let [u, v] = self.axes();
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

fn length(v: DVec3) -> f64 {
    square_root(v.dot(v))
}

/// The least length of a convex combination of unit vectors, roundings included. Let D be the largest
/// distance between two of them. Σλᵢuᵢ has the squared length 1 − ½ΣΣλᵢλⱼ|uᵢ − uⱼ|², and ½ΣΣλᵢλⱼ is
/// at most ⅜ for i ≠ j. Too far apart, this is no bound; then it is 0.
fn chord(units: &[DVec3; 4]) -> f64 {
    let mut widest = 0.0f64;
    for (k, a) in units.iter().enumerate() {
        for b in &units[..k] {
            widest = widest.max((*a - *b).length_squared());
        }
    }
    square_root((1.0 - 0.375 * widest).max(0.0)) * (1.0 - ROUNDING)
}
