//! The points that a map is made of. A pool is sampled evenly once. For each map, points of the pool
//! that the last map hid are left out, since they hide nothing.

use alloc::vec::Vec;
use glam::DVec3;

use crate::answers::sample::even_places;
use crate::answers::visibility_map::hides::VisibilityMap;
use crate::answers::visibility_map::options::MapOptions;
use crate::base::allocation::{OutOfMemory, filled, reserve};
use crate::base::real::square_root;
use crate::cloud::points::Points;
use crate::view::resolved::normalized;

/// How many points a pool has for each point of a map: in all directions, and for a map towards some
/// of them.
const TIMES: [usize; 2] = [3, 12];
/// A map takes one in so many of the points that are probably visible in the whole cloud, but at least
/// `FEW`: more would cost much of what the exact answer costs. Looks cost more.
const ONE_IN: u64 = 8;
const ONE_IN_LOOKS: u64 = 2;
pub(super) const FEW: u64 = 8192;
/// One in so many points may always be chosen, so that no place is forgotten.
const ALWAYS: usize = 16;
/// A map tests one in so many points of the pool, each time others.
const TURNS: usize = 4;
/// If it newly hides more than this share of them, all are tested.
const STALE: f64 = 0.1;
/// How much wider than the given cone the points are, as a share of the angle.
const WIDER: f64 = 1.1;

pub(super) struct Pool {
    /// As it was asked for.
    size: usize,
    /// Whether its points were moved to where they would be without noise.
    is_smooth: bool,
    /// How many points the cloud has.
    all: usize,
    points: Points,
    /// The points that were hidden when they were asked for last.
    is_hidden: Vec<bool>,
    /// The points of the last map.
    chosen: Vec<u32>,
    turn: usize,
    /// How many points of the cloud a chosen one stands for.
    stands_for: f64,
}

impl Pool {
    /// The kept pool, if it is of this size, or a new one.
    pub(super) fn of<'a>(
        kept: &'a mut Option<Self>,
        points: &Points,
        is_smooth: bool,
        map: &MapOptions,
    ) -> Result<&'a mut Self, OutOfMemory> {
        let size = map
            .points
            .saturating_mul(TIMES[usize::from(map.towards.is_some())]);
        let is_same = |pool: &Self| pool.size == size && pool.is_smooth == is_smooth;
        let new = match kept.take().filter(is_same) {
            Some(pool) => pool,
            None => {
                let all = points.len();
                let points = points.gathered(&even_places(all, size.min(all))?)?;
                Self {
                    size,
                    is_smooth,
                    all,
                    is_hidden: filled(points.len(), false)?,
                    points,
                    chosen: Vec::new(),
                    turn: 0,
                    stands_for: 1.0,
                }
            }
        };
        Ok(kept.insert(new))
    }

    /// An even part of the points that may hide something.
    pub(super) fn choose(
        &mut self,
        viewpoint: [f64; 3],
        map: &MapOptions,
        is_for_looks: bool,
        last: Option<&VisibilityMap>,
    ) -> Result<Points, OutOfMemory> {
        let cone = Cone::of(map);
        let viewpoint = DVec3::from_array(viewpoint);
        let is_asked = |point: [f64; 3]| {
            let seen = |cone: &Cone| cone.contains(DVec3::from_array(point) - viewpoint);
            cone.as_ref().is_none_or(seen)
        };
        if let Some(last) = last {
            let (tested, new) = self.test(last, self.turn, TURNS, &is_asked);
            if new as f64 > STALE * tested as f64 {
                self.test(last, 0, 1, &is_asked);
            }
            self.turn = (self.turn + 1) % TURNS;
        }
        self.chosen.clear();
        reserve(&mut self.chosen, self.points.len())?;
        for (place, &is_hidden) in self.is_hidden.iter().enumerate() {
            if (!is_hidden || place % ALWAYS == 0) && is_asked(self.points.get(place)) {
                self.chosen.push(place as u32);
            }
        }
        let count = self.chosen.len() as u64;
        let visible = count * self.all as u64 / self.points.len().max(1) as u64;
        let one_in = match cone {
            None if is_for_looks => ONE_IN_LOOKS,
            None => ONE_IN,
            // Of some directions it takes all.
            Some(_) => 1,
        };
        let budget = (visible / one_in).max(FEW).min(map.points as u64);
        if count > budget {
            let mut number = 0;
            self.chosen.retain(|_| {
                let [before, after] = [number, number + 1].map(|n| n * budget / count);
                number += 1;
                before != after
            });
        }
        self.stands_for = visible as f64 / self.chosen.len().max(1) as f64;
        self.points.gathered(&self.chosen)
    }

    /// Marks the points that this map hides: every `step`th one that is asked for. Returns how many
    /// there were, and how many of them were not marked before.
    fn test(
        &mut self,
        last: &VisibilityMap,
        first: usize,
        step: usize,
        is_asked: &dyn Fn([f64; 3]) -> bool,
    ) -> (usize, usize) {
        let [mut tested, mut new] = [0; 2];
        for place in (first..self.points.len()).step_by(step) {
            let point = self.points.get(place);
            if is_asked(point) {
                let is_hidden = last.hides(point);
                tested += 1;
                new += usize::from(is_hidden && !self.is_hidden[place]);
                self.is_hidden[place] = is_hidden;
            }
        }
        (tested, new)
    }

    pub(super) fn stands_for(&self) -> f64 {
        self.stands_for
    }

    /// Marks the chosen points that their own hull hides.
    pub(super) fn mark(&mut self, visible: &[bool]) {
        for (&place, visible) in self.chosen.iter().zip(visible) {
            self.is_hidden[place as usize] = !visible;
        }
    }
}

/// The directions of a map.
pub(super) struct Cone {
    axis: DVec3,
    cosine: f64,
}

impl Cone {
    /// `None` for a map of all directions.
    pub(super) fn of(map: &MapOptions) -> Option<Self> {
        let (direction, angle) = map.towards?;
        let half = (WIDER * 0.5 * angle).to_radians();
        let axis = normalized(direction)?;
        (half < core::f64::consts::PI).then(|| Self {
            axis,
            cosine: libm::cos(half),
        })
    }

    pub(super) fn contains(&self, v: DVec3) -> bool {
        v.dot(self.axis) >= self.cosine * square_root(v.dot(v))
    }
}
