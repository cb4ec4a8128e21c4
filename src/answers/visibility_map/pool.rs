//! The points that a map looks through, and what is kept from map to map.

use alloc::vec::Vec;

use crate::answers::visibility_map::grid::{Cell, Cone, Grid};
use crate::answers::visibility_map::levels::{Champions, Levels};
use crate::answers::visibility_map::options::MapOptions;
use crate::base::allocation::{OutOfMemory, with_capacity};
use crate::base::real::square_root;
use crate::cloud::blocks::Blocks;
use crate::cloud::point_cloud::PointCloud;
use crate::cloud::points::Points;

/// A map looks through so many points and one in [`GROWS`] of the cloud, as far as the options let it, and through
/// [`IN_CONE`] times as many of which only a cone counts.
const LEAST: usize = 200_000;
const GROWS: usize = 10;
const IN_CONE: usize = 3;

/// An even sample of a cloud.
struct Pool {
    /// How far its points were moved to where they would be without noise, from 0 to 1.
    moved: f64,
    points: Points,
    blocks: Blocks,
}

/// What is kept from map to map.
#[derive(Default)]
pub(crate) struct MapMemory {
    pool: Option<Pool>,
    cells: Vec<Cell>,
    levels: Levels,
}

impl MapMemory {
    /// The champions of a cloud, room for their levels, and how many times as far from each other points are here as in
    /// the cloud. `None` where no point is seen.
    pub(super) fn champions<'a>(
        &'a mut self,
        cloud: &'a PointCloud,
        moved: f64,
        viewpoint: [f64; 3],
        map: &MapOptions,
    ) -> Result<Option<(Champions<'a>, &'a mut Levels, f64)>, OutOfMemory> {
        let Self {
            pool,
            cells,
            levels,
        } = self;
        let all = &cloud.sequence.points;
        let times = if map.towards.is_some() { IN_CONE } else { 1 };
        let size = map
            .points
            .min(LEAST + all.len() / GROWS)
            .saturating_mul(times);
        let is_same = |pool: &Pool| pool.points.len() == size && pool.moved == moved;
        let kept = pool.take().filter(is_same);
        let (points, blocks) = if size >= all.len() {
            (all, &cloud.blocks)
        } else {
            let kept = match kept {
                Some(kept) => kept,
                None => Pool::of(all, size, moved)?,
            };
            let pool = pool.insert(kept);
            (&pool.points, &pool.blocks)
        };
        let cone = Cone::of(map);
        let Some(grid) = Grid::of(points, viewpoint, &cone)? else {
            return Ok(None);
        };
        grid.choose(points, &blocks.levels[0], viewpoint, &cone, cells)?;
        let apart = square_root(all.len() as f64 / points.len() as f64);
        let champions = Champions {
            grid,
            cells,
            is_cone: cone.is_cone(),
        };
        Ok(Some((champions, levels, apart)))
    }
}

impl Pool {
    fn of(points: &Points, size: usize, moved: f64) -> Result<Self, OutOfMemory> {
        let all = points.len() as u64;
        let mut places = with_capacity(size)?;
        places.extend((0..size as u64).map(|k| (k * all / size as u64) as u32));
        let points = points.gathered(&places)?;
        Ok(Self {
            moved,
            blocks: Blocks::around(&points)?,
            points,
        })
    }
}
