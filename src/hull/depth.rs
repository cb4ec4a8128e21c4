//! A map of directions that shows how far K reaches.
//!
//! A cube around the viewpoint holds the directions. On one of its faces a flipped point q is
//! z·(x, y, 1). A window that contains the cloud's directions (x, y) is cut into cells. K ends
//! at 1/w times (x, y, 1), where w is the largest m·(x, y, 1) of all outer faces. As a maximum
//! of linear functions w is convex. So inside a cell w is at most the interpolation of its
//! values at the four corners. A point with z·w < 1 is in K, and K goes on beyond it. So the
//! point is hidden, now and for every larger K.

#[cfg(test)]
mod tests;

use alloc::vec::Vec;
use glam::DVec3;

use crate::base::allocation::{OutOfMemory, reserve};
use crate::base::real::{larger, smaller, square_root};
use crate::cloud::blocks::{BLOCK, Sphere};
use crate::hull::flipped::Flipped;
use crate::hull::incremental::Hull;
use crate::hull::topology::FaceId;

/// A map is made only for this many points or more. Fewer points are located faster than a
/// map is made.
const MIN_POINTS: usize = 2048;
/// The least and the largest number of corners for each point of the cloud.
const CORNERS_PER_POINT: (f64, f64) = (1.0 / 32.0, 0.4);
/// The share of the cloud's depth that the map may lose. A limited number of corners may
/// make the loss larger.
const LOSS: f64 = 0.035;
/// The step of the sample of points that shows where the cloud is seen.
const SAMPLE: usize = 64;
/// The step where points are not wanted: they only decide the size of the cells.
const COARSE_SAMPLE: usize = 8 * SAMPLE;
/// Directions nearer than this to a cell's border, in cells, are not looked up. Rounding moves
/// a direction by far less.
const BORDER: f64 = 1e-6;
/// The smallest cell: in it, roundings stay within `BORDER`.
const LEAST_CELL: f64 = 1e-8;
const ROUNDING: f64 = f64::EPSILON / 2.0;
/// A bound of the error of a place (x, y) on the cube and of the error of a corner, together:
/// about twenty roundings of numbers up to 2.
const PLACE_ERROR: f64 = 64.0 * ROUNDING;
/// A bound of the relative error of q, z, the interpolation and z·w: about twenty roundings of
/// products and of sums of positive numbers.
const HEIGHT_ERROR: f64 = 64.0 * ROUNDING;

/// The cells of one face of the cube.
#[derive(Clone, Copy, Default)]
pub(crate) struct Window {
    /// The place of the first corner.
    pub x: f64,
    pub y: f64,
    /// Cells along x; none in an unused window.
    pub columns: usize,
    pub rows: usize,
    /// Index of the first corner.
    pub first: usize,
}

impl Window {
    pub(crate) fn corners(&self) -> usize {
        if self.columns == 0 {
            return 0;
        }
        (self.columns + 1) * (self.rows + 1)
    }
}

/// The map; the module's description explains it. Its memory is kept from view to view.
#[derive(Default)]
pub(super) struct DepthMap {
    windows: [Window; 6],
    cells_per_unit: f64,
    /// An upper bound of w at each corner; infinite where w is in doubt. While the map is made, it
    /// is 0 where it must be found.
    heights: Vec<f64>,
    /// How far K certainly reaches in the direction of each corner, and in the cells beside it.
    reaches: Vec<f64>,
    /// Where the rounded z·w is below this number, the exact one is below 1.
    limit: f64,
}

impl DepthMap {
    /// Empties the map: it hides no point any more.
    pub(super) fn clear(&mut self) {
        self.heights.clear();
        self.reaches.clear();
        self.windows = Default::default();
    }

    /// Makes the map of `hull` for the `wanted` points. There are about `count` of them. The map
    /// is empty where it would take more time than it saves.
    #[inline(never)]
    pub(super) fn make(
        &mut self,
        hull: &Hull,
        flipped: &Flipped,
        count: usize,
        wanted: &dyn Fn(u32) -> bool,
    ) -> Result<(), OutOfMemory> {
        self.clear();
        if count < MIN_POINTS || !flipped.keeps_depth() {
            return Ok(());
        }
        let Some(mut face) = hull.outer_face() else {
            return Ok(());
        };
        // All maps of a view have cells of one size, whatever part of the cloud they are for.
        let (extents, wanted_sides) = extents_of(flipped, wanted);
        let Some(cell) = cell_size(&extents, flipped.len()) else {
            return Ok(());
        };
        self.cells_per_unit = 1.0 / cell;
        self.limit = 1.0;
        let mut corners = 0;
        for (window, extent) in self.windows.iter_mut().zip(wanted_sides) {
            let [[x, y], [right, top]] = extent;
            if x <= right {
                *window = Window {
                    x,
                    y,
                    columns: ((right - x) / cell) as usize + 1,
                    rows: ((top - y) / cell) as usize + 1,
                    first: corners,
                };
                corners += window.corners();
            }
        }
        reserve(&mut self.heights, corners)?;
        reserve(&mut self.reaches, corners)?;
        self.heights.resize(corners, f64::INFINITY);
        self.reaches.resize(corners, 0.0);
        self.want_corners(flipped, wanted);
        for side in 0..self.windows.len() {
            if self.windows[side].columns > 0 {
                face = self.fill_window(side, hull, face);
            }
        }
        Ok(())
    }

    /// Writes 0 to each height that must be found: where wanted blocks are seen, or everywhere if
    /// no blocks are known.
    #[inline(never)]
    fn want_corners(&mut self, flipped: &Flipped, wanted: &dyn Fn(u32) -> bool) {
        if flipped.blocks.is_empty() {
            self.heights.fill(0.0);
        }
        for (block, sphere) in flipped.blocks.iter().enumerate() {
            if !wanted((block * BLOCK) as u32) {
                continue;
            }
            let Some((side, [left, bottom, right, top])) = self.cells_around(flipped, sphere)
            else {
                // The sphere contains the viewpoint.
                self.heights.fill(0.0);
                return;
            };
            let window = &self.windows[side];
            let last = |x: f64, cells: usize| (x + 1.0).min(cells as f64) as usize;
            let (right, top) = (last(right, window.columns), last(top, window.rows));
            for row in bottom as usize..=top {
                let row = window.first + row * (window.columns + 1);
                if let Some(run) = self.heights.get_mut(row + left as usize..=row + right) {
                    run.fill(0.0);
                }
            }
        }
    }

    /// The cells of all directions of a sphere's points, on the side of its center: left, bottom,
    /// right and top, in cells from the window's corner. `None` for a sphere that contains the
    /// viewpoint.
    fn cells_around(&self, flipped: &Flipped, sphere: &Sphere) -> Option<(usize, [f64; 4])> {
        let v = DVec3::from_array(sphere.center) - flipped.flip.viewpoint();
        let (side, x, y, z) = place(v);
        let window = &self.windows[side];
        let room = z - sphere.radius;
        let spread = |x: f64| {
            let far = sphere.radius * (1.0 + x.abs()) / room;
            far * self.cells_per_unit * (1.0 + BORDER) + BORDER
        };
        let (spread_x, spread_y) = (spread(x), spread(y));
        let x = (x - window.x) * self.cells_per_unit;
        let y = (y - window.y) * self.cells_per_unit;
        let cells = [x - spread_x, y - spread_y, x + spread_x, y + spread_y];
        (room > 0.0).then_some((side, cells))
    }

    /// Which of the `wanted` points of a block are not certainly hidden. The first point is number
    /// `start`, and there is a bit for each point. Bits beyond the end of the cloud are cleared.
    #[inline(never)]
    pub(super) fn not_hidden(&self, flipped: &Flipped, start: u32, wanted: u64) -> u64 {
        let start = start as usize;
        let len = BLOCK.min(flipped.len() - start);
        let mut left = wanted & (u64::MAX >> (BLOCK - len));
        if self.heights.is_empty() {
            return left;
        }
        let sphere = flipped.blocks.get(start / BLOCK);
        if sphere.is_some_and(|sphere| self.hides_all(flipped, sphere)) {
            return 0;
        }
        // Most points are on the side of the cube where the block's center is.
        let center = sphere.map_or(flipped.position(start as u32), |sphere| sphere.center);
        let (home, ..) = place(DVec3::from_array(center) - flipped.flip.viewpoint());
        let mut open = left;
        while open != 0 {
            let bit = open.trailing_zeros();
            open &= open - 1;
            let v = flipped.relative(start as u32 + bit);
            let is_hidden = match self.height_towards(home, v) {
                Some((z, height)) => self.reaches_beyond(flipped, v, z, height),
                None => self.hides_elsewhere(flipped, home, v),
            };
            left &= !(u64::from(is_hidden) << bit);
        }
        left
    }

    /// Whether a point at `v` from the viewpoint is certainly hidden, if its own side is not `home`.
    #[cold]
    #[inline(never)]
    fn hides_elsewhere(&self, flipped: &Flipped, home: usize, v: DVec3) -> bool {
        let (side, ..) = place(v);
        let found = self.height_towards(side, v);
        side != home && found.is_some_and(|(z, height)| self.reaches_beyond(flipped, v, z, height))
    }

    /// z of `v` on this side of the cube, and an upper bound of w in its direction. `None` where no
    /// bound is known.
    #[inline(always)]
    fn height_towards(&self, side: usize, v: DVec3) -> Option<(f64, f64)> {
        let (x, y, z) = turned(side, v);
        let inverse = 1.0 / z;
        let window = &self.windows[side];
        let x = (x * inverse - window.x) * self.cells_per_unit;
        let y = (y * inverse - window.y) * self.cells_per_unit;
        // A number out of range becomes 0 or large; NaN becomes 0. The checks below refuse both.
        let (column, row) = (x as u32, y as u32);
        let (x, y) = (x - f64::from(column), y - f64::from(row));
        const INNER: f64 = 0.5 - BORDER;
        let (column, row) = (column as usize, row as usize);
        let known = z > 0.0
            && column < window.columns
            && row < window.rows
            && (x - 0.5).abs() < INNER
            && (y - 0.5).abs() < INNER;
        if !known {
            return None;
        }
        // The product is in range only where the height is known.
        let corners = window.columns + 1;
        let low = window.first + row * corners + column;
        let [a, b] = self.pair(low)?;
        let [c, d] = self.pair(low + corners)?;
        let between = |a: f64, b: f64, t: f64| (1.0 - t) * a + t * b;
        Some((z, between(between(a, b, x), between(c, d, x), y)))
    }

    /// The heights at a corner and at the next one.
    #[inline(always)]
    fn pair(&self, corner: usize) -> Option<[f64; 2]> {
        let pair = self.heights.get(corner..)?.first_chunk::<2>()?;
        Some(*pair)
    }

    /// Whether K reaches beyond the flipped point of `v`. Except for roundings, this point is v
    /// times a positive number.
    #[inline(always)]
    fn reaches_beyond(&self, flipped: &Flipped, v: DVec3, z: f64, height: f64) -> bool {
        let (far, near) = flipped.flip.ratio(v);
        z * far * height < near * self.limit
    }

    /// Whether all points of a sphere are certainly hidden. The points in the directions of a cell
    /// are hidden if K reaches beyond the nearest point along all four corners, also after
    /// [`shrink`].
    fn hides_all(&self, flipped: &Flipped, sphere: &Sphere) -> bool {
        let Some((side, [left, bottom, right, top])) = self.cells_around(flipped, sphere) else {
            return false;
        };
        let window = &self.windows[side];
        let known = left >= 0.0
            && bottom >= 0.0
            && right < window.columns as f64
            && top < window.rows as f64;
        if !known {
            return false;
        }
        let v = DVec3::from_array(sphere.center) - flipped.flip.viewpoint();
        let needed = flipped
            .flip
            .most_beyond(square_root(v.dot(v)) * (1.0 - HEIGHT_ERROR) - sphere.radius);
        let corners = window.columns + 1;
        (bottom as usize..=top as usize + 1).all(|row| {
            let row = window.first + row * corners;
            let run = &self.reaches[row + left as usize..=row + right as usize + 1];
            run.iter().all(|&reach| reach > needed)
        })
    }

    /// Finds the wanted heights at the corners of one side.
    #[inline(never)]
    fn fill_window(&mut self, side: usize, hull: &Hull, mut face: FaceId) -> FaceId {
        let Window {
            x: left,
            y: bottom,
            columns,
            rows,
            first,
        } = self.windows[side];
        let cell = 1.0 / self.cells_per_unit;
        let shrink = shrink(cell);
        let mut row_start = face;
        // The largest relative change from a corner to the next.
        let mut steepest = 0.0;
        for row in 0..=rows {
            face = row_start;
            let mut is_start = true;
            for column in 0..=columns {
                let place = first + row * (columns + 1) + column;
                if self.heights[place] == f64::INFINITY {
                    continue;
                }
                let x = left + column as f64 * cell;
                let y = bottom + row as f64 * cell;
                let corner = direction(side, x, y);
                let (pierced, height) = hull.height_along(corner, face);
                face = pierced;
                if core::mem::take(&mut is_start) {
                    row_start = face;
                }
                let mut compare = |other: f64| {
                    let change = (height - other).abs();
                    // An infinite height says nothing about the change.
                    if change < f64::INFINITY {
                        steepest = larger(steepest, change / smaller(height, other));
                    }
                };
                if column > 0 {
                    compare(self.heights[place - 1]);
                }
                if row > 0 {
                    compare(self.heights[place - 1 - columns]);
                }
                self.heights[place] = height;
                self.reaches[place] = square_root(corner.dot(corner)) * shrink / height;
            }
        }
        // Within a cell heights change by two such steps, along two axes.
        let change = 2.0 * steepest * (2.0 + steepest);
        let error = HEIGHT_ERROR + PLACE_ERROR * self.cells_per_unit * change;
        self.limit = smaller(self.limit, 1.0 - error);
        face
    }
}

/// The side of the cube that `v` points to, the place (x, y) there, and z.
#[inline]
pub(crate) fn place(v: DVec3) -> (usize, f64, f64, f64) {
    let a = v.abs();
    if a.z >= a.x && a.z >= a.y {
        let inverse = 1.0 / a.z;
        (usize::from(v.z < 0.0), v.x * inverse, v.y * inverse, a.z)
    } else if a.x >= a.y {
        let inverse = 1.0 / a.x;
        (
            2 + usize::from(v.x < 0.0),
            v.y * inverse,
            v.z * inverse,
            a.x,
        )
    } else {
        let inverse = 1.0 / a.y;
        (
            4 + usize::from(v.y < 0.0),
            v.z * inverse,
            v.x * inverse,
            a.y,
        )
    }
}

/// x, y and z of `v` as a side of the cube counts them; z is negative behind the side.
#[inline(always)]
pub(crate) fn turned(side: usize, v: DVec3) -> (f64, f64, f64) {
    let (x, y, z) = match side / 2 {
        0 => (v.x, v.y, v.z),
        1 => (v.y, v.z, v.x),
        _ => (v.z, v.x, v.y),
    };
    (x, y, if side % 2 == 0 { z } else { -z })
}

/// (x, y) on a side of the cube.
fn direction(side: usize, x: f64, y: f64) -> DVec3 {
    let z = if side % 2 == 0 { 1.0 } else { -1.0 };
    match side / 2 {
        0 => DVec3::new(x, y, z),
        1 => DVec3::new(z, x, y),
        _ => DVec3::new(y, z, x),
    }
}

/// Directions on each side of the cube: [[left, bottom], [right, top]].
type Sides = [[[f64; 2]; 2]; 6];

/// Where a sample of the points is seen.
struct Extents {
    sides: Sides,
    /// Squares of |q|.
    shortest: f64,
    longest: f64,
}

/// The extents of all points, and the sides' extents of the wanted ones.
fn extents_of(flipped: &Flipped, wanted: &dyn Fn(u32) -> bool) -> (Extents, Sides) {
    let nowhere: Sides = [[[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]]; 6];
    let mut wanted_sides = nowhere;
    let mut extents = Extents {
        sides: nowhere,
        shortest: f64::INFINITY,
        longest: 0.0,
    };
    for index in (0..flipped.len() as u32).step_by(SAMPLE) {
        let is_wanted = wanted(index);
        if !is_wanted && index as usize % COARSE_SAMPLE != 0 {
            continue;
        }
        let Some(q) = flipped.get_out_of_line(index) else {
            continue;
        };
        let (side, x, y, _) = place(q);
        let include = |sides: &mut Sides| {
            let [[left, bottom], [right, top]] = &mut sides[side];
            *left = smaller(*left, x);
            *bottom = smaller(*bottom, y);
            *right = larger(*right, x);
            *top = larger(*top, y);
        };
        include(&mut extents.sides);
        if is_wanted {
            include(&mut wanted_sides);
        }
        extents.shortest = smaller(extents.shortest, q.dot(q));
        extents.longest = larger(extents.longest, q.dot(q));
    }
    (extents, wanted_sides)
}

/// The edge of the square cells for a cloud of `count` points, small enough to keep the loss of
/// the map small; `None` where no size is right.
fn cell_size(extents: &Extents, count: usize) -> Option<f64> {
    let sides = extents.sides.iter();
    let area: f64 = sides
        .filter(|[[left, _], [right, _]]| left <= right)
        .map(|[[left, bottom], [right, top]]| (right - left) * (top - bottom))
        .sum();
    let longest = square_root(extents.longest);
    let depth = longest - square_root(extents.shortest);
    // Between corners K bulges by up to a quarter of |q|·cell².
    let corners = 0.25 * longest * area / (LOSS * depth);
    let (few, many) = CORNERS_PER_POINT;
    let count = count as f64;
    let corners = smaller(larger(corners, few * count), many * count);
    let cell = square_root(area / corners);
    (LEAST_CELL..1.0).contains(&cell).then_some(cell)
}

/// A factor f: in all directions of a cell, K reaches at least f times as far as along the
/// corners. Let D be the largest distance between the corners as unit vectors; it is at most
/// `cell`·√2. A convex combination Σλᵢuᵢ of the four corners has the squared length
/// 1 − ½ΣΣλᵢλⱼ|uᵢ − uⱼ|², and ½ΣΣλᵢλⱼ is at most ⅜.
fn shrink(cell: f64) -> f64 {
    square_root(larger(1.0 - 0.75 * cell * cell, 0.0)) * (1.0 - HEIGHT_ERROR)
}
