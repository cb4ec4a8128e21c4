//! Small views divided among sectors. The sectors' answers together are compared with the answer of
//! one hull.

use alloc::vec::Vec;
use glam::DVec3;

use super::*;
use crate::base::random::Random;
use crate::cloud::blocks::Blocks;
use crate::cloud::points::Points;
use crate::flip::inversion::Flip;
use crate::flip::kernel::Kernel;
use crate::hull::division::Sector;
use crate::hull::incremental::ORIGIN;
use crate::hull::predicates::Sign;
use crate::hull::{mark_sector, mark_visible, outer_boundary};

/// Sector `number` of `count`, where every third point of the sample is visible.
fn division(
    points: &Points,
    viewpoint: [f64; 3],
    radius: f64,
    [number, count]: [u32; 2],
) -> Division {
    let blocks = Blocks::around(points).unwrap();
    let seen: Vec<bool> = Division::sample(&blocks)
        .map(|index| index % 3 == 0)
        .collect();
    let sector = Sector::new(number, count).unwrap();
    let center = DVec3::from_array(viewpoint);
    Division::new(points, &blocks, center, radius, &seen, sector).unwrap()
}

fn compare(title: &str, places: &[[f64; 3]], viewpoint: [f64; 3], radius: f64) {
    let points = Points::Double(places.to_vec());
    let blocks = Blocks::around(&points).unwrap();
    let spheres = &blocks.levels[0];
    let flip = Flip::new(viewpoint, Kernel::Spherical { radius });
    let mut whole = Memory::default();
    mark_visible(&points, spheres, &flip, &mut whole).unwrap();
    for count in [2, 3, 7] {
        let mut times_visible: Vec<u32> = places.iter().map(|_| 0).collect();
        let mut memory = Memory::default();
        for number in 0..count {
            let division = division(&points, viewpoint, radius, [number, count]);
            mark_sector(&points, spheres, &flip, division, &mut memory).unwrap();
            for (times, &visible) in times_visible.iter_mut().zip(memory.visible()) {
                *times += u32::from(visible);
            }
        }
        let expected: Vec<u32> = whole.visible().iter().map(|&v| u32::from(v)).collect();
        assert_eq!(times_visible, expected, "{title}, {count} sectors");
    }
}

/// The points of a box of cells, block by block.
fn lattice(cells: usize) -> Vec<[f64; 3]> {
    let mut places: Vec<[f64; 3]> = (0..cells.pow(3))
        .map(|k| [k % cells, k / cells % cells, k / cells / cells].map(|x| x as f64))
        .collect();
    places.sort_by_key(|p| p.map(|x| x as u32 / 4));
    places
}

#[test]
fn sectors_of_a_surface_give_the_whole_answer() {
    let places = Random::new(11).bumpy(5000);
    compare("outside", &places, [0.0, 0.5, 2.5], 50.0);
    compare("outside, few visible", &places, [2.0, 0.5, 0.0], 6.0);
    compare("inside", &places, [0.1, 0.05, -0.1], 20.0);
}

#[test]
fn sectors_of_a_lattice_give_the_whole_answer() {
    let places = lattice(13);
    compare("far outside", &places, [6.0, 6.0, 40.0], 300.0);
    compare("in a plane of points", &places, [6.0, -9.0, 12.0], 100.0);
    compare("on a line of points", &places, [6.0, 20.0, 12.0], 100.0);
    compare("at a point", &places, [6.0, 6.0, 6.0], 60.0);
    compare("at a corner", &places, [0.0, 0.0, 0.0], 60.0);
}

/// The boundary holds more than the vertices of the hull: points on its faces and edges.
#[test]
fn sectors_of_walls_give_the_whole_answer() {
    let mut random = Random::new(12);
    let size = [8.0, 6.0, 3.0];
    let mut places: Vec<[f64; 3]> = (0..3000)
        .map(|_| {
            let mut p = size.map(|side| random.between(0.0, side));
            let wall = random.below(6) as usize;
            p[wall / 2] = if wall % 2 == 1 { size[wall / 2] } else { 0.0 };
            p
        })
        .collect();
    places.sort_by_key(|p| p.map(|x| x as u32));
    compare("inside", &places, [2.0, 3.0, 1.5], 40.0);
    compare("in a wall", &places, [2.0, 0.0, 1.5], 4000.0);
    compare("in a wall, few visible", &places, [2.0, 0.0, 1.5], 11.0);
    compare("at a point", &places, places[1700], 30.0);
}

/// Between the clusters there are large faces that no far point sees.
#[test]
fn sectors_of_clusters_give_the_whole_answer() {
    let mut random = Random::new(13);
    let mut places = Vec::new();
    for _ in 0..60 {
        let center = random.between(0.8, 1.2) * random.direction();
        let size = random.between(0.02, 0.15);
        for _ in 0..64 {
            places.push((center + size * random.direction()).to_array());
        }
    }
    compare("inside", &places, [0.05, 0.1, -0.1], 20.0);
    compare("inside, many visible", &places, [0.05, 0.1, -0.1], 500.0);
    compare("outside", &places, [0.0, 0.3, 2.5], 40.0);
}

/// Points that flip exactly on to the edges of an octahedron, with numbers that no operation rounds. All
/// are visible, though only its corners are vertices.
#[test]
fn points_on_the_boundary_belong_to_their_sectors() {
    let mut places: Vec<[f64; 3]> = Vec::new();
    for axis in 0..3 {
        for sign in [3.0, -3.0] {
            let mut corner = [0.0; 3];
            corner[axis] = sign;
            places.push(corner);
        }
    }
    for axis in 0..3 {
        for [x, y] in [[3.0, 4.0], [4.0, -3.0], [-4.0, 3.0], [-3.0, -4.0]] {
            let mut on_edge = [0.0; 3];
            on_edge[axis] = x;
            on_edge[(axis + 1) % 3] = y;
            places.push(on_edge);
        }
    }
    compare("octahedron", &places, [0.0; 3], 5.0);
    let points = Points::Double(places);
    let flip = Flip::new([0.0; 3], Kernel::Spherical { radius: 5.0 });
    let mut memory = Memory::default();
    mark_visible(&points, &[], &flip, &mut memory).unwrap();
    assert_eq!(memory.visible(), [true; 18]);
}

/// A share whose hull holds the near points.
fn near_share<'a>(memory: &'a mut Memory, flipped: &'a Flipped, division: Division) -> Share<'a> {
    let corners = outer_boundary::seed(flipped).unwrap();
    let room = flipped.len();
    memory.hull.start(corners, flipped.reach(), room).unwrap();
    memory.clear_marks(room).unwrap();
    let mut share = Share {
        hull: &mut memory.hull,
        flipped,
        division,
        visible: &mut memory.visible,
        hint: 0,
        open_vertices: Vec::new(),
        on_boundary: Vec::new(),
    };
    share.add_near(u64::MAX).unwrap();
    share
}

/// The viewpoint is just inside of a large face: the middle of a cap may lie beyond this face. Then no
/// ring is looked for.
#[test]
fn sectors_behind_a_near_face_give_the_whole_answer() {
    let mut random = Random::new(15);
    let depth = 1e-6;
    let mut places: Vec<[f64; 3]> = (0..3000)
        .map(|_| {
            let u = random.direction();
            let x = u.x.abs().max(depth);
            (random.between(1.0, 1.1) * DVec3::new(x, u.y, u.z)).to_array()
        })
        .collect();
    let corners = 3000..3006;
    places.extend(corners.clone().map(|k| {
        let (sine, cosine) = f64::from(k).sin_cos();
        [-depth, cosine, sine]
    }));
    compare("just inside", &places, [0.0; 3], 10.0);
    let points = Points::Double(places);
    let flip = Flip::new([0.0; 3], Kernel::Spherical { radius: 10.0 });
    let flipped = Flipped::of(&points, &[], &flip);
    let mut doubtful = 0;
    for number in 0..7 {
        let mut memory = Memory::default();
        let division = division(&points, [0.0; 3], 10.0, [number, 7]);
        let mut share = near_share(&mut memory, &flipped, division);
        for corner in corners.clone() {
            share.add(corner).unwrap();
        }
        let hull = &share.hull;
        let outer = || hull.surface.alive().filter(|(id, _)| hull.is_outer(*id));
        let is_beyond = |q| outer().any(|(_, face)| hull.vertices.side(face, q) == Sign::Positive);
        if share.division.outside().any(is_beyond) {
            assert!(share.outside().unwrap().is_empty());
            doubtful += 1;
        }
    }
    assert!(doubtful >= 5, "{doubtful} of 7 sectors are in doubt");
}

/// A ring face has own corners, is outer, and no far point is seen in its directions. The search for
/// faces that far points see starts at all ghost faces and in each cap beyond a side of the cell.
#[test]
fn rings_are_made_of_clear_faces() {
    let points = Points::Double(Random::new(14).bumpy(6000));
    for viewpoint in [[0.1, 0.05, -0.1], [0.0, 0.5, 2.5]] {
        let flip = Flip::new(viewpoint, Kernel::Spherical { radius: 40.0 });
        let flipped = Flipped::of(&points, &[], &flip);
        for number in 0..3 {
            let mut memory = Memory::default();
            let division = division(&points, viewpoint, 40.0, [number, 3]);
            let mut share = near_share(&mut memory, &flipped, division);
            share.open_own_vertices().unwrap();
            let mut clear = 0;
            for (id, face) in share.hull.surface.alive() {
                let owns = |v: Vertex| v != ORIGIN && share.division.owns(share.hull.point(v));
                let indices = face
                    .vertices
                    .map(|v| share.hull.vertices.points[v as usize]);
                let places = face.vertices.map(|v| share.hull.vertices.at(v));
                let is_clear = face.vertices.into_iter().all(owns)
                    && share.hull.is_sound(id)
                    && share.division.is_clear(indices, places);
                assert_eq!(share.is_clear(id), is_clear);
                clear += u32::from(is_clear);
            }
            assert!(clear > 50, "{clear}");

            let outside = share.outside().unwrap();
            let has_ghosts = viewpoint[2] > 1.0;
            let is_ghost = |id: &FaceId| share.hull.corners(*id).unwrap().contains(&ORIGIN);
            let ghosts = share.hull.surface.alive().filter(|(id, _)| is_ghost(id));
            assert_eq!(
                ghosts.count(),
                outside.iter().filter(|id| is_ghost(id)).count()
            );
            assert!(outside.iter().any(is_ghost) || !has_ghosts);
            for q in share.division.outside() {
                let is_met = outside
                    .iter()
                    .any(|&id| !is_ghost(&id) && share.hull.pierces(id, q));
                assert!(is_met || has_ghosts, "{q}");
            }
        }
    }
}
