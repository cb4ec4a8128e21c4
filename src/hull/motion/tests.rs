//! What a motion counts, lists, allows and checks, on hulls whose flipped points are chosen.

use alloc::vec::Vec;

use glam::DVec3;

use super::scenes::{directions, hull_of, move_to, place, push_over, rough, with_flipped};
use super::*;
use crate::base::allocation::filled;
use crate::base::random::Random;
use crate::hull::Memory;
use crate::hull::dual_plane::Plane;
use crate::hull::predicates::side_of_face;
use crate::hull::topology::Face;

/// The number of sampled faces without the viewpoint, of those that turned over, and of their reflex edges.
fn count(hull: &Hull, q: &[DVec3]) -> [usize; 3] {
    let at = |v: Vertex| q[hull.point(v) as usize];
    let [mut faces, mut turned, mut reflex] = [0; 3];
    let step = sample_step(hull.surface.slots());
    for (id, face) in hull.surface.alive() {
        if face.vertices.contains(&ORIGIN) || id as usize % step > 0 {
            continue;
        }
        let [a, b, c] = face.vertices.map(at);
        faces += 1;
        turned += usize::from(side_of_origin(a, b, c) != Sign::Positive);
        for twin in face.twins {
            let [_, _, apex] = hull.surface.face(twin.face()).vertices_from(twin.edge());
            let is_reflex = || side_of_face(a, b, c, at(apex)) == Sign::Positive;
            reflex += usize::from(apex != ORIGIN && is_reflex());
        }
    }
    [faces, turned, reflex]
}

#[test]
fn views_are_close_where_few_faces_turn_over_and_few_edges_are_reflex() {
    let mut random = Random::new(41);
    for least_z in [-1.0, 0.2] {
        let u = directions(3200, &mut random, least_z);
        let before = rough(&u, 0.0, &mut random);
        let hull = hull_of(&before).hull;
        let mut far = [0; 3];
        let mut close = 0;
        let rougher = (0..20).map(|step| (5e-4 * f64::from(step), 0));
        for (noise, pushed) in rougher.chain((0..20).map(|pushed| (0.0, 8 * pushed))) {
            let mut q = rough(&u, noise, &mut random);
            push_over(&mut q, &hull, 0..pushed);
            let [faces, turned, reflex] = count(&hull, &q);
            let verdicts = [
                turned > faces / FEW_TURNED + 1,
                reflex * FEW_REFLEX > 3 * faces,
            ];
            let share = with_flipped(&q, |flipped| hull.reflex_share(flipped));
            match verdicts {
                [false, false] => {
                    assert_eq!(share, Some(reflex as f64 / faces as f64));
                    close += usize::from(reflex * FEW_REFLEX > faces + 3);
                }
                [turns, bends] => {
                    assert_eq!(share, None);
                    far[usize::from(turns) + 2 * usize::from(bends) - 1] += 1;
                }
            }
        }
        assert!(
            close >= 2 && far.into_iter().all(|views| views >= 5),
            "{close} {far:?}"
        );
    }
}

/// The repair of a large hull is given up at fewer reflex edges than that of a small one.
#[test]
fn views_of_a_large_hull_must_be_closer() {
    let mut random = Random::new(48);
    let u = directions(60_500, &mut random, -1.0);
    let hull = hull_of(&rough(&u, 0.0, &mut random)).hull;
    assert!(hull.surface.slots() >= MANY);
    let mut verdicts = [0; 3];
    for step in 1..24 {
        let q = rough(&u, 1e-5 * f64::from(step), &mut random);
        let [faces, turned, reflex] = count(&hull, &q);
        assert_eq!(turned, 0);
        let share = with_flipped(&q, |flipped| hull.reflex_share(flipped));
        if reflex * FEW_REFLEX_OF_MANY <= 3 * faces {
            assert_eq!(share, Some(reflex as f64 / faces as f64));
            verdicts[0] += 1;
        } else {
            assert_eq!(share, None);
            verdicts[if reflex * FEW_REFLEX <= 3 * faces {
                1
            } else {
                2
            }] += 1;
        }
    }
    assert!(verdicts.into_iter().all(|views| views > 1), "{verdicts:?}");
}

/// Faces of the sample's first round are enough to know that much has changed. As many faces of the last round
/// are fewer than those that a close view may have.
#[test]
fn a_round_of_many_turned_faces_ends_the_survey() {
    let mut random = Random::new(47);
    let u = directions(4200, &mut random, -1.0);
    let before = rough(&u, 0.0, &mut random);
    let hull = hull_of(&before).hull;
    let slots = hull.surface.slots();
    let step = sample_step(slots);
    for (round, is_close) in [(0, false), (ROUNDS - 1, true)] {
        let mut q = before.clone();
        let faces = (round * step..slots).step_by(ROUNDS * step);
        for face in faces.take(CHANCE_TURNED + 1) {
            let corners = hull.surface.face(face as FaceId).vertices;
            let [a, b, c] = corners.map(|v| hull.point(v) as usize);
            q[a] = q[a].length() * (0.6 * (q[b] + q[c]) - 0.2 * q[a]).normalize();
        }
        let [faces, turned, _] = count(&hull, &q);
        assert!(turned > CHANCE_TURNED && turned * FEW_TURNED <= faces);
        let share = with_flipped(&q, |flipped| hull.reflex_share(flipped));
        assert_eq!(share.is_some(), is_close, "round {round}");
    }
}

/// The faces that turned over, and the reflex edges between other faces, by exact signs alone.
fn turned_and_reflex(hull: &Hull) -> (Vec<FaceId>, Vec<[FaceId; 2]>) {
    let at = |face: &Face<Plane>| face.vertices.map(|v| hull.vertices.at(v));
    let is_turned = |face: &Face<Plane>| {
        let [a, b, c] = at(face);
        if face.vertices.contains(&ORIGIN) {
            side_of_face(a, b, c, hull.vertices.inner) != Sign::Negative
        } else {
            side_of_origin(a, b, c) != Sign::Positive
        }
    };
    let (mut turned, mut reflex) = (Vec::new(), Vec::new());
    for (id, face) in hull.surface.alive() {
        if is_turned(face) {
            turned.push(id);
            continue;
        }
        for twin in face.twins.into_iter().filter(|twin| twin.face() < id) {
            let across = hull.surface.face(twin.face());
            let [_, _, apex] = across.vertices_from(twin.edge());
            let [a, b, c] = at(face);
            if !is_turned(across) && side_of_face(a, b, c, hull.vertices.at(apex)) == Sign::Positive
            {
                reflex.push([twin.face(), id]);
            }
        }
    }
    reflex.sort_unstable();
    (turned, reflex)
}

#[test]
fn turned_faces_and_reflex_edges_are_listed_once() {
    let mut random = Random::new(42);
    for least_z in [-1.0, 0.2] {
        let u = directions(300, &mut random, least_z);
        for (noise, pushed, lists) in [
            (0.0, 0, false),
            (0.2, 0, false),
            (0.2, 5, true),
            (0.2, 20, false),
            (1.0, 20, true),
        ] {
            let Memory {
                mut hull,
                mut repair,
                ..
            } = hull_of(&rough(&u, 0.05, &mut random));
            let mut q = rough(&u, noise, &mut random);
            push_over(&mut q, &hull, 0..pushed);
            if lists {
                hull.use_corners().unwrap();
            }
            assert_eq!(hull.compact.is_used(), lists);
            place(&mut hull, &q);
            let (turned, reflex) = turned_and_reflex(&hull);
            assert!(hull.renew_planes(turned.len(), &mut repair).unwrap());
            assert_eq!(repair.turned, turned);
            let pair = |edge: &HalfEdge| [hull.surface.twin(*edge).face(), edge.face()];
            let mut listed: Vec<[FaceId; 2]> = repair.suspects.iter().map(pair).collect();
            listed.sort_unstable();
            assert_eq!(listed, reflex);
            if let Some(limit) = turned.len().checked_sub(1) {
                assert!(!hull.renew_planes(limit, &mut repair).unwrap());
            }
        }
    }
}

#[test]
fn a_surface_is_a_hull_if_one_face_is_pierced() {
    let mut random = Random::new(43);
    for least_z in [-1.0, 0.2] {
        let u = directions(500, &mut random, least_z);
        let q = rough(&u, 1.0, &mut random);
        let Memory {
            mut hull,
            mut repair,
            visible,
            ..
        } = hull_of(&q);
        place(&mut hull, &q);
        let inner = hull.vertices.inner;
        let mut is_vertex = filled(q.len(), false).unwrap();
        assert!(hull.settle(&mut repair, &mut is_vertex).unwrap());
        assert_eq!(is_vertex, visible);
        let kept = |v: &Vertex| !visible[hull.point(*v) as usize];
        let unused: Vec<Vertex> = (1..hull.vertex_count() as Vertex).filter(kept).collect();
        assert!(unused.len() > 10, "{}", unused.len());
        assert_eq!(hull.vertices.free, unused);
        // Only faces near the ray are asked exactly, and as many on the other side.
        let is_asked = |corners: &[Vertex; 3]| {
            let [a, b, c] = corners.map(|v| repair.sides[v as usize] & 0xf);
            !corners.contains(&ORIGIN) && a & b & c == 0
        };
        let asked = hull.triangles().filter(is_asked).count();
        assert!((1..12).contains(&asked), "{asked} faces are asked");
        // No face is pierced by these rays, or a vertex lies on them.
        let vertex = hull.triangles().flatten().find(|&v| v != ORIGIN);
        let beside = [DVec3::ZERO, hull.vertices.at(vertex.unwrap())];
        let behind = (least_z > 0.0).then_some(-inner);
        for ray in beside.into_iter().chain(behind) {
            hull.vertices.inner = ray;
            assert!(!hull.settle(&mut repair, &mut is_vertex).unwrap(), "{ray}");
        }
    }
}

#[test]
fn numbers_follow_the_points_from_the_second_motion_on() {
    let mut random = Random::new(44);
    let u = directions(200, &mut random, -1.0);
    let q = rough(&u, 0.1, &mut random);
    let mut memory = hull_of(&q);
    let made = memory.hull.vertices.points.clone();
    assert!(move_to(&mut memory, &q));
    assert_eq!(memory.hull.vertices.points, made);
    assert!(!made[1..].is_sorted());
    for _ in 0..2 {
        assert!(move_to(&mut memory, &q));
        assert!(memory.hull.vertices.points[1..].is_sorted());
        assert!(memory.hull.numbers == Numbers::InOrder);
    }
    // No vertex had to be taken out.
    let effort = EFFORT_PER_FACE * memory.hull.surface.slots() + SPARE_EFFORT;
    assert_eq!(memory.repair.effort, effort);
}

#[test]
fn repairs_that_take_longer_than_a_new_hull_are_given_up() {
    let mut random = Random::new(45);
    let u = directions(1000, &mut random, -1.0);
    // All points stay vertices, but in other triangles.
    let squeezed =
        |axes: DVec3| -> Vec<DVec3> { u.iter().map(|&u| 15.0 / (u * axes).length() * u).collect() };
    let round = squeezed(DVec3::ONE);
    for (flatness, expected) in [(1.5, true), (4.0, false)] {
        let mut memory = hull_of(&squeezed(DVec3::new(flatness, 1.0, 1.0)));
        let moved = move_to(&mut memory, &squeezed(DVec3::new(1.0, 1.0, flatness)));
        assert_eq!(moved, expected);
        let effort = EFFORT_PER_FACE * memory.hull.surface.slots() + SPARE_EFFORT;
        assert_eq!(memory.repair.effort, effort, "a vertex was taken out");
    }
    let mut memory = hull_of(&round);
    let mut q = round.clone();
    push_over(&mut q, &memory.hull, 0..200);
    assert!(!move_to(&mut memory, &q));
    let limit = memory.hull.surface.slots() / MOST_TURNED;
    assert_eq!(memory.repair.turned.len(), limit);
}
