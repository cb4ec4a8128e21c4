//! A map of directions that says from which distance on every point is hidden.
//!
//! Directions are told by the faces of a cube around the viewpoint: on each, x and
//! y are quotients of coordinates, and a window that holds the cloud's directions is
//! cut into cells. Where K reaches at least r along the four corners of a cell, it
//! holds everything shorter than r·√(1 − ⅜D²) in the cell's directions, D being the
//! largest distance between corners taken as unit vectors: a convex combination
//! Σλᵢuᵢ of four such vectors has the squared length 1 − ½ΣΣλᵢλⱼ|uᵢ − uⱼ|², and
//! ½ΣΣλᵢλⱼ is at most ⅜. A point that flips to less is hidden, now and for
//! every larger K, and need not be flipped to know it.

use alloc::vec::Vec;
use glam::DVec3;

use super::flipped::Flipped;
use super::incremental::Hull;
use super::topology::FaceId;
use crate::base::allocation::{OutOfMemory, reserve};
use crate::base::real::square_root;

/// Fewer points are located faster than a map is made.
const MIN_POINTS: usize = 2048;
/// Corners for each point of the cloud, at most.
const CORNERS_PER_POINT: f64 = 1.0 / 16.0;
/// How much of the cloud's depth the curvature of a cell may take.
const MAX_LOSS: f64 = 0.25;
/// Every so manieth point tells where the cloud is seen.
const SAMPLE: usize = 64;
/// Directions nearer than this to a cell's border, in cells, are not looked up:
/// far more than rounding can move them.
const MARGIN: f64 = 1e-6;

/// The cells of one face of the cube.
#[derive(Default)]
struct Window {
    x: f64,
    y: f64,
    /// Cells along x; none in an unused window.
    columns: usize,
    rows: usize,
    /// Index of the first cell.
    first: usize,
}

/// See the module's description. Kept for its memory from view to view.
#[derive(Default)]
pub(super) struct DepthMap {
    viewpoint: DVec3,
    windows: [Window; 6],
    cells_per_unit: f64,
    /// Squared distance from which on everything is hidden, for each cell.
    hidden_from: Vec<f64>,
    corners: Vec<f64>,
}

impl DepthMap {
    /// Makes the map of `hull`, or an empty one where none would pay, for those points
    /// that it is `wanted` for, which are about `count`.
    pub(super) fn make(
        &mut self,
        hull: &Hull,
        flipped: &Flipped,
        count: usize,
        wanted: &dyn Fn(u32) -> bool,
    ) -> Result<(), OutOfMemory> {
        self.hidden_from.clear();
        self.windows = Default::default();
        self.viewpoint = flipped.viewpoint();
        if count < MIN_POINTS || !flipped.keeps_depth() {
            return Ok(());
        }
        let Some(mut face) = hull.outer_face() else {
            return Ok(());
        };
        let extents = survey(flipped, wanted);
        let Some(cell) = cell_size(&extents, flipped, count) else {
            return Ok(());
        };
        self.cells_per_unit = 1.0 / cell;
        for (side, extent) in extents.sides.iter().enumerate() {
            let [[x, y], [right, top]] = *extent;
            if x > right {
                continue;
            }
            let (columns, rows) = (
                ((right - x) / cell) as usize + 1,
                ((top - y) / cell) as usize + 1,
            );
            self.windows[side] = Window {
                x,
                y,
                columns,
                rows,
                first: self.hidden_from.len(),
            };
            face = self.fill_window(side, hull, face, flipped)?;
        }
        Ok(())
    }

    /// Whether a point at `p` is certainly hidden.
    #[inline]
    pub(super) fn hides(&self, p: [f64; 3]) -> bool {
        let v = DVec3::from_array(p) - self.viewpoint;
        let (side, x, y) = place(v);
        let window = &self.windows[side];
        let x = (x - window.x) * self.cells_per_unit;
        let y = (y - window.y) * self.cells_per_unit;
        // Out of range becomes 0 or large, NaN becomes 0; both fail below.
        let (column, row) = (x as u32, y as u32);
        let (dx, dy) = (x - f64::from(column), y - f64::from(row));
        const INNER: core::ops::Range<f64> = MARGIN..1.0 - MARGIN;
        let known = (column as usize) < window.columns
            && (row as usize) < window.rows
            && INNER.contains(&dx)
            && INNER.contains(&dy);
        // Only where it is known is the product in range.
        known
            && v.dot(v)
                >= self.hidden_from[window.first + row as usize * window.columns + column as usize]
    }

    /// The thresholds of one side's cells.
    fn fill_window(
        &mut self,
        side: usize,
        hull: &Hull,
        mut face: FaceId,
        flipped: &Flipped,
    ) -> Result<FaceId, OutOfMemory> {
        let Window {
            x: left,
            y: bottom,
            columns,
            rows,
            ..
        } = self.windows[side];
        let cell = 1.0 / self.cells_per_unit;
        self.corners.clear();
        reserve(&mut self.corners, (columns + 1) * (rows + 1))?;
        reserve(&mut self.hidden_from, columns * rows)?;
        let mut row_start = face;
        for row in 0..=rows {
            face = row_start;
            for column in 0..=columns {
                let x = left + column as f64 * cell;
                let y = bottom + row as f64 * cell;
                let corner = direction(side, x, y);
                let reach;
                (face, reach) = hull.reach_along(corner, face);
                if column == 0 {
                    row_start = face;
                }
                self.corners.push(reach);
            }
        }
        let shrink = shrink(cell);
        for row in 0..rows {
            for column in 0..columns {
                let at = |row: usize, column: usize| self.corners[row * (columns + 1) + column];
                let reach = at(row, column)
                    .min(at(row, column + 1))
                    .min(at(row + 1, column))
                    .min(at(row + 1, column + 1));
                self.hidden_from.push(flipped.hidden_from(reach * shrink));
            }
        }
        Ok(face)
    }
}

/// The side of the cube that `v` points to, and where.
#[inline]
fn place(v: DVec3) -> (usize, f64, f64) {
    let a = v.abs();
    if a.z >= a.x && a.z >= a.y {
        let inverse = 1.0 / a.z;
        (usize::from(v.z < 0.0), v.x * inverse, v.y * inverse)
    } else if a.x >= a.y {
        let inverse = 1.0 / a.x;
        (2 + usize::from(v.x < 0.0), v.y * inverse, v.z * inverse)
    } else {
        let inverse = 1.0 / a.y;
        (4 + usize::from(v.y < 0.0), v.z * inverse, v.x * inverse)
    }
}

/// The unit vector that points to (x, y) on a side of the cube.
fn direction(side: usize, x: f64, y: f64) -> DVec3 {
    let z = if side % 2 == 0 { 1.0 } else { -1.0 };
    let v = match side / 2 {
        0 => DVec3::new(x, y, z),
        1 => DVec3::new(z, x, y),
        _ => DVec3::new(y, z, x),
    };
    v / square_root(v.dot(v))
}

/// Where a sample of the points is seen.
struct Extents {
    /// Directions on each side of the cube: [[left, bottom], [right, top]].
    sides: [[[f64; 2]; 2]; 6],
    /// Squared distances.
    nearest: f64,
    farthest: f64,
}

fn survey(flipped: &Flipped, wanted: &dyn Fn(u32) -> bool) -> Extents {
    let mut extents = Extents {
        sides: [[[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]]; 6],
        nearest: f64::INFINITY,
        farthest: 0.0,
    };
    let sample = (0..flipped.len() as u32).step_by(SAMPLE);
    for index in sample.filter(|&index| wanted(index)) {
        let v = DVec3::from_array(flipped.position(index)) - flipped.viewpoint();
        let (side, x, y) = place(v);
        let [[left, bottom], [right, top]] = &mut extents.sides[side];
        *left = left.min(x);
        *bottom = bottom.min(y);
        *right = right.max(x);
        *top = top.max(y);
        extents.nearest = extents.nearest.min(v.dot(v));
        extents.farthest = extents.farthest.max(v.dot(v));
    }
    extents
}

/// The edge of square cells as many as `count` points pay for; `None`
/// where they would be so large that the map told little.
fn cell_size(extents: &Extents, flipped: &Flipped, count: usize) -> Option<f64> {
    let sides = extents.sides.iter();
    let area: f64 = sides
        .filter(|[[left, _], [right, _]]| left <= right)
        .map(|[[left, bottom], [right, top]]| (right - left) * (top - bottom))
        .sum();
    let cell = square_root(area / (count as f64 * CORNERS_PER_POINT));
    let [near, far] = [extents.nearest, extents.farthest].map(square_root);
    let depth = flipped.depth_between(near, far);
    // What the curvature of the flipped cloud takes: |q|·(1 − shrink), |q| at its largest.
    let loss = flipped.largest_reach() * (1.0 - shrink(cell));
    ((1e-5..1.0).contains(&cell) && loss < MAX_LOSS * depth).then_some(cell)
}

/// How much shorter K may be in a cell's directions than along its corners. On the
/// cube's side their distances are at most `cell`·√2, and less as unit vectors.
fn shrink(cell: f64) -> f64 {
    square_root((1.0 - 0.375 * 2.0 * cell * cell).max(0.0)) * (1.0 - 1e-12)
}
