//! The points that a map is made of. A pool is sampled evenly once. For each map, points of the pool
//! that the last map hid are left out, since they hide nothing.

use alloc::vec::Vec;
use glam::DVec3;

use crate::answers::sample::even_places;
use crate::answers::visibility_map::hides::VisibilityMap;
use crate::answers::visibility_map::options::MapOptions;
use crate::base::allocation::{OutOfMemory, with_capacity};
use crate::base::real::square_root;
use crate::cloud::points::Points;
use crate::view::resolved::normalized;

/// How many points a pool has for each point of a map: in all directions, and for a map towards some
/// of them.
const TIMES: [usize; 2] = [3, 12];
/// One in so many points may always be chosen, so that no place is forgotten.
const ALWAYS: usize = 16;
/// How much wider than the given cone the points are, as a share of the angle.
const WIDER: f64 = 1.1;

pub(super) struct Pool {
    /// As it was asked for.
    size: usize,
    points: Points,
}

impl Pool {
    /// The kept pool, if it is of this size, or a new one.
    pub(super) fn of<'a>(
        kept: &'a mut Option<Self>,
        points: &Points,
        map: &MapOptions,
    ) -> Result<&'a Self, OutOfMemory> {
        let size = map
            .points
            .saturating_mul(TIMES[usize::from(map.towards.is_some())]);
        let new = match kept.take().filter(|pool| pool.size == size) {
            Some(pool) => pool,
            None => {
                let all = points.len();
                let points = points.gathered(&even_places(all, size.min(all))?)?;
                Self { size, points }
            }
        };
        Ok(kept.insert(new))
    }

    /// An even part of the points that may hide something.
    pub(super) fn choose(
        &self,
        viewpoint: [f64; 3],
        map: &MapOptions,
        last: Option<&VisibilityMap>,
    ) -> Result<Points, OutOfMemory> {
        let cone = Cone::of(map);
        let viewpoint = DVec3::from_array(viewpoint);
        let mut open: Vec<u32> = with_capacity(self.points.len())?;
        for (place, point) in self.points.iter().enumerate() {
            let is_seen = cone
                .as_ref()
                .is_none_or(|cone| cone.contains(DVec3::from_array(point) - viewpoint));
            let is_hidden = |last: &VisibilityMap| place % ALWAYS != 0 && last.hides(point);
            if is_seen && !last.is_some_and(is_hidden) {
                open.push(place as u32);
            }
        }
        let (count, budget) = (open.len() as u64, map.points as u64);
        if count > budget {
            let mut number = 0;
            open.retain(|_| {
                let [before, after] = [number, number + 1].map(|n| n * budget / count);
                number += 1;
                before != after
            });
        }
        self.points.gathered(&open)
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
