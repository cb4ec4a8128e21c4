//! The distance between neighboring samples of a surface, measured by the edges of a hull. It
//! needs no search for neighbors, and the points behind the surface do not count.

use alloc::vec::Vec;
use glam::DVec3;

use super::part::Part;
use crate::base::allocation::{OutOfMemory, filled, with_capacity};
use crate::base::real::square_root;
use crate::cloud::points::Points;
use crate::hull::{OuterFaces, Vertex};

/// The vertices of one look's hull, by their numbers.
pub(super) struct Corners {
    /// The place before the flip, relative to the viewpoint.
    pub places: Vec<DVec3>,
    /// The local spacing: the mean of the vertex's two shortest edges in the hull. If an earlier
    /// look has found a smaller one, it is that. It is infinite for vertices without outer faces.
    pub spacing: Vec<f64>,
    /// The largest local spacing.
    pub widest: f64,
}

impl Corners {
    pub(super) fn of(
        faces: &OuterFaces,
        points: &Points,
        part: &Part,
        viewpoint: DVec3,
    ) -> Result<Self, OutOfMemory> {
        let numbered = faces.points_of_vertices();
        let mut places = with_capacity(numbered.len())?;
        // The first number is the viewpoint's.
        places.push(DVec3::ZERO);
        places.extend(numbered[1..].iter().map(|&own| {
            let place = points.get(part.place(own as usize));
            DVec3::from_array(place) - viewpoint
        }));
        let shortest = shortest_edges(faces, &places)?;
        let mut widest = 0.0;
        let mut spacing = with_capacity(numbered.len())?;
        spacing.extend(
            numbered
                .iter()
                .zip(&shortest)
                .map(|(&own, [first, second])| {
                    let here = 0.5 * (square_root(first.squared) + square_root(second.squared));
                    if here == f64::INFINITY {
                        return here;
                    }
                    let before = part.spacing(own as usize);
                    let spacing = if before < here { before } else { here };
                    if spacing > widest {
                        widest = spacing;
                    }
                    spacing
                }),
        );
        Ok(Self {
            places,
            spacing,
            widest,
        })
    }

    /// The mean spacing of a triangle's corners.
    pub(super) fn size(&self, corners: [Vertex; 3]) -> f64 {
        let [a, b, c] = corners.map(|corner| self.spacing[corner as usize]);
        (a + b + c) / 3.0
    }

    /// The mean local spacing of the neighbors of each vertex. It is NaN for vertices without
    /// outer faces.
    pub(super) fn rings(&self, faces: &OuterFaces) -> Result<Vec<f64>, OutOfMemory> {
        let mut sums = filled(self.spacing.len(), [0.0; 2])?;
        for (_, [a, b, c]) in faces.all() {
            for [vertex, one, other] in [[a, b, c], [b, c, a], [c, a, b]] {
                let [sum, count] = &mut sums[vertex as usize];
                *sum += self.spacing[one as usize] + self.spacing[other as usize];
                *count += 2.0;
            }
        }
        let mut means = with_capacity(sums.len())?;
        means.extend(sums.iter().map(|[sum, count]| sum / count));
        Ok(means)
    }

    pub(super) fn places_of(&self, corners: [Vertex; 3]) -> [DVec3; 3] {
        corners.map(|corner| self.places[corner as usize])
    }
}

/// An edge of a vertex: the vertex at its other end, and its squared length.
#[derive(Clone, Copy)]
struct Edge {
    squared: f64,
    to: Vertex,
}

/// The two shortest edges of each vertex, the shortest first.
fn shortest_edges(faces: &OuterFaces, places: &[DVec3]) -> Result<Vec<[Edge; 2]>, OutOfMemory> {
    const NONE: Edge = Edge {
        squared: f64::INFINITY,
        to: 0,
    };
    let mut shortest = filled(places.len(), [NONE; 2])?;
    for (_, [a, b, c]) in faces.all() {
        for [a, b] in [[a, b], [b, c], [c, a]] {
            let squared = (places[a as usize] - places[b as usize]).length_squared();
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
