//! Rings of faces that no far point sees. The check `sectors` compares answers of sectors with those of one hull.

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
use crate::hull::outer_boundary;
use crate::hull::predicates::Sign;

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
    let sector = Sector { number, count };
    let center = DVec3::from_array(viewpoint);
    Division::new(points, &blocks, center, radius, &seen, sector).unwrap()
}

/// A share whose hull holds the near points.
fn near_share<'a>(
    memory: &'a mut Memory,
    flipped: &'a Flipped,
    division: Division,
) -> SectorHull<'a> {
    let corners = outer_boundary::seed(flipped).unwrap();
    let room = flipped.len();
    memory.hull.start(corners, flipped.reach()).unwrap();
    memory.clear_marks(room).unwrap();
    let mut sector = SectorHull {
        hull: &mut memory.hull,
        flipped,
        division,
        visible: &mut memory.visible,
        hint: 0,
        open_vertices: Vec::new(),
        on_boundary: Vec::new(),
    };
    sector.add_near(u64::MAX).unwrap();
    sector
}

/// The viewpoint is just inside of a large face: the middle of a cap may lie beyond this face. Then no
/// ring is looked for.
#[test]
fn no_ring_is_looked_for_behind_a_near_face() {
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
    let points = Points::Double(places);
    let flip = Flip::new([0.0; 3], Kernel::Spherical { radius: 10.0 });
    let flipped = Flipped::of(&points, &[], &flip);
    let mut doubtful = 0;
    for number in 0..7 {
        let mut memory = Memory::new();
        let division = division(&points, [0.0; 3], 10.0, [number, 7]);
        let mut sector = near_share(&mut memory, &flipped, division);
        for corner in corners.clone() {
            sector.add(corner).unwrap();
        }
        let hull = &sector.hull;
        let outer = || hull.surface.alive().filter(|(id, _)| hull.is_outer(*id));
        let is_beyond = |q| outer().any(|(_, face)| hull.vertices.side(face, q) == Sign::Positive);
        if sector.division.outside().any(is_beyond) {
            assert!(sector.outside().unwrap().is_empty());
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
            let mut memory = Memory::new();
            let division = division(&points, viewpoint, 40.0, [number, 3]);
            let mut sector = near_share(&mut memory, &flipped, division);
            sector.open_own_vertices().unwrap();
            let mut clear = 0;
            for (id, face) in sector.hull.surface.alive() {
                let owns = |v: Vertex| v != ORIGIN && sector.division.owns(sector.hull.point(v));
                let indices = face
                    .vertices
                    .map(|v| sector.hull.vertices.points[v as usize]);
                let places = face.vertices.map(|v| sector.hull.vertices.at(v));
                let is_clear = face.vertices.into_iter().all(owns)
                    && sector.hull.is_sound(id)
                    && sector.division.is_clear(indices, places);
                assert_eq!(sector.is_clear(id), is_clear);
                clear += u32::from(is_clear);
            }
            assert!(clear > 50, "{clear}");

            let outside = sector.outside().unwrap();
            let has_ghosts = viewpoint[2] > 1.0;
            let is_ghost = |id: &FaceId| sector.hull.corners(*id).unwrap().contains(&ORIGIN);
            let ghosts = sector.hull.surface.alive().filter(|(id, _)| is_ghost(id));
            assert_eq!(
                ghosts.count(),
                outside.iter().filter(|id| is_ghost(id)).count()
            );
            assert!(outside.iter().any(is_ghost) || !has_ghosts);
            for q in sector.division.outside() {
                let is_met = outside
                    .iter()
                    .any(|&id| !is_ghost(&id) && sector.hull.pierces(id, q));
                assert!(is_met || has_ghosts, "{q}");
            }
        }
    }
}
