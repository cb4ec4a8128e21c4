//! Knots of turned faces: how holes grow around them, and when they are given up.

use alloc::vec::Vec;
use core::f64::consts::TAU;

use glam::DVec3;

use super::scenes::{directions, hull_of, move_to, place, push_past, rough};
use super::*;
use crate::base::random::Random;
use crate::hull::Memory;

fn triangles(hull: &Hull) -> Vec<(FaceId, [Vertex; 3])> {
    let alive = hull.surface.alive();
    alive.map(|(id, face)| (id, face.vertices)).collect()
}

/// The faces that turned over.
fn turned(hull: &Hull) -> Vec<[Vertex; 3]> {
    let faces = hull.surface.alive().map(|(_, face)| face);
    let turned = faces.filter(|face| hull.vertices.is_turned(face));
    turned.map(|face| face.vertices).collect()
}

fn assert_closed(hull: &Hull) {
    for (id, face) in hull.surface.alive() {
        for edge in (0..3).map(|edge| HalfEdge::new(id, edge)) {
            let twin = hull.surface.twin(edge);
            assert_eq!(hull.surface.twin(twin), edge);
            let [tail, head, _] = face.vertices_from(edge.edge());
            let across = hull.surface.face(twin.face());
            assert_eq!(across.vertices_from(twin.edge())[..2], [head, tail]);
        }
    }
}

#[test]
fn a_hole_grows_where_edges_of_its_rim_cross() {
    let mut random = Random::new(61);
    let [mut untied, mut grown, mut refused] = [0; 3];
    for round in 0..200 {
        let u = directions(150, &mut random, -1.0);
        let mut q = rough(&u, 0.0, &mut random);
        let Memory {
            mut hull,
            mut repair,
            ..
        } = hull_of(&q);
        push_past(&mut q, &hull, 0..2, 0.2 + 0.02 * f64::from(round));
        place(&mut hull, &q);
        assert!(hull.renew_planes(usize::MAX, &mut repair).unwrap());
        let (before, surface) = (turned(&hull), triangles(&hull));
        let Some(&face) = repair.turned.first() else {
            continue;
        };
        repair.effort = 10_000;
        if hull.untie(face, &mut repair).unwrap() {
            // The turned face is gone, and no other face has turned over.
            let after = turned(&hull);
            assert!(after.len() < before.len());
            assert!(after.iter().all(|face| before.contains(face)));
            untied += 1;
            grown += u32::from(repair.star.len() > 4);
        } else {
            assert_eq!(triangles(&hull), surface);
            refused += 1;
        }
        assert_closed(&hull);
    }
    assert!(
        untied >= 130 && grown >= 115 && refused >= 40,
        "{untied} untied, {grown} of these after growth, {refused} refused"
    );
}

/// Where points near each other are mixed up, faces turn over in knots.
#[test]
fn knots_of_turned_faces_are_mended_with_force() {
    let mut random = Random::new(46);
    let u = directions(1000, &mut random, -1.0);
    let smooth = rough(&u, 0.0, &mut random);
    for (least_cosine, spread, least) in [(0.98, 0.3, 36), (0.97, 0.3, 36), (0.97, 0.4, 20)] {
        let mut mended = 0;
        for _ in 0..40 {
            let center = random.direction();
            let mut q = smooth.clone();
            for q in q.iter_mut().filter(|q| q.dot(center) > least_cosine * 15.0) {
                *q = 15.0 * (*q / 15.0 + spread * random.direction()).normalize();
            }
            mended += u32::from(move_to(&mut hull_of(&smooth), &q));
        }
        assert!(mended >= least, "{mended} of 40, {least_cosine}, {spread}");
    }
}

/// Each vertex of the turned face has so many neighbors that it cannot be taken out, alone or with others. The
/// same would fail again, so the repair ends after it was tried once with force.
#[test]
fn a_face_that_nothing_can_mend_is_given_up() {
    let around = |count: u32, radius: f64, z: f64| {
        (0..count).map(move |k| {
            let (sine, cosine) = (f64::from(k) / f64::from(count) * TAU + 0.1).sin_cos();
            DVec3::new(radius * cosine, radius * sine, z)
        })
    };
    let mut q: Vec<DVec3> = around(3000, 15.0, 0.0)
        .chain(around(3, 5.0, -10.0))
        .collect();
    q.push(DVec3::new(0.0, 0.0, 5.0));
    let mut memory = hull_of(&q);
    for q in &mut q {
        q.z += 10.1;
    }
    assert!(!move_to(&mut memory, &q));
    assert_eq!(memory.repair.turned.len(), 1);
    let effort = EFFORT_PER_FACE * memory.hull.surface.slots() + SPARE_EFFORT;
    // A hole of four faces, with a rim of six edges.
    assert_eq!(memory.repair.effort, effort - 2 * 2 - 6 * 6);
}
