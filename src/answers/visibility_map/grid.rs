//! The grid of directions of a map, and its champions: the nearest point in each cell, of a pool of points.
//!
//! A pool is an even sample of the cloud, which is taken once. There are about as many cells as points that are seen.

use alloc::vec::Vec;
use glam::DVec3;

use crate::answers::visibility_map::gauge::NONE;
use crate::answers::visibility_map::options::MapOptions;
use crate::base::allocation::{OutOfMemory, filled, push};
use crate::base::real::{larger, sine_cosine, smaller, square_root};
use crate::cloud::blocks::{BLOCK, Sphere};
use crate::cloud::points::Points;
use crate::hull::{Window, place};
use crate::view::resolved::normalized;

/// One in so many points of a pool shows where the cloud is seen, unless the pool has only a few points.
const STEP: usize = 32;
const FEW: usize = 4096;
/// How many points there are for each cell, of those that are about as near as the nearest one beside them.
const NEAR_PER_CELL: f64 = 2.5;
/// A cone has room for smaller ones.
const NEAR_IN_CONE: f64 = 1.2;
/// At most so many cells for each that points are in, so that a grid takes little memory.
const MOST_EMPTY: f64 = 8.0;
const LEAST_CELLS: f64 = 64.0;
const MOST_CELLS: f64 = 393_216.0;
/// How much wider than the given cone the cells are, as a share of the angle.
const WIDER: f64 = 1.1;
/// The largest number of cells along a side of length 1. Then single precision still finds the cell of a direction,
/// except near its border.
const MOST_ALONG: f64 = 4096.0;
/// With them, a map fits into 2,048 rows of 256 numbers.
const MOST_CORNERS: usize = 2048 * 256 - 48;
/// From here on, the window of a side of the cube goes on beyond the edge, so that bounds reach to it.
const NEAR_EDGE: f64 = 0.95;
const APRON: f64 = 0.06;
/// How often cells are joined, two by two.
pub(super) const LEVELS: usize = 5;

/// Square cells on the sides of a cube around the viewpoint. A cell has the number of its first corner.
#[derive(Clone, Copy, Default)]
pub(super) struct Grid {
    pub windows: [Window; 6],
    /// Exact in single precision, as the places of the windows are.
    pub cells_per_unit: f64,
}

impl Grid {
    /// A grid for the directions in which these points are seen; `None` if none are.
    #[inline(never)]
    pub(super) fn of(
        points: &Points,
        viewpoint: [f64; 3],
        cone: &Cone,
    ) -> Result<Option<Self>, OutOfMemory> {
        let viewpoint = DVec3::from_array(viewpoint);
        let step = if points.len() < FEW { 1 } else { STEP };
        let mut seen = Vec::new();
        let mut sides = [Side::NONE; 6];
        for point in points.iter().step_by(step) {
            let v = DVec3::from_array(point) - viewpoint;
            let (side, x, y, _) = place(v);
            // This is NaN at the viewpoint.
            if x.abs() <= 1.0 && y.abs() <= 1.0 && cone.contains(v) {
                push(&mut seen, (side, [x, y], square_root(v.dot(v)) as f32))?;
                sides[side].include([x, y]);
            }
        }
        let Some(coarse) = Self::with(&sides, seen.len() as f64 / 4.0) else {
            return Ok(None);
        };
        let mut nearest = filled(coarse.corners(), f32::INFINITY)?;
        for &(side, place, distance) in &seen {
            let nearest = &mut nearest[coarse.cell(side, place)];
            *nearest = nearest.min(distance);
        }
        let used = nearest.iter().filter(|&&nearest| nearest < f32::INFINITY);
        let empty = nearest.len() as f64 / used.count().max(1) as f64;
        let same = (1.0 + 4.0 / coarse.cells_per_unit) as f32;
        let is_near = |&&(side, place, distance): &&(usize, [f64; 2], f32)| {
            distance < nearest[coarse.cell(side, place)] * same
        };
        let near = (seen.iter().filter(is_near).count() * step) as f64;
        let per_cell = if cone.is_cone() {
            NEAR_IN_CONE
        } else {
            NEAR_PER_CELL
        };
        let cells = near / per_cell * smaller(empty, MOST_EMPTY);
        Ok(Self::with(
            &sides,
            smaller(larger(cells, LEAST_CELLS), MOST_CELLS),
        ))
    }

    /// About `count` cells.
    fn with(sides: &[Side; 6], count: f64) -> Option<Self> {
        let area: f64 = sides.iter().map(Side::area).sum();
        let mut cells_per_unit = square_root(count / larger(area, 1e-9));
        loop {
            cells_per_unit = f64::from(smaller(cells_per_unit, MOST_ALONG) as f32);
            let mut windows = [Window::default(); 6];
            let mut first = 0;
            for (window, side) in windows.iter_mut().zip(sides) {
                if side.low[0] > side.high[0] {
                    continue;
                }
                // A little less than the extent, so that no point is on the first border.
                let start = |x: f64| f64::from((x - 0.37 / cells_per_unit) as f32);
                let (x, y) = (start(side.low[0]), start(side.low[1]));
                // They are joined two by two.
                let cells =
                    |x: f64| ((x * cells_per_unit) as usize + 1).next_multiple_of(1 << LEVELS);
                *window = Window {
                    x,
                    y,
                    columns: cells(side.high[0] - x),
                    rows: cells(side.high[1] - y),
                    first,
                };
                first += window.corners();
            }
            if first == 0 {
                return None;
            }
            if first <= MOST_CORNERS {
                return Some(Self {
                    windows,
                    cells_per_unit,
                });
            }
            cells_per_unit *= 0.98;
        }
    }

    /// The sides of the cube that have cells, and their windows.
    pub(super) fn used(&self) -> impl Iterator<Item = (usize, &Window)> {
        let windows = self.windows.iter().enumerate();
        windows.filter(|(_, window)| window.columns > 0)
    }

    pub(super) fn corners(&self) -> usize {
        self.windows.iter().map(Window::corners).sum()
    }

    /// The cell of a place that its window contains.
    fn cell(&self, side: usize, [x, y]: [f64; 2]) -> usize {
        let window = &self.windows[side];
        let column = ((x - window.x) * self.cells_per_unit) as usize;
        let row = ((y - window.y) * self.cells_per_unit) as usize;
        window.first + row * (window.columns + 1) + column
    }

    /// The first cell of a side's window among those of all sides. Rows are padded.
    pub(super) fn start(&self, side: usize) -> usize {
        let cells = |window: &Window| window.rows * padded(window.columns);
        self.windows[..side].iter().map(cells).sum()
    }

    /// The champions of the cells. Directions are in single precision: any point may be a champion.
    #[inline(never)]
    pub(super) fn choose(
        &self,
        points: &Points,
        blocks: &[Sphere],
        viewpoint: [f64; 3],
        cone: &Cone,
        cells: &mut Vec<Cell>,
    ) -> Result<(), OutOfMemory> {
        refill(cells, self.start(6), EMPTY)?;
        for (number, sphere) in blocks.iter().enumerate() {
            if cone.meets(sphere, viewpoint) {
                for (side, _) in self.used() {
                    if may_be_on(side, sphere, viewpoint) {
                        self.choose_on(side, points, number, viewpoint, cells);
                    }
                }
            }
        }
        Ok(())
    }

    fn choose_on(
        &self,
        side: usize,
        points: &Points,
        block: usize,
        viewpoint: [f64; 3],
        cells: &mut [Cell],
    ) {
        let run = block * BLOCK..points.len().min((block + 1) * BLOCK);
        match points {
            Points::Single(points) => {
                self.choose_of(side, &points[run], f64::from, viewpoint, cells);
            }
            Points::Double(points) => {
                self.choose_of(side, &points[run], |x| x, viewpoint, cells);
            }
        }
    }

    #[inline(never)]
    fn choose_of<T: Copy>(
        &self,
        side: usize,
        points: &[[T; 3]],
        double: impl Fn(T) -> f64,
        viewpoint: [f64; 3],
        champions: &mut [Cell],
    ) {
        let window = &self.windows[side];
        let cells = self.cells_per_unit as f32;
        let bits = self.bits();
        // Where this is added, the low bits are a whole number of parts of a cell.
        let whole = 12_582_912.0 / (1u32 << bits) as f32;
        let start = |x: f64| (f64::from(whole) - x * self.cells_per_unit) as f32;
        let (left, low) = (start(window.x), start(window.y));
        let parts = |x: f32| x.to_bits().wrapping_sub(whole.to_bits());
        let [columns, rows] = [window.columns, window.rows].map(|count| count as u32);
        let champions = &mut champions[self.start(side)..];
        let stride = padded(window.columns) as u32;
        let mask = (1 << bits) - 1;
        let [across, up, ahead] = axes(side);
        let sign = if side % 2 == 0 { 1.0 } else { -1.0 };
        for point in points {
            let relative = |axis: usize| (double(point[axis]) - viewpoint[axis]) as f32;
            let z = relative(ahead) * sign;
            let inverse = cells / z;
            let x = parts(relative(across) * inverse + left);
            let y = parts(relative(up) * inverse + low);
            let (column, row) = (x >> bits, y >> bits);
            if (column < columns) & (row < rows) {
                let champion = &mut champions[(row * stride + column) as usize];
                // Behind the viewpoint, z has the sign bit, and is larger than any.
                let key = u64::from(z.to_bits()) << 32 | u64::from((x & mask) << 16 | y & mask);
                *champion = key.min(*champion);
            }
        }
    }

    /// The place in a cell has so many bits.
    pub(super) fn bits(&self) -> u32 {
        let sizes = self
            .windows
            .iter()
            .map(|window| window.columns.max(window.rows));
        (sizes.max().unwrap_or(0) as u32).leading_zeros().min(25) - 10
    }
}

/// A champion: z in single precision, and its place in the cell, x and y in 16 bits each. The least one is the nearest.
pub(super) type Cell = u64;
/// A cell without a champion.
pub(super) const EMPTY: Cell = (NONE.to_bits() as u64) << 32;

/// The axes along and up a side of the cube, and ahead of it.
fn axes(side: usize) -> [usize; 3] {
    let ahead = [2, 0, 1][side / 2];
    [(ahead + 1) % 3, (ahead + 2) % 3, ahead]
}

/// False only where a sphere has no point in a window of this side, except for rounding.
fn may_be_on(side: usize, sphere: &Sphere, viewpoint: [f64; 3]) -> bool {
    let [x, y, z] = axes(side).map(|axis| sphere.center[axis] - viewpoint[axis]);
    let z = if side % 2 == 0 { z } else { -z };
    let most = z * (1.0 + APRON) + 1.5 * sphere.radius;
    z > -sphere.radius && x.abs() <= most && y.abs() <= most
}

/// How many numbers a row takes: four are read and written at once, also beside the last corner.
pub(super) fn padded(columns: usize) -> usize {
    (columns + 4).next_multiple_of(4)
}

/// Makes a vector hold `value` `count` times.
pub(super) fn refill<T: Copy>(
    items: &mut Vec<T>,
    count: usize,
    value: T,
) -> Result<(), OutOfMemory> {
    items.clear();
    items.try_reserve(count)?;
    items.resize(count, value);
    Ok(())
}

/// The extent of some places on a side of the cube.
#[derive(Clone, Copy)]
struct Side {
    low: [f64; 2],
    high: [f64; 2],
}

impl Side {
    const NONE: Self = Self {
        low: [f64::INFINITY; 2],
        high: [f64::NEG_INFINITY; 2],
    };

    fn include(&mut self, place: [f64; 2]) {
        for axis in 0..2 {
            let x = place[axis];
            let beyond = match x {
                x if x > NEAR_EDGE => 1.0 + APRON,
                x if x < -NEAR_EDGE => -1.0 - APRON,
                x => x,
            };
            self.low[axis] = smaller(self.low[axis], smaller(x, beyond));
            self.high[axis] = larger(self.high[axis], larger(x, beyond));
        }
    }

    fn area(&self) -> f64 {
        if self.low[0] > self.high[0] {
            return 0.0;
        }
        (self.high[0] - self.low[0]) * (self.high[1] - self.low[1])
    }
}

/// The directions of a map.
pub(super) struct Cone {
    axis: DVec3,
    /// At most −1 for all directions.
    cosine: f64,
}

impl Cone {
    pub(super) fn of(map: &MapOptions) -> Self {
        let (direction, angle) = map.towards.unwrap_or_default();
        let half = (WIDER * 0.5 * angle).to_radians();
        let axis = normalized(direction).unwrap_or_default();
        let is_all = map.towards.is_none() || half >= core::f64::consts::PI;
        let cosine = if is_all { -4.0 } else { sine_cosine(half).1 };
        Self { axis, cosine }
    }

    pub(super) fn is_cone(&self) -> bool {
        self.cosine >= -1.0
    }

    fn contains(&self, v: DVec3) -> bool {
        v.dot(self.axis) >= self.cosine * square_root(v.dot(v))
    }

    /// False only where a sphere has no point in the cone, except for rounding.
    fn meets(&self, sphere: &Sphere, viewpoint: [f64; 3]) -> bool {
        let v = DVec3::from_array(sphere.center) - DVec3::from_array(viewpoint);
        v.dot(self.axis) + sphere.radius >= self.cosine * square_root(v.dot(v)) - sphere.radius
    }
}
