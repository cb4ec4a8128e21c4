//! Points that are stored elsewhere. Only boxes that hold them are known.

use alloc::vec::Vec;
use glam::DVec3;

use crate::base::allocation::{OutOfMemory, with_capacity};
use crate::base::real::square_root;
use crate::cloud::blocks::FANOUT;
use crate::flip::inversion::Flip;
use crate::hull::division::cone::Cone;
use crate::hull::division::leaf_cache::LeafCache;

/// A box: the corner with the least coordinates and the corner with the largest ones.
type Corners = [[f64; 3]; 2];

/// A bound of all roundings in the distance of a box, relative to its coordinates.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Boxes of points, and which of them can be above a plane.
pub(crate) struct Elsewhere {
    /// The cones of the boxes, and of the nodes above them. Empty boxes are above no plane.
    levels: Vec<Vec<Cone>>,
    /// Boxes that count as above every plane, since no plane is certain for their points.
    everywhere: Vec<u32>,
    cache: LeafCache,
}

impl Elsewhere {
    /// `flip` is scaled as the hull is. Its planes are certain for flipped points up to half of
    /// its reach.
    #[inline(never)]
    pub(crate) fn new(boxes: &[Corners], flip: &Flip) -> Result<Self, OutOfMemory> {
        let mut cones = with_capacity(boxes.len())?;
        let mut everywhere = with_capacity(boxes.len())?;
        let mut spread = 0.0;
        for (number, corners) in (0..).zip(boxes) {
            let mut cone = cone_of(corners, flip);
            if cone.is_everywhere() || cone.reach > 0.5 * flip.reach() {
                everywhere.push(number);
                // Among the cones it is above no plane.
                cone.reach = 0.0;
            }
            spread += cone.spread();
            cones.push(cone);
        }
        let spread = spread / boxes.len().max(1) as f64;
        let mut bounds: Vec<Corners> = with_capacity(boxes.len())?;
        bounds.extend_from_slice(boxes);
        let mut levels = Vec::new();
        while cones.len() > FANOUT {
            bounds = joined(&bounds)?;
            let mut above = with_capacity(bounds.len())?;
            for (corners, below) in bounds.iter().zip(cones.chunks(FANOUT)) {
                let mut cone = cone_of(corners, flip);
                // The node may hold boxes that are everywhere. Its cone is for the others.
                let most = |reach: f64, below: &Cone| {
                    if below.reach > reach {
                        below.reach
                    } else {
                        reach
                    }
                };
                cone.reach = below.iter().fold(0.0, most);
                above.push(cone);
            }
            levels.try_reserve(1)?;
            levels.push(core::mem::replace(&mut cones, above));
        }
        levels.try_reserve(1)?;
        levels.push(cones);
        Ok(Self {
            cache: LeafCache::new(spread, levels.len())?,
            levels,
            everywhere,
        })
    }

    /// How many boxes there are.
    pub(crate) fn len(&self) -> usize {
        self.levels[0].len()
    }

    /// Calls `found` with the number of each box that may hold points above a plane. A point q with
    /// m·q below the limit is not above it.
    pub(crate) fn above(
        &mut self,
        (m, limit): (DVec3, f64),
        found: &mut dyn FnMut(u32),
    ) -> Result<(), OutOfMemory> {
        if limit <= 0.0 {
            // The plane says nothing.
            (0..self.len() as u32).for_each(found);
            return Ok(());
        }
        let length = square_root(m.dot(m));
        self.cache
            .turn_to((m, limit), length, &self.levels, |_, _| false)?;
        let cones = &self.levels[0];
        let may_be_above = |leaf: &&u32| cones[**leaf as usize].bound(m, length) >= limit;
        let leaves = self.cache.leaves.iter().filter(may_be_above);
        leaves
            .chain(&self.everywhere)
            .for_each(|&number| found(number));
        Ok(())
    }
}

/// Each `FANOUT` boxes as one.
fn joined(boxes: &[Corners]) -> Result<Vec<Corners>, OutOfMemory> {
    let mut all = with_capacity(boxes.len().div_ceil(FANOUT))?;
    for run in boxes.chunks(FANOUT) {
        let mut whole = run[0];
        for [low, high] in run {
            for axis in 0..3 {
                whole[0][axis] = whole[0][axis].min(low[axis]);
                whole[1][axis] = whole[1][axis].max(high[axis]);
            }
        }
        all.push(whole);
    }
    Ok(all)
}

/// The cone of the flipped points of a box. A cone is convex. So one that holds the corners holds
/// the box.
fn cone_of([low, high]: &Corners, flip: &Flip) -> Cone {
    let viewpoint = flip.viewpoint();
    let low = DVec3::from_array(*low) - viewpoint;
    let high = DVec3::from_array(*high) - viewpoint;
    let corners: [DVec3; 8] = core::array::from_fn(|corner| {
        let of = |axis: usize| {
            if corner >> axis & 1 == 0 {
                low[axis]
            } else {
                high[axis]
            }
        };
        DVec3::new(of(0), of(1), of(2))
    });
    let mut cone = Cone::around(&corners);
    let nearest = DVec3::ZERO.clamp(low, high);
    let distance = square_root(nearest.dot(nearest));
    // Squares must not have underflowed. The comparison also refuses a NaN.
    cone.reach = if distance > 1e-100 {
        flip.most_beyond(distance * (1.0 - ROUNDING))
    } else {
        f64::INFINITY
    };
    cone
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::random::Random;
    use crate::cloud::points::Points;
    use crate::flip::kernel::Kernel;

    const RADIUS: f64 = 10.0;

    /// Boxes around the viewpoint, in the order of their longitude.
    fn boxes(random: &mut Random, viewpoint: DVec3) -> Vec<Corners> {
        let mut centers: Vec<DVec3> = (0..600).map(|_| random.direction()).collect();
        centers.sort_by(|u, v| f64::atan2(u.y, u.x).total_cmp(&f64::atan2(v.y, v.x)));
        let corners = |u: DVec3| {
            let center = viewpoint + random.between(2.0, 5.0) * u;
            let half = DVec3::from_array([0; 3].map(|_| random.between(0.0, 0.2)));
            [(center - half).to_array(), (center + half).to_array()]
        };
        centers.into_iter().map(corners).collect()
    }

    /// The corners of a box and its point nearest to the viewpoint.
    fn places(&[low, high]: &Corners, viewpoint: DVec3) -> Vec<[f64; 3]> {
        let corner = |k: usize| core::array::from_fn(|axis| [low, high][k >> axis & 1][axis]);
        let nearest = viewpoint.clamp(DVec3::from_array(low), DVec3::from_array(high));
        (0..8).map(corner).chain([nearest.to_array()]).collect()
    }

    fn above(elsewhere: &mut Elsewhere, plane: (DVec3, f64)) -> Vec<u32> {
        let mut found = Vec::new();
        let answer = elsewhere.above(plane, &mut |number| found.push(number));
        answer.unwrap();
        found.sort_unstable();
        found
    }

    #[test]
    fn the_cone_of_a_box_is_tight() {
        let mut random = Random::new(5);
        let viewpoint = DVec3::new(1.0, -2.0, 0.5);
        let flip = Flip::new(viewpoint.to_array(), Kernel::Spherical { radius: RADIUS });
        for corners in boxes(&mut random, viewpoint) {
            let cone = cone_of(&corners, &flip);
            let places = places(&corners, viewpoint);
            let directions: Vec<DVec3> = (places[..8].iter())
                .map(|&p| (DVec3::from_array(p) - viewpoint).normalize())
                .collect();
            let axis = directions.iter().sum::<DVec3>().normalize();
            assert!(cone.axis.distance(axis) < 1e-9);
            let cosines = directions.iter().map(|u| axis.dot(*u));
            assert!((cone.cos - cosines.fold(1.0, f64::min)).abs() < 1e-9);
            let longest = flip.apply(places[8]).unwrap().length();
            assert!(cone.reach >= longest && cone.reach < longest + 1e-9);
        }
        // The distance is rounded, and a steep flip makes much of that.
        let flip = Flip::new([0.0; 3], Kernel::Exponential { scale: 150.0 });
        let cone = cone_of(&[[1.0, 0.0, 0.0], [1.1, 0.1, 0.1]], &flip);
        assert!(cone.reach > flip.most_beyond(1.0));
        let around = [[-1.0, -1.0, 0.0], [2.0, 1.0, 1.0]];
        assert_eq!(cone_of(&around, &flip).reach, f64::INFINITY);
    }

    #[test]
    fn every_box_with_a_point_above_a_plane_is_found() {
        let mut random = Random::new(6);
        let viewpoint = DVec3::new(-1.0, 0.3, 2.0);
        let flip = Flip::new(viewpoint.to_array(), Kernel::Spherical { radius: RADIUS });
        let mut boxes = boxes(&mut random, viewpoint);
        // The viewpoint is in this box.
        boxes[300] = [
            (viewpoint - DVec3::ONE).to_array(),
            (viewpoint + DVec3::ONE).to_array(),
        ];
        let mut elsewhere = Elsewhere::new(&boxes, &flip).unwrap();
        assert_eq!(elsewhere.len(), 600);
        let mut most = 0;
        for _ in 0..4 {
            for (number, corners) in (0..).zip(&boxes).filter(|(number, _)| *number != 300) {
                for place in places(corners, viewpoint) {
                    let q = flip.apply(place).unwrap();
                    let m = random.between(0.1, 4.0) * (q.normalize() + 0.3 * random.direction());
                    let limit = m.dot(q) * random.between(0.98, 1.0);
                    let found = above(&mut elsewhere, (m, limit));
                    assert!(found.contains(&number) && found.contains(&300));
                    let reaches = |&box_: &u32| {
                        let cone = cone_of(&boxes[box_ as usize], &flip);
                        cone.bound(m, m.length()) >= limit
                    };
                    assert!(found.iter().all(reaches));
                    most = most.max(found.len());
                }
            }
        }
        assert!((20..500).contains(&most), "{most}");
        let all: Vec<u32> = (0..600).collect();
        for limit in [0.0, -1.0] {
            assert_eq!(above(&mut elsewhere, (DVec3::X, limit)), all);
        }
    }

    /// Planes are certain for flipped points of the cloud. A nearer point flips too far.
    #[test]
    fn boxes_nearer_than_the_cloud_are_above_every_plane() {
        let flip = Flip::new([0.0; 3], Kernel::Exponential { scale: 3.0 });
        let flip = flip.rescaled_for(&Points::Double(alloc::vec![[1.0, 0.0, 0.0]]));
        let near = |x: f64| [[x, 0.0, 0.0], [x + 0.01, 0.01, 0.01]];
        let mut elsewhere = Elsewhere::new(&[near(1.0), near(0.2), near(2.0)], &flip).unwrap();
        assert_eq!(elsewhere.everywhere, [1]);
        let m = -DVec3::X;
        assert_eq!(above(&mut elsewhere, (m, 1.0)), [1]);
        let q = flip.apply([1.0, 0.0, 0.0]).unwrap();
        assert_eq!(above(&mut elsewhere, (q, q.dot(q))), [0, 1]);
    }
}
