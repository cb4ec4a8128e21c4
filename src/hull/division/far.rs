//! The points that are not in a sector's hull, and bounds of m·q over them.

use alloc::vec::Vec;
use glam::DVec3;

use crate::base::allocation::{OutOfMemory, filled, reserve};
use crate::base::real::square_root;
use crate::cloud::blocks::{BLOCK, FANOUT};
use crate::hull::division::cone::Cone;
use crate::hull::division::leaf_cache::LeafCache;
use crate::hull::flipped::Flipped;

/// A block whose points have not been flipped yet.
const CLOSED: u32 = u32::MAX;

pub(super) struct Far {
    /// For each block, a bit for each point that is not far.
    taken: Vec<u64>,
    /// The cones of the blocks and of the nodes above them.
    levels: Vec<Vec<Cone>>,
    /// How many points below each node are far.
    counts: Vec<Vec<u32>>,
    /// The place of each block in `flipped`; `CLOSED` for most.
    opened: Vec<u32>,
    /// The x, y and z of the far points of each opened block, flipped; zero for a point that is not far.
    flipped: Vec<[[f64; BLOCK]; 3]>,
    cache: LeafCache,
}

impl Far {
    /// `taken` tells for each block which of its points are not far. There are `points` points.
    /// `spread` is the angle of a usual block.
    pub(super) fn new(
        levels: Vec<Vec<Cone>>,
        taken: Vec<u64>,
        points: usize,
        spread: f64,
    ) -> Result<Self, OutOfMemory> {
        let mut counts: Vec<Vec<u32>> = Vec::new();
        counts.try_reserve_exact(levels.len())?;
        for cones in &levels {
            let mut level = filled(cones.len(), 0)?;
            match counts.last() {
                None => {
                    for (block, count) in level.iter_mut().enumerate() {
                        *count = (places_in(block, points) & !taken[block]).count_ones();
                    }
                }
                Some(below) => {
                    for (node, count) in below.iter().enumerate() {
                        level[node / FANOUT] += count;
                    }
                }
            }
            counts.push(level);
        }
        Ok(Self {
            opened: filled(taken.len(), CLOSED)?,
            taken,
            cache: LeafCache::new(spread, levels.len())?,
            levels,
            counts,
            flipped: Vec::new(),
        })
    }

    /// The far point with the largest m·q, or `None` if m·q is below `limit` for all far points.
    #[inline(never)]
    pub(super) fn most_in_the_way(
        &mut self,
        (m, mut limit): (DVec3, f64),
        flipped: &Flipped,
    ) -> Result<Option<u32>, OutOfMemory> {
        if limit <= 0.0 {
            // The plane says nothing.
            return Ok(self.first());
        }
        let length = square_root(m.dot(m));
        let counts = &self.counts;
        let is_empty = |level: usize, node: usize| counts[level][node] == 0;
        self.cache
            .turn_to((m, limit), length, &self.levels, is_empty)?;
        let mut most = None;
        for k in 0..self.cache.leaves.len() {
            let block = self.cache.leaves[k] as usize;
            if self.counts[0][block] == 0 || self.levels[0][block].bound(m, length) < limit {
                continue;
            }
            if self.opened[block] == CLOSED {
                self.open(block, flipped)?;
                if self.levels[0][block].bound(m, length) < limit {
                    continue;
                }
            }
            let [x, y, z] = &self.flipped[self.opened[block] as usize];
            let height = |place: usize| m.x * x[place] + m.y * y[place] + m.z * z[place];
            // This loop has no branch.
            let highest =
                (0..BLOCK).map(height).fold(
                    0.0,
                    |highest, height| {
                        if height > highest { height } else { highest }
                    },
                );
            if highest >= limit {
                most = (0..BLOCK)
                    .find(|&place| height(place) == highest)
                    .map(|place| (block * BLOCK + place) as u32);
                limit = highest;
            }
        }
        Ok(most)
    }

    /// Flips the far points of a block. Their own bounds replace the bounds of the block's sphere.
    #[inline(never)]
    fn open(&mut self, block: usize, flipped: &Flipped) -> Result<(), OutOfMemory> {
        let mut points = [[0.0; BLOCK]; 3];
        let start = block * BLOCK;
        let end = flipped.len().min(start + BLOCK);
        let places = (0..end - start).filter(|place| self.taken[block] >> place & 1 == 0);
        let far = places.filter_map(|place| {
            // A point at the viewpoint is in nobody's way.
            let q = flipped.get_out_of_line((start + place) as u32)?;
            Some((place, q))
        });
        let mut all = [DVec3::ZERO; BLOCK];
        let mut count = 0;
        for (place, q) in far {
            for axis in 0..3 {
                points[axis][place] = q[axis];
            }
            all[count] = q;
            count += 1;
        }
        self.levels[0][block] = Cone::around(&all[..count]);
        self.opened[block] = self.flipped.len() as u32;
        reserve(&mut self.flipped, 1)?;
        self.flipped.push(points);
        Ok(())
    }

    /// Any far point.
    fn first(&self) -> Option<u32> {
        let top = self.counts.len() - 1;
        let is_far = |(_, count): &(usize, &u32)| **count > 0;
        let (mut node, _) = self.counts[top].iter().enumerate().find(is_far)?;
        for level in self.counts[..top].iter().rev() {
            let (first, _) = (level.iter().enumerate().skip(node * FANOUT)).find(is_far)?;
            node = first;
        }
        Some((node * BLOCK) as u32 + self.taken[node].trailing_ones())
    }

    pub(super) fn is_taken(&self, index: u32) -> bool {
        self.taken[index as usize / BLOCK] >> (index as usize % BLOCK) & 1 != 0
    }

    /// Notes that a point is in the hull.
    pub(super) fn take(&mut self, index: u32) {
        let (block, place) = (index as usize / BLOCK, index as usize % BLOCK);
        if self.is_taken(index) {
            return;
        }
        self.taken[block] |= 1 << place;
        if let Some(points) = self.flipped.get_mut(self.opened[block] as usize) {
            for axis in points {
                axis[place] = 0.0;
            }
        }
        let mut node = block;
        for counts in &mut self.counts {
            counts[node] -= 1;
            node /= FANOUT;
        }
    }
}

/// A bit for each point of a block, in a cloud of `count` points.
pub(super) fn places_in(block: usize, count: usize) -> u64 {
    let here = BLOCK.min(count - block * BLOCK);
    u64::MAX >> (BLOCK - here)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::random::Random;
    use crate::cloud::blocks::Blocks;
    use crate::cloud::points::Points;
    use crate::flip::inversion::Flip;
    use crate::flip::kernel::Kernel;

    const POINTS: usize = 6000;

    /// Points on a bumpy surface in the order of their longitude, and most of them far.
    fn far(random: &mut Random, flip: &Flip) -> (Points, Far, Vec<bool>) {
        let points = Points::Double(random.bumpy(POINTS));
        let blocks = Blocks::around(&points).unwrap();
        let cone = |sphere| Cone::of(sphere, flip.viewpoint(), 20.0);
        let levels = blocks
            .levels
            .iter()
            .map(|level| level.iter().map(cone).collect());
        let is_far: Vec<bool> = (0..POINTS)
            .map(|k| k > 700 && random.below(5) > 0)
            .collect();
        let mut taken = alloc::vec![0; blocks.levels[0].len()];
        for index in (0..POINTS).filter(|index| !is_far[*index]) {
            taken[index / BLOCK] |= 1 << (index % BLOCK);
        }
        let far = Far::new(levels.collect(), taken, POINTS, 0.2).unwrap();
        (points, far, is_far)
    }

    /// The far point with the largest m·q of at least the limit.
    fn highest((m, limit): (DVec3, f64), flipped: &Flipped, is_far: &[bool]) -> Option<u32> {
        let heights = (0..POINTS as u32)
            .filter(|k| is_far[*k as usize])
            .map(|k| (flipped.get(k).map_or(0.0, |q| m.dot(q)), k));
        let higher = |best: (f64, Option<u32>), (height, k)| {
            let is_higher = height > best.0 || height == best.0 && best.1.is_none();
            if is_higher { (height, Some(k)) } else { best }
        };
        heights.fold((limit, None), higher).1
    }

    /// Blocks are opened by the first plane that they may be above.
    #[test]
    fn the_first_question_finds_points_too() {
        let mut random = Random::new(4);
        let flip = Flip::new([0.0, 0.1, 0.2], Kernel::Spherical { radius: 10.0 });
        for _ in 0..20 {
            let (points, mut far, is_far) = far(&mut random, &flip);
            let flipped = Flipped::of(&points, &[], &flip);
            for _ in 0..5 {
                let q = flipped.get(random.below(POINTS as u64) as u32).unwrap();
                let plane = (q, q.dot(q) * random.between(0.9, 1.0));
                let expected = highest(plane, &flipped, &is_far);
                assert_eq!(far.most_in_the_way(plane, &flipped).unwrap(), expected);
            }
        }
    }

    #[test]
    fn the_point_that_is_most_in_the_way_is_found() {
        let mut random = Random::new(3);
        let flip = Flip::new([0.0, 0.1, 0.2], Kernel::Spherical { radius: 10.0 });
        let (points, mut far, mut is_far) = far(&mut random, &flip);
        let flipped = Flipped::of(&points, &[], &flip);
        let mut found = [0, 0];
        let mut m = random.direction() / 19.0;
        for round in 0..3000 {
            // Most planes are alike the one before.
            m = match round % 10 {
                0 => random.direction() / random.between(18.0, 20.0),
                _ => m + 0.002 * random.direction(),
            };
            let limit = random.between(0.97, 1.03);
            let expected = highest((m, limit), &flipped, &is_far);
            let asked = far.most_in_the_way((m, limit), &flipped).unwrap();
            assert_eq!(asked, expected, "round {round}");
            found[usize::from(asked.is_some())] += 1;
            if let Some(index) = asked.filter(|_| round % 3 == 0) {
                far.take(index);
                far.take(index);
                is_far[index as usize] = false;
                assert!(far.is_taken(index));
            }
        }
        assert!(found.iter().all(|&count| count > 500), "{found:?}");
        // Most blocks were never asked about.
        let open = far.opened.iter().filter(|&&place| place != CLOSED);
        assert!(far.flipped.len() == open.count());
        // A plane that says nothing gets any far point, and at last all of them.
        let left = is_far.iter().filter(|is_far| **is_far).count();
        for _ in 0..left {
            let index = far.most_in_the_way((m, 0.0), &flipped).unwrap().unwrap();
            assert!(core::mem::take(&mut is_far[index as usize]));
            far.take(index);
        }
        assert_eq!(far.most_in_the_way((m, -1.0), &flipped).unwrap(), None);
        assert!(far.counts.iter().flatten().all(|&count| count == 0));
    }
}
