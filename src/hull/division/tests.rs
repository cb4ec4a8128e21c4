//! Which points a sector owns, which are near, and which faces are clear of far points.

use super::*;
use crate::base::random::Random;

const RADIUS: f64 = 10.0;

/// A cloud, a viewpoint and its sectors.
struct Scene {
    points: Points,
    viewpoint: DVec3,
    sectors: Vec<Division>,
}

fn scene(count: u32) -> Scene {
    scene_of(6000, count)
}

fn scene_of(points: usize, count: u32) -> Scene {
    let mut random = Random::new(9);
    let points = Points::Double(random.bumpy(points));
    let viewpoint = DVec3::new(0.1, -0.05, 0.2);
    let blocks = Blocks::around(&points).unwrap();
    let seen: Vec<bool> = Division::sample(&blocks).map(|k| k % 3 == 0).collect();
    let sector = |number| {
        let sector = Sector { number, count };
        Division::new(&points, &blocks, viewpoint, RADIUS, &seen, sector).unwrap()
    };
    Scene {
        sectors: (0..count).map(sector).collect(),
        points,
        viewpoint,
    }
}

impl Scene {
    fn direction(&self, index: u32) -> DVec3 {
        (DVec3::from_array(self.points.get(index as usize)) - self.viewpoint).normalize()
    }

    fn indices(&self) -> core::ops::Range<u32> {
        0..self.points.len() as u32
    }
}

#[test]
fn the_sample_has_the_first_point_of_blocks_at_even_steps() {
    let steps = [0, 1, 1024, 1025, 2048, 2049, 10_240].map(sample_step);
    assert_eq!(steps, [1, 1, 1, 2, 2, 3, 10]);
    let points = Points::Double(Random::new(1).bumpy(150));
    let blocks = Blocks::around(&points).unwrap();
    assert!(Division::sample(&blocks).eq([0, 64, 128]));
}

#[test]
fn each_point_has_one_owner_and_the_band_around_a_cell_is_near() {
    for count in [1, 2, 3, 8] {
        let mut scene = scene(count);
        for index in scene.indices() {
            let owners = (scene.sectors.iter()).filter(|sector| sector.owns(index));
            assert_eq!(owners.count(), 1);
        }
        for number in 0..count as usize {
            let sector = &scene.sectors[number];
            assert!(sector.clearance > 0.01);
            let mut near = 0;
            for index in scene.indices() {
                let u = scene.direction(index);
                let is_near = sector.cell.excess(u) <= sector.clearance;
                let bits = sector.near(index as usize / BLOCK);
                assert_eq!(bits >> (index as usize % BLOCK) & 1 != 0, is_near);
                assert!(is_near || !sector.owns(index));
                near += usize::from(is_near);
            }
            assert_eq!(sector.near_points(), near);
            let is_far =
                |index: &u32| scene.sectors[number].excess(*index, scene.direction(*index));
            let far = scene.indices().find(|index| is_far(index) > 0.5);
            assert_eq!(far.is_some(), count > 1);
            if let Some(far) = far {
                assert!(!scene.sectors[number].far.is_taken(far));
                scene.sectors[number].take(far);
                assert!(scene.sectors[number].far.is_taken(far));
            }
        }
    }
}

#[test]
fn the_excess_of_a_point_is_exact_but_deep_inside() {
    for count in [2, 3] {
        let scene = scene_of(40_000, count);
        let mut deep = 0;
        for sector in &scene.sectors {
            for index in scene.indices() {
                let u = scene.direction(index);
                let exact = sector.cell.excess(u);
                let excess = sector.excess(index, 15.0 * u);
                let is_deep = excess < -sector.clearance;
                assert!(excess >= exact - 1e-12);
                assert!(is_deep || (excess - exact).abs() < 1e-12);
                deep += u32::from(is_deep && excess > exact + 1e-6);
            }
        }
        assert!(deep > 100, "{deep}");
    }
}

/// A face is clear if its longest edge is shorter than the way from each corner to where
/// directions of far points begin.
#[test]
fn short_faces_inside_the_band_are_clear() {
    let mut random = Random::new(10);
    for count in [1, 2, 5] {
        let scene = scene(count);
        let mut clear = [0; 2];
        for sector in &scene.sectors {
            for _ in 0..5000 {
                let index = random.below(6000) as u32;
                let u = scene.direction(index);
                let largest = [1.0, 0.3, 0.05][random.below(3) as usize];
                let size = random.between(0.0, largest);
                let corners = [0; 3].map(|_| {
                    let length = RADIUS * random.between(1.0, 1.05);
                    length * (u + size * random.direction()).normalize()
                });
                let [p, q, r] = corners;
                let longest = p.distance(q).max(q.distance(r)).max(r.distance(p)) / RADIUS;
                let rooms = corners.map(|q| sector.clearance - sector.excess(index, q));
                let room = rooms.into_iter().fold(1.0, f64::min);
                if (longest - room).abs() < 1e-6 {
                    continue;
                }
                let is_clear = sector.is_clear([index; 3], corners);
                assert_eq!(is_clear, longest < room, "{longest}, {room}");
                clear[usize::from(is_clear)] += 1;
            }
        }
        assert!(clear.iter().all(|&faces| faces > 300), "{clear:?}");
    }
}

/// Where directions are in doubt, a face is not clear.
#[test]
fn a_face_at_the_border_of_the_band_is_not_clear() {
    let scene = scene(2);
    let sector = &scene.sectors[0];
    // In the middle of the cap beyond a side.
    let cap = sector.cell.caps(sector.clearance).next().unwrap();
    let side = 1.0 - sector.cell.excess(cap);
    let index = scene
        .indices()
        .find(|&k| sector.excess(k, scene.direction(k)) > 0.0)
        .unwrap();
    let is_clear = |inside: f64| {
        let along = side + sector.clearance - inside;
        let across = f64::sqrt(1.0 - along * along);
        let u = along * cap + across * cap.any_orthonormal_vector();
        sector.is_clear([index; 3], [RADIUS * u; 3])
    };
    assert!(is_clear(1e-8));
    assert!(!is_clear(1e-9));
    assert!(!is_clear(-1e-8));
}

#[test]
fn places_outside_are_in_the_caps_near_the_viewpoint() {
    let scene = scene(3);
    for sector in &scene.sectors {
        let caps: Vec<DVec3> = sector.cell.caps(sector.clearance).collect();
        assert!(!caps.is_empty());
        let outside: Vec<DVec3> = sector.outside().map(|q| 1e3 / RADIUS * q).collect();
        assert_eq!(caps.len(), outside.len());
        assert!(
            caps.iter()
                .zip(&outside)
                .all(|(u, q)| u.distance(*q) < 1e-9)
        );
    }
}

#[test]
fn a_point_at_the_viewpoint_has_no_direction() {
    assert_eq!(direction(DVec3::new(0.0, -3.0, 0.0)), -DVec3::Y);
    assert_eq!(direction(DVec3::new(1e-90, 0.0, 0.0)), DVec3::X);
    assert_eq!(direction(DVec3::new(1e-110, 0.0, 0.0)), DVec3::ZERO);
    assert_eq!(direction(DVec3::ZERO), DVec3::ZERO);
}
