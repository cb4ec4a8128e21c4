//! Small hulls that move from view to view. Each answer is compared with that of a new hull.

use alloc::vec::Vec;
use glam::DVec3;

use super::flipped::Flipped;
use super::incremental::ORIGIN;
use super::topology::{FaceId, Vertex};
use super::{Memory, mark_visible};
use crate::base::random::Random;
use crate::cloud::points::Points;
use crate::flip::inversion::Flip;
use crate::flip::kernel::Kernel;

/// Compares the view that may start from the last one with a view that does not. Returns whether it did.
fn see(points: &Points, radius: f64, viewpoint: DVec3, memory: &mut Memory) -> bool {
    let flip = Flip::new(viewpoint.to_array(), Kernel::Spherical { radius });
    mark_visible(points, &[], &flip, None, memory).unwrap();
    let mut new = Memory::default();
    mark_visible(points, &[], &flip, None, &mut new).unwrap();
    assert_eq!(memory.visible(), new.visible(), "{viewpoint}");
    memory.moved()
}

/// Moves around a cloud by steps of all sizes. Returns how many views started from the last one.
fn walk(points: &Points, radius: f64, seed: u64) -> usize {
    let mut random = Random::new(seed);
    let mut memory = Memory::default();
    let mut viewpoint = DVec3::new(0.0, 0.5, 2.5);
    let mut moved = 0;
    for view in 0..80 {
        moved += usize::from(see(points, radius, viewpoint, &mut memory));
        let step = [2e-3, 6e-3, 2e-2, 5e-2][view / 20];
        viewpoint = 2.5 * (viewpoint + step * random.direction()).normalize();
    }
    moved
}

#[test]
fn steps_that_turn_faces_over_are_mended() {
    let mut random = Random::new(27);
    let bumpy = random.bumpy(1200);
    let ball: Vec<[f64; 3]> = (0..1200)
        .map(|_| (random.between(0.1, 1.0) * random.direction()).to_array())
        .collect();
    let plane = |p: &[f64; 3]| [p[0], p[1], 0.1 * (5.0 * p[2]).round()];
    let layers = bumpy.iter().map(plane).collect::<Vec<_>>();
    // At least so many of the 79 views are mended. The others start with a new hull: too much has changed.
    for (title, places, mended) in [
        ("bumpy", bumpy, [69, 38]),
        ("ball", ball, [58, 37]),
        ("layers", layers, [76, 58]),
    ] {
        let points = Points::Double(places);
        for (radius, mended) in [300.0, 3000.0].into_iter().zip(mended) {
            let moved = walk(&points, radius, 28);
            assert!(moved >= mended, "{title}, {radius}: {moved}");
        }
    }
}

/// Where the viewpoint leaves the hull of the flipped points, a face turns over that no flip can mend: the
/// viewpoint becomes a vertex.
#[test]
fn a_viewpoint_leaves_a_cloud_and_enters_it() {
    let mut random = Random::new(29);
    for count in [12, 150, 600] {
        let places = (0..count).map(|_| random.direction().to_array()).collect();
        let points = Points::Double(places);
        for radius in [2.5, 6.0] {
            let u = random.direction();
            let mut memory = Memory::default();
            let mut moved = 0;
            for step in 0..160 {
                let viewpoint = (0.8 + 0.003 * f64::from(i32::abs(step - 80))) * u;
                moved += usize::from(see(&points, radius, viewpoint, &mut memory));
            }
            assert!(moved >= 80, "{count} points, {radius}: {moved}");
        }
    }
}

/// Takes the vertices of a face out of the last hull, and mends it. Returns false if there is no hole
/// that can be filled. Puts the points that were taken out back, and expects the same answer.
fn clear(memory: &mut Memory, flipped: &Flipped, face: FaceId) -> bool {
    let alive = |memory: &Memory| memory.hull.surface.alive().count();
    let before = (alive(memory), memory.hull.surface.face(face).vertices);
    let answer = memory.visible.clone();
    memory.repair.effort = 10_000;
    memory.repair.suspects.clear();
    if !memory.hull.clear(face, &mut memory.repair).unwrap() {
        assert_eq!(before.0, alive(memory));
        return false;
    }
    let faces = memory.hull.surface.alive().map(|(_, face)| face.vertices);
    let present: Vec<Vertex> = faces.flatten().collect();
    for vertex in before.1 {
        assert!(vertex == ORIGIN || !present.contains(&vertex));
    }
    while let Some(edge) = memory.repair.suspects.pop() {
        if memory.hull.is_reflex(edge) {
            assert!(memory.hull.make_convex(edge, &mut memory.repair).unwrap());
        }
    }
    memory.hull.assert_is_hull();
    memory.visible.fill(false);
    for (_, face) in memory.hull.surface.alive() {
        for vertex in face.vertices.into_iter().filter(|v| *v != ORIGIN) {
            memory.visible[memory.hull.point(vertex) as usize] = true;
        }
    }
    memory.add_to_moved_hull(flipped).unwrap();
    memory.finish(flipped).unwrap();
    assert_eq!(memory.visible, answer);
    true
}

#[test]
fn a_face_is_cleared_out_of_a_hull() {
    let mut random = Random::new(30);
    let points = Points::Double(random.bumpy(800));
    for (viewpoint, cleared) in [([0.0, 0.5, 2.5], 110), ([0.1, 0.2, 0.1], 145)] {
        let flip = Flip::new(viewpoint, Kernel::Spherical { radius: 100.0 });
        let flipped = Flipped::of(&points, &[], &flip);
        let mut memory = Memory::default();
        mark_visible(&points, &[], &flip, None, &mut memory).unwrap();
        let mut times = 0;
        for _ in 0..150 {
            let slots = memory.hull.surface.slots() as u64;
            let face = random.below(slots) as FaceId;
            if memory.hull.corners(face).is_some() {
                times += u32::from(clear(&mut memory, &flipped, face));
            }
        }
        assert!(times >= cleared, "{times}");
    }
}
