//! The points that a map is made of: of an even sample of the cloud, which is taken once, the nearest one
//! in each cell of a grid of directions.
//!
//! Points behind others hide nothing. And a hull is as good everywhere as its faces are small, seen from the viewpoint: so
//! points that are even in direction hide more than as many that are even on the surface.

use alloc::vec::Vec;
use glam::DVec3;

use crate::answers::visibility_map::options::MapOptions;
use crate::base::allocation::{OutOfMemory, filled, push, with_capacity};
use crate::base::real::{larger, sine_cosine, smaller, square_root};
use crate::cloud::points::Points;
use crate::hull::{Memory, Side, Window, grid, place};
use crate::view::resolved::normalized;

/// The most points of a pool for each point of a map.
const TIMES: usize = 6;
/// Where the radius tells how many are needed, a pool has one in so many points of the cloud, and 1 to 3.5 for each point
/// of a map: to look through more would cost more than the hull.
const PART: usize = 5;
/// One in so many points of the pool shows where the cloud is seen.
const STEP: usize = 16;
/// At most so many cells for each that points are in, so that a grid takes little memory.
const MOST_EMPTY: f64 = 8.0;
/// A map has at least so many points, if the pool has as many.
pub(super) const FEW: usize = 10_000;
/// How many points there are for each that [`Need::ForRadius`] derives.
const FOR_RADIUS: f64 = 1.3;
/// How much wider than the given cone the points are, as a share of the angle.
const WIDER: f64 = 1.1;

/// How many points a map takes.
pub(super) enum Need {
    /// One in so many of the points that are probably visible in the whole cloud.
    OneIn(f64),
    /// As many as a spherical flip of this radius R needs: between points that are an angle δ apart, the hull sags by
    /// about R·δ², and it hides what lies deeper behind them. So A·R/D points hide a depth D in a solid angle A.
    ForRadius(f64),
}

/// What is kept from map to map: the pool of a cloud, and the room of the last map's hull.
#[derive(Default)]
pub(crate) struct MapMemory {
    pub(super) hull: Memory,
    pub(super) pool: Option<Pool>,
}

pub(super) struct Pool {
    /// Whether its points were moved to where they would be without noise.
    is_smooth: bool,
    /// How many points the cloud has.
    all: usize,
    points: Points,
}

impl Pool {
    /// The kept pool, if it is of this size, or a new one.
    pub(super) fn of<'a>(
        kept: &'a mut Option<Self>,
        points: &Points,
        is_smooth: bool,
        map: &MapOptions,
        need: &Need,
    ) -> Result<&'a mut Self, OutOfMemory> {
        let times = |times| map.points.saturating_mul(times);
        let size = match need {
            Need::OneIn(_) => times(TIMES),
            Need::ForRadius(_) => (points.len() / PART).min(times(7) / 2).max(times(1)),
        };
        let size = size.min(points.len());
        let is_same = |pool: &Self| pool.points.len() == size && pool.is_smooth == is_smooth;
        let pool = match kept.take().filter(is_same) {
            Some(pool) => pool,
            None => Self {
                is_smooth,
                all: points.len(),
                points: points.gathered(&even_places(points.len(), size)?)?,
            },
        };
        Ok(kept.insert(pool))
    }

    /// The points that hide the most, and how many visible points of the cloud stand for each of them.
    pub(super) fn choose(
        &self,
        viewpoint: [f64; 3],
        map: &MapOptions,
        need: Need,
    ) -> Result<(Points, f64), OutOfMemory> {
        let eye = Eye {
            viewpoint: DVec3::from_array(viewpoint),
            cone: Cone::of(map),
        };
        let stands_for = self.all as f64 / self.points.len().max(1) as f64;
        let mut is_chosen = filled(self.points.len(), false)?;
        let mut visible = 0.0;
        let few = FEW.min(map.points);
        if self.points.len() > few {
            let every = self.points.iter().step_by(STEP);
            let sample = Sample::of(every.filter_map(|point| eye.sees(point)))?;
            visible = sample.near as f64 * STEP as f64 * stands_for;
            let count = match need {
                Need::OneIn(one_in) => visible / one_in,
                Need::ForRadius(_) if sample.depth == 0.0 => 0.0,
                Need::ForRadius(radius) => FOR_RADIUS * sample.area * radius / sample.depth,
            };
            // No more cells than there are points to be in them.
            let most = map.points.min(self.points.len());
            let count = smaller(larger(count, few as f64), most as f64);
            let grid = Grid::new(&sample.sides, count * sample.empty);
            let nearest = self.nearest(&eye, &grid)?;
            for nearest in nearest.into_iter().filter(|&nearest| nearest < u64::MAX) {
                is_chosen[nearest as u32 as usize] = true;
            }
        } else {
            for (is_chosen, point) in is_chosen.iter_mut().zip(self.points.iter()) {
                *is_chosen = eye.sees(point).is_some();
            }
        }
        // In the order of the pool, which is one along a curve.
        let count = is_chosen.iter().filter(|&&is_chosen| is_chosen).count();
        let mut chosen = with_capacity(count)?;
        let numbered = (0..).zip(&is_chosen);
        chosen.extend(numbered.filter_map(|(number, &is)| is.then_some(number)));
        let stands_for = larger(visible / count.max(1) as f64, stands_for);
        Ok((self.points.gathered(&chosen)?, stands_for))
    }

    /// For each cell the square of the distance of its nearest point, and this point's number below it: so the least is
    /// found without a branch. A small function of its own is faster in WebAssembly.
    #[inline(never)]
    fn nearest(&self, eye: &Eye, grid: &Grid) -> Result<Vec<u64>, OutOfMemory> {
        let mut nearest = filled(grid.cells, u64::MAX)?;
        for (number, point) in (0..).zip(self.points.iter()) {
            if let Some((side, at, squared)) = eye.sees(point) {
                let nearest = &mut nearest[grid.cell(side, at)];
                *nearest = (*nearest).min(u64::from(squared.to_bits()) << 32 | number);
            }
        }
        Ok(nearest)
    }
}

/// Where points are seen from.
struct Eye {
    viewpoint: DVec3,
    cone: Option<Cone>,
}

impl Eye {
    /// The side of the cube, the place there, and the square of the distance.
    #[inline(always)]
    fn sees(&self, point: [f64; 3]) -> Option<(usize, [f64; 2], f32)> {
        let v = DVec3::from_array(point) - self.viewpoint;
        let is_asked = self.cone.as_ref().is_none_or(|cone| cone.contains(v));
        let (side, x, y, _) = place(v);
        // Rounded alike, so that the order is the same everywhere.
        let squared = v.dot(v) as f32;
        (is_asked && squared > 0.0 && squared < f32::INFINITY).then_some((side, [x, y], squared))
    }
}

/// What a few places of points show: the side of the cube, the place there, and the square of the distance.
struct Sample {
    sides: [Side; 6],
    /// How many of them are about as near as the nearest one beside them.
    near: usize,
    /// How far the others lie behind it, in the mean.
    depth: f64,
    /// The area on the sides of the cube, which is about the solid angle.
    area: f64,
    /// How many cells there are for each that points are in.
    empty: f64,
}

impl Sample {
    fn of(places: impl Iterator<Item = (usize, [f64; 2], f32)>) -> Result<Self, OutOfMemory> {
        let mut all = Vec::new();
        let mut sides = [Side::NONE; 6];
        for (side, at, squared) in places {
            push(&mut all, (side, at, squared))?;
            sides[side].include(at);
        }
        let grid = Grid::new(&sides, all.len() as f64 / 4.0);
        let mut nearest = filled(grid.cells, f32::INFINITY)?;
        for (side, at, squared) in &mut all {
            // From here on, its cell.
            *side = grid.cell(*side, *at);
            let nearest = &mut nearest[*side];
            if *squared < *nearest {
                *nearest = *squared;
            }
        }
        let same = (1.0 + 4.0 / grid.cells_per_unit) as f32;
        let (mut near, mut depth) = (0, 0.0);
        for &(cell, _, squared) in &all {
            let nearest = nearest[cell];
            if squared < nearest * same {
                near += 1;
            } else {
                depth += square_root(squared.into()) - square_root(nearest.into());
            }
        }
        let used = nearest.iter().filter(|&&x| x < f32::INFINITY).count();
        Ok(Self {
            sides,
            near,
            depth: depth / (all.len() - near).max(1) as f64,
            area: used as f64 / (grid.cells_per_unit * grid.cells_per_unit),
            empty: smaller(grid.cells as f64 / used.max(1) as f64, MOST_EMPTY),
        })
    }
}

/// Square cells on the sides of a cube around the viewpoint: one for each corner of its windows, and the last one for the
/// other sides.
struct Grid {
    windows: [Window; 6],
    cells_per_unit: f64,
    cells: usize,
}

impl Grid {
    /// At most about `count` cells.
    fn new(sides: &[Side; 6], count: f64) -> Self {
        let (windows, cells_per_unit) = grid(sides, count as usize).unwrap_or_default();
        Self {
            windows,
            cells_per_unit,
            cells: windows.iter().map(Window::corners).sum::<usize>() + 1,
        }
    }

    /// Directions beyond a window belong to its outermost cells.
    #[inline]
    fn cell(&self, side: usize, [x, y]: [f64; 2]) -> usize {
        let window = &self.windows[side];
        if window.columns == 0 {
            return self.cells - 1;
        }
        let column = ((x - window.x) * self.cells_per_unit) as u32 as usize;
        let row = ((y - window.y) * self.cells_per_unit) as u32 as usize;
        let across = window.columns + 1;
        window.first + row.min(window.rows) * across + column.min(window.columns)
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
            cosine: sine_cosine(half).1,
        })
    }

    pub(super) fn contains(&self, v: DVec3) -> bool {
        v.dot(self.axis) >= self.cosine * square_root(v.dot(v))
    }
}

/// The first `count` places below `all` in bit-reversed order. They are returned ascending.
/// Every beginning of the bit-reversed order is spread evenly.
fn even_places(all: usize, count: usize) -> Result<Vec<u32>, OutOfMemory> {
    let unused = (all as u32).saturating_sub(1).leading_zeros();
    let mut is_chosen: Vec<bool> = filled(all, false)?;
    let order = (0..u32::MAX).map(|number| number.reverse_bits().checked_shr(unused).unwrap_or(0));
    for place in order.filter(|&place| (place as usize) < all).take(count) {
        is_chosen[place as usize] = true;
    }
    let mut places = with_capacity(count)?;
    places.extend((0..all as u32).filter(|&place| is_chosen[place as usize]));
    Ok(places)
}

#[cfg(test)]
mod tests {
    use super::even_places;

    #[test]
    fn samples_are_even() {
        let places = even_places(100_000, 3000).unwrap();
        let gaps = places.windows(2).map(|pair| pair[1] - pair[0]);
        let (least, most) = (gaps.clone().min().unwrap(), gaps.max().unwrap());
        // The steps are 2^17 ÷ 2^12 and twice that.
        assert_eq!((least, most), (32, 64));
    }
}
