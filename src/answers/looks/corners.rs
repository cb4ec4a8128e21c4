//! The distance between neighboring samples of a surface, measured by the edges of a hull. It
//! needs no search for neighbors, and the points behind the surface do not count.

use alloc::vec::Vec;
use glam::DVec3;

use super::part::Part;
use crate::base::allocation::{OutOfMemory, filled, with_capacity};
use crate::base::real::square_root;
use crate::cloud::points::Points;
use crate::hull::{FaceId, OuterFaces, Vertex};

/// The vertices of one look's hull, by their numbers.
pub(super) struct Corners {
    /// The corners of each outer face.
    triangles: Vec<[Vertex; 3]>,
    all: Vec<Corner>,
    /// The largest local spacing.
    pub widest: f64,
}

#[derive(Clone, Copy)]
pub(super) struct Corner {
    /// The place before the flip, relative to an origin.
    pub place: DVec3,
    /// The local spacing: the mean of the vertex's two shortest edges in the hull. If an earlier
    /// look has found a smaller one, it is that. It is infinite for vertices without outer faces.
    pub spacing: f64,
}

impl Corners {
    /// Places are relative to `origin`.
    pub(super) fn of(
        faces: &dyn OuterFaces,
        points: &Points,
        part: &Part,
        origin: DVec3,
    ) -> Result<Self, OutOfMemory> {
        let numbered = faces.points_of_vertices();
        let mut all = with_capacity(numbered.len())?;
        all.extend(numbered.iter().enumerate().map(|(vertex, &own)| Corner {
            // The first number is the ghost vertex's.
            place: if vertex == 0 {
                DVec3::ZERO
            } else {
                let place = points.get(part.place(own as usize));
                DVec3::from_array(place) - origin
            },
            spacing: f64::INFINITY,
        }));
        let mut triangles = with_capacity(faces.slots())?;
        triangles.extend((0..faces.slots() as FaceId).filter_map(|id| faces.corners(id)));
        let shortest = shortest_edges(&triangles, &all)?;
        let mut widest = 0.0;
        for ((corner, &own), [first, second]) in all.iter_mut().zip(numbered).zip(&shortest) {
            let here = 0.5 * (square_root(first.squared) + square_root(second.squared));
            if here == f64::INFINITY {
                continue;
            }
            let before = part.spacing(own as usize);
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

    /// The vertex of this number.
    #[inline]
    pub(super) fn at(&self, vertex: Vertex) -> Corner {
        self.all[vertex as usize]
    }

    /// The mean local spacing of the neighbors of each vertex. It is NaN for vertices without
    /// outer faces.
    pub(super) fn rings(&self) -> Result<Vec<f64>, OutOfMemory> {
        let mut sums = filled(self.all.len(), [0.0; 2])?;
        for &[a, b, c] in &self.triangles {
            for [vertex, one, other] in [[a, b, c], [b, c, a], [c, a, b]] {
                let [sum, count] = &mut sums[vertex as usize];
                *sum += self.at(one).spacing + self.at(other).spacing;
                *count += 2.0;
            }
        }
        let mut means = with_capacity(sums.len())?;
        means.extend(sums.iter().map(|[sum, count]| sum / count));
        Ok(means)
    }
}

/// An edge of a vertex: the vertex at its other end, and its squared length.
#[derive(Clone, Copy)]
struct Edge {
    squared: f64,
    to: Vertex,
}

/// The two shortest edges of each vertex, the shortest first.
fn shortest_edges(
    triangles: &[[Vertex; 3]],
    corners: &[Corner],
) -> Result<Vec<[Edge; 2]>, OutOfMemory> {
    const NONE: Edge = Edge {
        squared: f64::INFINITY,
        to: 0,
    };
    let mut shortest = filled(corners.len(), [NONE; 2])?;
    for &[a, b, c] in triangles {
        for [a, b] in [[a, b], [b, c], [c, a]] {
            let squared = (corners[a as usize].place - corners[b as usize].place).length_squared();
            keep(&mut shortest[a as usize], Edge { squared, to: b });
            keep(&mut shortest[b as usize], Edge { squared, to: a });
        }
    }
    Ok(shortest)
}

/// Most edges come twice, once from each of their faces. They count once.
fn keep(shortest: &mut [Edge; 2], edge: Edge) {
    let [first, second] = shortest;
    if edge.squared >= second.squared || edge.to == first.to {
        return;
    }
    if edge.squared < first.squared {
        *second = *first;
        *first = edge;
    } else {
        *second = edge;
    }
}
