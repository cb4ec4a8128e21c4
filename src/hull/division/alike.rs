//! Which leaves of a tree of cones can be above planes that are alike.

use alloc::vec::Vec;
use glam::DVec3;

use super::cone::Cone;
use crate::base::allocation::{OutOfMemory, push, reserve};
use crate::base::real::square_root;
use crate::cloud::blocks::FANOUT;

/// The largest angle between planes that are alike, in spreads of the leaves.
const TURN: f64 = 0.7;

/// The leaves for one plane and for all planes that are alike. Neighboring faces are asked about
/// one after another, so one search serves many of them.
pub(super) struct Alike {
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

impl Alike {
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
