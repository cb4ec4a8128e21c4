//! A look's hull, back in its place: its corners and its outer faces.
//!
//! Its edges measure the distance between neighboring samples of a surface. This needs no search
//! for neighbors, and the points behind the surface do not count.

use alloc::vec::Vec;
use glam::DVec3;

use crate::base::allocation::{OutOfMemory, filled, with_capacity};
use crate::base::real::{root_of_largest, square_root};
use crate::hull::{FaceId, OuterFaces, Vertex};

/// The vertices of a hull, by their numbers.
pub(crate) struct Corners {
    /// The corners of each outer face.
    triangles: Vec<[Vertex; 3]>,
    all: Vec<Corner>,
    /// The largest local spacing.
    pub(super) widest: f64,
}

#[derive(Clone, Copy)]
pub(crate) struct Corner {
    /// The place before the flip.
    pub place: DVec3,
    /// The local spacing: the mean of the vertex's two shortest edges in the hull. If an earlier
    /// look has found a smaller one, it is that. It is infinite for vertices without outer faces.
    pub spacing: f64,
}

impl Corners {
    /// `place` gives the place of a point before the flip, and `known` the local spacing that an earlier
    /// look has found there, or infinity.
    pub(crate) fn of(
        faces: &dyn OuterFaces,
        place: &dyn Fn(u32) -> DVec3,
        known: &dyn Fn(u32) -> f64,
    ) -> Result<Self, OutOfMemory> {
        let numbered = faces.points_of_vertices();
        let mut all = with_capacity(numbered.len())?;
        all.extend(numbered.iter().enumerate().map(|(vertex, &own)| Corner {
            // The first number is the ghost vertex's.
            place: if vertex == 0 { DVec3::ZERO } else { place(own) },
            spacing: f64::INFINITY,
        }));
        let mut triangles = with_capacity(faces.slots())?;
        let mut shortest = filled(all.len(), Shortest([f64::INFINITY.to_bits(); 2]))?;
        for id in 0..faces.slots() as FaceId {
            match faces.corners(id) {
                Some(corners) => triangles.push(corners),
                None => faces.border(id, &mut |edge| measure(edge, &all, &mut shortest)),
            }
        }
        for &[a, b, c] in &triangles {
            for edge in [[a, b], [b, c], [c, a]] {
                measure(edge, &all, &mut shortest);
            }
        }
        let mut widest = 0.0;
        for ((corner, &own), shortest) in all.iter_mut().zip(numbered).zip(&shortest) {
            let here = shortest.mean();
            if here == f64::INFINITY {
                continue;
            }
            let before = known(own);
            corner.spacing = if before < here { before } else { here };
            if corner.spacing > widest {
                widest = corner.spacing;
            }
        }
        Ok(Self {
            triangles,
            all,
            widest,
        })
    }

    /// The same with the geometric mean of the neighbors' local spacings instead of each vertex's own:
    /// it depends less on chance, and a neighbor far from all others changes it little.
    pub(crate) fn smoothed(mut self) -> Result<Self, OutOfMemory> {
        let means = self.means(|one, other| libm::log(one * other))?;
        for (corner, mean) in self.all.iter_mut().zip(means) {
            corner.spacing = libm::exp(mean);
        }
        Ok(self)
    }

    /// The vertex of this number.
    #[inline]
    pub(crate) fn at(&self, vertex: Vertex) -> Corner {
        self.all[vertex as usize]
    }

    /// The mean local spacing of the neighbors of each vertex. It is NaN for vertices without
    /// outer faces.
    pub(super) fn rings(&self) -> Result<Vec<f64>, OutOfMemory> {
        self.means(|one, other| one + other)
    }

    /// For each vertex half the mean of `pair` over the local spacings of two neighbors at a time.
    fn means(&self, pair: fn(f64, f64) -> f64) -> Result<Vec<f64>, OutOfMemory> {
        let mut sums = filled(self.all.len(), [0.0; 2])?;
        for &[a, b, c] in &self.triangles {
            for [vertex, one, other] in [[a, b, c], [b, c, a], [c, a, b]] {
                let [sum, count] = &mut sums[vertex as usize];
                *sum += pair(self.at(one).spacing, self.at(other).spacing);
                *count += 2.0;
            }
        }
        let mut means = with_capacity(sums.len())?;
        means.extend(sums.iter().map(|[sum, count]| sum / count));
        Ok(means)
    }
}

/// The squared lengths of a vertex's two shortest edges, as the bits of the numbers: a comparison
/// of whole numbers needs no branch, and these comparisons cannot be guessed.
#[derive(Clone, Copy)]
struct Shortest([u64; 2]);

impl Shortest {
    #[inline]
    fn keep(&mut self, squared: u64) {
        let [first, second] = self.0;
        self.0 = [first.min(squared), second.min(first.max(squared))];
    }

    fn mean(self) -> f64 {
        let [first, second] = self.0.map(|squared| square_root(f64::from_bits(squared)));
        0.5 * (first + second)
    }
}

/// Notes the length of an edge at both ends. An edge comes twice, in both directions. The direction
/// from the smaller number counts.
#[inline]
fn measure([tail, head]: [Vertex; 2], corners: &[Corner], shortest: &mut [Shortest]) {
    if tail < head {
        let [tail, head] = [tail, head].map(|vertex| vertex as usize);
        let squared = (corners[tail].place - corners[head].place).length_squared();
        shortest[tail].keep(squared.to_bits());
        shortest[head].keep(squared.to_bits());
    }
}

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
