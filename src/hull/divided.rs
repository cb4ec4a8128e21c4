//! Small views divided among sectors. The sectors' answers together are compared with the answer of
//! one hull.

use alloc::vec::Vec;
use glam::DVec3;

use super::division::{Division, Sector};
use super::{Memory, mark_visible};
use crate::base::random::Random;
use crate::cloud::blocks::Blocks;
use crate::cloud::points::Points;
use crate::flip::inversion::Flip;
use crate::flip::kernel::Kernel;

fn compare(title: &str, places: &[[f64; 3]], viewpoint: [f64; 3], radius: f64) {
    let points = Points::Double(places.to_vec());
    let blocks = Blocks::around(&points).unwrap();
    let spheres = &blocks.levels[0];
    let flip = Flip::new(viewpoint, Kernel::Spherical { radius });
    let mut whole = Memory::default();
    mark_visible(&points, spheres, &flip, None, &mut whole).unwrap();
    let seen: Vec<bool> = Division::sample(&blocks)
        .map(|index| whole.visible()[index as usize])
        .collect();
    for count in [2, 3, 7] {
        let mut times_visible: Vec<u32> = places.iter().map(|_| 0).collect();
        let mut memory = Memory::default();
        for number in 0..count {
            let sector = Sector::new(number, count).unwrap();
            let center = DVec3::from_array(viewpoint);
            let division = Division::new(&points, &blocks, center, radius, &seen, sector);
            let division = Some(division.unwrap());
            memory.forget();
            mark_visible(&points, spheres, &flip, division, &mut memory).unwrap();
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
