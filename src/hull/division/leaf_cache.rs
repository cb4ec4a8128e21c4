//! Which leaves of a tree of cones can be above planes that are alike.

use alloc::vec::Vec;
use glam::DVec3;

use crate::base::allocation::{OutOfMemory, push, reserve};
use crate::base::real::square_root;
use crate::cloud::blocks::FANOUT;
use crate::hull::division::cone::Cone;

/// The largest angle between planes that are alike, in spreads of the leaves.
const TURN: f64 = 0.7;

/// The leaves for one plane and for all planes that are alike. Neighboring faces are asked about
/// one after another, so one search serves many of them. On 8 threads, views of KITTI scans take .88 of the instructions.
pub(super) struct LeafCache {
    /// The planes are across about this direction.
    direction: DVec3,
    /// The planes are farther than this from the origin.
    limit: f64,
    /// The cosine and the sine of the largest angle between planes that are alike.
    turn: (f64, f64),
    /// The nodes that a search has yet to visit.
    path: Vec<(u32, u32)>,
    /// The leaves that may be above one of the planes.
    pub leaves: Vec<u32>,
}

impl LeafCache {
    /// `spread` is the angle of a usual leaf of a tree with `levels` levels.
    pub(super) fn new(spread: f64, levels: usize) -> Result<Self, OutOfMemory> {
        let sin = (TURN * spread).min(0.5);
        let mut path = Vec::new();
        reserve(&mut path, FANOUT * levels)?;
        Ok(Self {
            direction: DVec3::X,
            limit: f64::INFINITY,
            turn: (square_root(1.0 - sin * sin), sin),
            path,
            leaves: Vec::new(),
        })
    }

    /// Finds the leaves for a plane, unless they are known from a plane that is alike. The leaves
    /// may hold points q with m·q of at least `limit`, which is positive. `length` is the length of
    /// m. Level 0 of the tree holds the leaves. Nodes that are empty are left out.
    #[inline]
    pub(super) fn turn_to(
        &mut self,
        (m, limit): (DVec3, f64),
        length: f64,
        levels: &[Vec<Cone>],
        is_empty: impl Fn(usize, usize) -> bool,
    ) -> Result<(), OutOfMemory> {
        let is_alike = m.dot(self.direction) > self.turn.0 * length && limit > self.limit * length;
        if is_alike {
            return Ok(());
        }
        let (_, sin) = self.turn;
        self.direction = m / length;
        self.limit = limit / length * (1.0 - sin * sin);
        self.search(levels, is_empty)
    }

    #[inline(never)]
    fn search(
        &mut self,
        levels: &[Vec<Cone>],
        is_empty: impl Fn(usize, usize) -> bool,
    ) -> Result<(), OutOfMemory> {
        let (cos, sin) = self.turn;
        let top = levels.len() - 1;
        self.leaves.clear();
        self.path.clear();
        self.path
            .extend((0..levels[top].len() as u32).map(|node| (top as u32, node)));
        while let Some((level, node)) = self.path.pop() {
            let (level, node) = (level as usize, node as usize);
            let cone = &levels[level][node];
            if is_empty(level, node)
                || cone.widened(cos, sin).bound(self.direction, 1.0) < self.limit
            {
                continue;
            }
            if level == 0 {
                push(&mut self.leaves, node as u32)?;
                continue;
            }
            let below = levels[level - 1].len();
            let children = node * FANOUT..below.min((node + 1) * FANOUT);
            self.path
                .extend(children.map(|child| (level as u32 - 1, child as u32)));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::random::Random;

    const SPREAD: f64 = 0.2;
    const SIN: f64 = 0.7 * SPREAD;

    /// Eight bundles of eight narrow cones, and the cones of the bundles.
    fn tree(random: &mut Random) -> Vec<Vec<Cone>> {
        let mut levels = [Vec::new(), Vec::new()];
        for _ in 0..8 {
            let axis = random.direction();
            let mut bundle = Vec::new();
            for _ in 0..FANOUT {
                let u = (axis + 0.2 * random.direction()).normalize();
                let ends =
                    [0; 3].map(|_| random.between(1.0, 2.0) * (u + 0.1 * random.direction()));
                levels[0].push(Cone::around(&ends));
                bundle.extend(ends);
            }
            levels[1].push(Cone::around(&bundle));
        }
        levels.into()
    }

    /// Asks for a plane. Returns how many nodes were visited.
    fn ask(cache: &mut LeafCache, plane: (DVec3, f64), levels: &[Vec<Cone>]) -> u32 {
        let visited = core::cell::Cell::new(0);
        let is_empty = |level: usize, node: usize| {
            visited.set(visited.get() + 1);
            [(1, 3), (0, 8)].contains(&(level, node))
        };
        let length = plane.0.length();
        cache.turn_to(plane, length, levels, is_empty).unwrap();
        visited.get()
    }

    #[test]
    fn the_leaves_are_those_that_reach_a_plane_that_is_alike() {
        let mut random = Random::new(7);
        let levels = tree(&mut random);
        let mut found = 0;
        for _ in 0..2000 {
            let mut cache = LeafCache::new(SPREAD, 2).unwrap();
            let m = random.between(0.2, 3.0) * random.direction();
            let limit = m.length() * random.between(0.8, 1.9);
            assert!(ask(&mut cache, (m, limit), &levels) >= 8);
            let reaches = |cone: &Cone| {
                let wide = cone.widened((1.0 - SIN * SIN).sqrt(), SIN);
                wide.bound(m.normalize(), 1.0) >= limit / m.length() * (1.0 - SIN * SIN)
            };
            let mut leaves = cache.leaves.clone();
            leaves.sort_unstable();
            let expected: Vec<u32> = (0..64)
                .filter(|&leaf| leaf / 8 != 3 && leaf != 8)
                .filter(|&leaf| reaches(&levels[0][leaf as usize]))
                .filter(|&leaf| reaches(&levels[1][leaf as usize / 8]))
                .collect();
            assert_eq!(leaves, expected);
            found += leaves.len();
        }
        assert!((2000..60_000).contains(&found), "{found}");
    }

    #[test]
    fn planes_that_are_alike_share_a_search() {
        let mut random = Random::new(8);
        let levels = tree(&mut random);
        for _ in 0..200 {
            let mut cache = LeafCache::new(SPREAD, 2).unwrap();
            let u = random.direction();
            let across = u.any_orthonormal_vector();
            let limit = random.between(0.5, 1.5);
            let turned = |sin: f64| f64::sqrt(1.0 - sin * sin) * u + sin * across;
            let [first, second] = [0; 2].map(|_| random.between(0.2, 5.0));
            assert!(ask(&mut cache, (first * u, first * limit), &levels) > 0);
            let mut visits = |sin: f64, lower: f64| {
                let plane = (second * turned(sin), second * limit * lower);
                ask(&mut cache, plane, &levels)
            };
            assert_eq!(visits(0.99 * SIN, 1.0), 0);
            assert_eq!(visits(0.0, 1.0 - 0.99 * SIN * SIN), 0);
            assert_eq!(visits(0.99 * SIN, 9.0), 0);
            assert!(visits(0.0, 1.0 - 1.01 * SIN * SIN) > 0);
            assert!(visits(1.01 * SIN, 1.0) > 0);
        }
        // Very wide leaves do not make planes alike that are far from each other.
        let cache = LeafCache::new(5.0, 2).unwrap();
        assert_eq!(cache.turn, (0.75f64.sqrt(), 0.5));
    }
}
