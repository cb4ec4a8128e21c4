//! The distance between neighboring samples of a surface, measured by the edges of a hull. It
//! needs no search for neighbors, and the points behind the surface do not count.

use alloc::vec::Vec;
use glam::DVec3;

use crate::base::allocation::{OutOfMemory, filled, with_capacity};
use crate::base::real::square_root;
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
