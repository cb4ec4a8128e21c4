//! Hulls of chosen points, and how the points move, for tests.

use alloc::vec::Vec;

use glam::DVec3;

use super::*;
use crate::base::allocation::filled;
use crate::base::random::Random;
use crate::cloud::points::Points;
use crate::flip::inversion::Flip;
use crate::flip::kernel::Kernel;
use crate::hull::{Memory, mark_visible};

const RADIUS: f64 = 10.0;

/// Points that are flipped to the vectors `q`.
fn flipped_to(q: &[DVec3]) -> Points {
    let place = |q: &DVec3| ((2.0 * RADIUS - q.length()) * q.normalize()).to_array();
    Points::Double(q.iter().map(place).collect())
}

/// Hands over the points `q` as a view flips them.
pub(super) fn with_flipped<R>(q: &[DVec3], work: impl FnOnce(&Flipped) -> R) -> R {
    let points = flipped_to(q);
    let flip = Flip::new([0.0; 3], Kernel::Spherical { radius: RADIUS });
    work(&Flipped::of(&points, &[], &flip))
}

/// The hull of the points `q`.
pub(super) fn hull_of(q: &[DVec3]) -> Memory {
    let points = flipped_to(q);
    let flip = Flip::new([0.0; 3], Kernel::Spherical { radius: RADIUS });
    let mut memory = Memory::default();
    mark_visible(&points, &[], &flip, None, &mut memory).unwrap();
    memory
}

/// Moves the hull to the points `q`. Returns whether this was possible.
pub(super) fn move_to(memory: &mut Memory, q: &[DVec3]) -> bool {
    let mut is_vertex = filled(q.len(), false).unwrap();
    let mut witnesses = filled(q.len(), 0).unwrap();
    let Memory { hull, repair, .. } = memory;
    let moved = with_flipped(q, |flipped| {
        hull.move_to(flipped, repair, &mut is_vertex, &mut witnesses)
    });
    let moved = moved.unwrap();
    if moved {
        hull.assert_is_hull();
    }
    moved
}

/// Directions around the viewpoint, or those of one side.
pub(super) fn directions(count: usize, random: &mut Random, least_z: f64) -> Vec<DVec3> {
    let all = core::iter::repeat_with(|| random.direction());
    all.filter(|u| u.z > least_z).take(count).collect()
}

/// Lengths near 15: with small noise all points are vertices.
pub(super) fn rough(directions: &[DVec3], noise: f64, random: &mut Random) -> Vec<DVec3> {
    let length = |_| 15.0 + random.between(-noise, noise);
    let lengths: Vec<f64> = (0..directions.len()).map(length).collect();
    directions
        .iter()
        .zip(lengths)
        .map(|(&u, length)| length * u)
        .collect()
}

/// Puts the vertices of a hull where `q` says, as a motion does before it looks at the faces.
pub(super) fn place(hull: &mut Hull, q: &[DVec3]) {
    let Vertices {
        positions, points, ..
    } = &mut hull.vertices;
    for (position, &point) in positions.iter_mut().zip(&*points).skip(1) {
        *position = q[point as usize];
    }
    hull.vertices.inner = hull.vertices.positions.iter().sum::<DVec3>();
}

/// Moves points over the edges opposite to them, so that faces turn over.
pub(super) fn push_over(q: &mut [DVec3], hull: &Hull, points: impl Iterator<Item = u32>) {
    push_past(q, hull, points, 0.2);
}

/// Moves points past the edges opposite to them, by so many times their distances from the edges.
pub(super) fn push_past(
    q: &mut [DVec3],
    hull: &Hull,
    points: impl Iterator<Item = u32>,
    times: f64,
) {
    let of = |v: Vertex| hull.vertices.points[v as usize];
    for point in points {
        let mut faces = hull.surface.alive().map(|(_, face)| face.vertices);
        let has =
            |corners: &[Vertex; 3]| !corners.contains(&ORIGIN) && corners.map(of).contains(&point);
        let Some(corners) = faces.find(has) else {
            continue;
        };
        let others = corners.map(of).into_iter().filter(|&p| p != point);
        let middle = others.map(|p| q[p as usize]).sum::<DVec3>() / 2.0;
        let place = &mut q[point as usize];
        let length = place.length();
        *place = length * (middle + times * (middle - *place)).normalize();
    }
}
