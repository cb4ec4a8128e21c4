//! One look: it decides only the points that it is sure of.

use alloc::vec::Vec;
use glam::DVec3;

use crate::base::allocation::{OutOfMemory, filled, with_capacity};
use crate::base::real::square_root;
use crate::cloud::points::Points;
use crate::flip::inversion::Flip;
use crate::flip::kernel::Kernel;
use crate::hull::{Exit, Memory, Snapshot};

/// A triangle of the hull is surface if its longest edge is at most this many local spacings.
const SOLID: f64 = 4.0;
/// Surface hides a point that lies more than this many local spacings behind it, along the ray.
const BEHIND: f64 = 1.0;
/// A hull vertex counts as visible only if c is at least this many local spacings of the vertices
/// beside it. A hull that is too loose for its samples has vertices behind the surface.
const RING: f64 = 0.02;
/// The score of a point whose ray crosses surface, by its depth in local spacings:
/// [`SURE`] / (1 + exp((depth − [`HALF`]) / [`SOFT`])).
const SURE: f64 = 0.97;
const HALF: f64 = 1.2;
const SOFT: f64 = 0.4;
/// The score of a point that nothing decides.
const UNKNOWN: f64 = 0.2;

/// The settings of one look.
pub(super) struct Look {
    pub flip: Flip,
    /// The scale c of its hull.
    scale: f64,
    /// The score of its vertices.
    score: f64,
}

impl Look {
    pub(super) fn new(viewpoint: [f64; 3], scale: f64, score: f64) -> Self {
        Self {
            flip: Flip::new(viewpoint, Kernel::Exponential { scale }),
            scale,
            score,
        }
    }
}

/// The result of one look.
pub(super) enum Outcome {
    Hull(Snapshot),
    /// All points are in one plane with the viewpoint, so there are no triangles. The list
    /// holds for each point whether it is visible.
    Flat(Vec<bool>),
}

impl Outcome {
    /// The result of the hull in `memory` for the `wanted` points.
    pub(super) fn of(
        memory: &mut Memory,
        points: &Points,
        flip: &Flip,
        wanted: &dyn Fn(usize) -> bool,
    ) -> Result<Self, OutOfMemory> {
        if let Some(faces) = memory.outer_faces(points, flip)? {
            return Ok(Self::Hull(faces.snapshot(wanted)?));
        }
        let mut visible = with_capacity(points.len())?;
        visible.extend_from_slice(memory.visible());
        Ok(Self::Flat(visible))
    }
}

/// The answer of several looks, for each distinct point.
pub(crate) struct Seen {
    pub visible: Vec<bool>,
    /// From 0 to 1; empty unless asked for.
    pub scores: Vec<f32>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Verdict {
    Undecided,
    Hidden,
    Visible,
}

/// The decisions of the looks so far.
pub(super) struct Verdicts<'a> {
    pub points: &'a Points,
    viewpoint: DVec3,
    /// The local spacing of every point.
    spacing: &'a [f64],
    pub of: Vec<Verdict>,
    /// Empty unless scores are asked for.
    scores: Vec<f32>,
    /// Room for a look.
    rings: Vec<Ring>,
}

/// The neighbors of a hull vertex: the sum of their spacings, and their number.
#[derive(Clone, Copy, Default)]
struct Ring {
    sum: f64,
    count: f64,
}

impl<'a> Verdicts<'a> {
    pub(super) fn new(
        points: &'a Points,
        viewpoint: [f64; 3],
        spacing: &'a [f64],
        with_scores: bool,
    ) -> Result<Self, OutOfMemory> {
        let count = points.len();
        Ok(Self {
            points,
            viewpoint: DVec3::from_array(viewpoint),
            spacing,
            of: filled(count, Verdict::Undecided)?,
            scores: filled(if with_scores { count } else { 0 }, UNKNOWN as f32)?,
            rings: filled(count, Ring::default())?,
        })
    }

    pub(super) fn decide(&mut self, point: usize, is_visible: bool, score: f64) {
        self.of[point] = if is_visible {
            Verdict::Visible
        } else {
            Verdict::Hidden
        };
        if let Some(kept) = self.scores.get_mut(point) {
            *kept = score as f32;
        }
    }

    /// Whether a point is undecided.
    pub(super) fn open(&self) -> impl Fn(usize) -> bool + '_ {
        |point| self.of[point] == Verdict::Undecided
    }

    /// Lets a look decide the points that it is sure of.
    pub(super) fn take(&mut self, look: &Look, outcome: Outcome) {
        match outcome {
            Outcome::Flat(visible) => {
                for (point, _) in visible.iter().enumerate().filter(|(_, is)| **is) {
                    if self.of[point] == Verdict::Undecided {
                        let is_at_viewpoint = look.flip.apply(self.points.get(point)).is_none();
                        self.decide(point, true, if is_at_viewpoint { 1.0 } else { look.score });
                    }
                }
            }
            Outcome::Hull(snapshot) => self.take_hull(look, &snapshot),
        }
    }

    fn take_hull(&mut self, look: &Look, snapshot: &Snapshot) {
        self.measure_rings(snapshot);
        for point in 0..self.of.len() {
            if self.of[point] != Verdict::Undecided {
                continue;
            }
            match snapshot.exit(point) {
                Exit::Vertex => {
                    let Ring { sum, count } = self.rings[point];
                    if look.scale >= RING * (sum / count) {
                        self.decide(point, true, look.score);
                    }
                }
                Exit::Triangle(corners) => self.judge(point, corners),
                Exit::Nowhere => self.decide(point, true, 1.0),
            }
        }
    }

    fn measure_rings(&mut self, snapshot: &Snapshot) {
        self.rings.fill(Ring::default());
        for [a, b, c] in snapshot.triangles() {
            let [a, b, c] = [a, b, c].map(|point| point as usize);
            for (vertex, others) in [(a, [b, c]), (b, [c, a]), (c, [a, b])] {
                let ring = &mut self.rings[vertex];
                ring.sum += self.spacing[others[0]] + self.spacing[others[1]];
                ring.count += 2.0;
            }
        }
    }

    /// Decides a point whose ray leaves the hull by the triangle of `corners`, if that is
    /// surface.
    fn judge(&mut self, point: usize, corners: [u32; 3]) {
        let corners = corners.map(|corner| corner as usize);
        let [a, b, c] = corners.map(|corner| self.ray_to(corner));
        let spacing = corners.map(|corner| self.spacing[corner]);
        let size = (spacing[0] + spacing[1] + spacing[2]) / 3.0;
        let (ab, bc, ca) = (b - a, c - b, a - c);
        let longest = ab
            .length_squared()
            .max(bc.length_squared())
            .max(ca.length_squared());
        if longest > (SOLID * size) * (SOLID * size) {
            return;
        }
        let ray = self.ray_to(point);
        let distance = square_root(ray.length_squared());
        let normal = ab.cross(c - a);
        // Where the plane crosses the ray, in units of the point's distance.
        let crossing = normal.dot(a) / normal.dot(ray);
        let depth = (1.0 - crossing) * distance / size;
        // This is NaN where the triangle is seen edge-on. Then the triangle hides the point.
        let exponent = ((depth - HALF) / SOFT).clamp(-50.0, 50.0);
        self.decide(
            point,
            depth <= BEHIND,
            if self.scores.is_empty() || depth.is_nan() {
                0.0
            } else {
                SURE / (1.0 + libm::exp(exponent))
            },
        );
    }

    fn ray_to(&self, point: usize) -> DVec3 {
        DVec3::from_array(self.points.get(point)) - self.viewpoint
    }

    /// The answer. A point that is still undecided is hidden.
    pub(super) fn finish(self) -> Result<Seen, OutOfMemory> {
        let mut visible = filled(self.of.len(), false)?;
        for (visible, verdict) in visible.iter_mut().zip(&self.of) {
            *visible = *verdict == Verdict::Visible;
        }
        Ok(Seen {
            visible,
            scores: self.scores,
        })
    }
}
