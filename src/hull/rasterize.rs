//! The heights of the map of directions: each outer face gives w at the corners inside it.
//!
//! K contains a face and everything between the face and the viewpoint. So in the directions of the
//! face with the dual plane m, w is at most m·(x, y, 1). A direction is inside the face if it is on
//! the inner side of the three planes through the viewpoint and an edge. This is certain beyond
//! a bound of the roundings. A corner that is certainly in no face, as on an edge, keeps no bound.

use glam::DVec3;

use super::depth::{DepthMap, Spot, Window, direction, place};
use super::dual_plane::Plane;
use super::incremental::Hull;
use super::topology::Vertex;
use crate::base::allocation::{OutOfMemory, reserve};

/// From so many columns on, the columns of a face are searched in each row.
const FEW_COLUMNS: u32 = 4;
/// The faces may have so many rows for each corner of the map, and for each face. Only thin faces in
/// bad places have more.
const MOST_ROWS: usize = 4;
/// The lowest bit of the side.
const SIDE: u32 = 60;
/// The lowest bit of the column.
const COLUMN: u32 = 30;
/// The last column or row. Those beyond count as this one.
const LAST: u32 = (1 << COLUMN) - 1;
const ROWS: Spot = LAST as Spot;
const COLUMNS: Spot = ROWS << COLUMN;
/// A vertex that is seen in no window.
const UNSEEN: Spot = Spot::MAX;

/// One edge of a face.
struct Edge {
    /// Normal to the plane through the viewpoint and the edge, to the inside of the face.
    normal: DVec3,
    /// A square that is larger than the squared error of the normal's product with a direction.
    doubt: f64,
}

impl Edge {
    fn new(tail: DVec3, head: DVec3) -> Self {
        // Ten roundings of products of lengths, of a direction at most √3 long, and room to spare.
        const ERROR: f64 = 64.0 * f64::EPSILON;
        // Below this number squares may underflow.
        const LEAST: f64 = 1e-250;
        Self {
            normal: tail.cross(head),
            doubt: ERROR * ERROR * tail.length_squared() * head.length_squared() + LEAST,
        }
    }

    fn height(&self, direction: DVec3) -> f64 {
        self.normal.dot(direction)
    }

    #[inline]
    fn is_inside(&self, direction: DVec3) -> bool {
        let height = self.height(direction);
        (height > 0.0) & (height * height > self.doubt)
    }
}

impl Window {
    /// The column and the row of the cell of a vertex, counted from 1 inside the window.
    #[inline]
    fn cell(&self, x: f64, y: f64, cells_per_unit: f64) -> [u32; 2] {
        let column = ((x - self.x) * cells_per_unit + 1.0) as u32;
        let row = ((y - self.y) * cells_per_unit + 1.0) as u32;
        [column.min(LAST), row.min(LAST)]
    }
}

impl DepthMap {
    /// Finds the wanted heights.
    #[inline(never)]
    pub(super) fn rasterize(&mut self, hull: &Hull) -> Result<(), OutOfMemory> {
        let positions = &hull.vertices.positions;
        let mut spots = core::mem::take(&mut self.spots);
        spots.clear();
        reserve(&mut spots, positions.len())?;
        spots.extend(positions.iter().map(|&q| {
            let (side, x, y, z) = place(q);
            let window = &self.windows[side];
            if z > 0.0 && window.columns > 0 {
                let [column, row] = window.cell(x, y, self.cells_per_unit);
                (side as Spot) << SIDE | Spot::from(column) << COLUMN | Spot::from(row)
            } else {
                UNSEEN
            }
        }));
        let mut rows_left = MOST_ROWS * (self.heights.len() + hull.surface.slots());
        for (_, corners) in hull.compact.alive() {
            let [a, b, c] = corners.map(|vertex| spots[vertex as usize]);
            // A face has a corner of the map inside only if its vertices are in several columns and
            // in several rows.
            let differing = (a ^ b) | (a ^ c);
            if differing >> SIDE != 0 {
                self.fill_across_sides(hull, corners, &mut rows_left);
            } else if (differing & COLUMNS != 0) & (differing & ROWS != 0) {
                let cell = |spot| [((spot & COLUMNS) >> COLUMN) as u32, (spot & ROWS) as u32];
                let cells = [cell(a), cell(b), cell(c)];
                self.fill_face((a >> SIDE) as usize, hull, corners, cells, &mut rows_left);
            }
        }
        self.spots = spots;
        Ok(())
    }

    /// Fills a face whose corners are on different sides.
    #[inline(never)]
    fn fill_across_sides(&mut self, hull: &Hull, vertices: [Vertex; 3], rows_left: &mut usize) {
        let corners = vertices.map(|vertex| hull.vertices.at(vertex));
        for side in 0..self.windows.len() {
            let window = &self.windows[side];
            if window.columns == 0 {
                continue;
            }
            let forward = direction(side, 0.0, 0.0);
            let axes = [[1.0, 0.0], [0.0, 1.0]].map(|[x, y]| direction(side, x, y) - forward);
            let cells = corners.map(|q| {
                let z = q.dot(forward);
                let [x, y] = axes.map(|axis| q.dot(axis) / z);
                // The last comparison also refuses a corner at the viewpoint.
                (z > 0.0).then(|| window.cell(x, y, self.cells_per_unit))
            });
            if let [Some(a), Some(b), Some(c)] = cells {
                self.fill_face(side, hull, vertices, [a, b, c], rows_left);
            }
        }
    }

    /// Fills the corners of one side that are inside a face. The face's vertices are in these cells
    /// there.
    #[inline]
    fn fill_face(
        &mut self,
        side: usize,
        hull: &Hull,
        vertices: [Vertex; 3],
        [a, b, c]: [[u32; 2]; 3],
        rows_left: &mut usize,
    ) {
        // The first cell begins at the window's first corner.
        let range = |axis: usize| {
            let [a, b, c] = [a[axis], b[axis], c[axis]];
            [a.min(b).min(c), a.max(b).max(c)]
        };
        let [columns, rows] = [range(0), range(1)];
        if columns[0] < columns[1] && rows[0] < rows[1] {
            self.fill_corners(side, hull, vertices, [columns, rows], rows_left);
        }
    }

    /// Fills those corners that are inside a face. Its vertices are in cells of these columns and
    /// rows.
    #[inline(never)]
    fn fill_corners(
        &mut self,
        side: usize,
        hull: &Hull,
        vertices: [Vertex; 3],
        [[left, right], [bottom, top]]: [[u32; 2]; 2],
        rows_left: &mut usize,
    ) {
        const ROUNDING: f64 = 1e-15;
        let window = &self.windows[side];
        let cell = 1.0 / self.cells_per_unit;
        let right = right.min(window.columns as u32 + 1);
        let top = top.min(window.rows as u32 + 1);
        if left >= right {
            return;
        }
        // Many faces have no corner inside.
        let mut known = None;
        let [a, b, c] = vertices.map(|vertex| hull.vertices.at(vertex));
        let edges = [Edge::new(a, b), Edge::new(b, c), Edge::new(c, a)];
        for row in bottom..top {
            if *rows_left == 0 {
                return;
            }
            *rows_left -= 1;
            let y = window.y + f64::from(row) * cell;
            let corner = |column: u32| direction(side, window.x + f64::from(column) * cell, y);
            let (mut first, mut end) = (left, right);
            if end - first > FEW_COLUMNS {
                let width = f64::from(right - left);
                for edge in &edges {
                    let (low, high) = (edge.height(corner(left)), edge.height(corner(right)));
                    // The sign changes after this column, except for roundings.
                    let part = (low / (low - high)).clamp(0.0, 1.0);
                    let zero = left + (width * part) as u32;
                    match (low < 0.0, high < 0.0) {
                        (true, true) => end = first,
                        (true, false) => first = first.max(zero.max(1) - 1),
                        (false, true) => end = end.min(zero + 2),
                        (false, false) => {}
                    }
                }
            }
            for column in first..end {
                let place = window.first + row as usize * (window.columns + 1) + column as usize;
                let corner = corner(column);
                // One branch that is hard to predict instead of three.
                let [first, second, third] = &edges;
                let is_inside =
                    first.is_inside(corner) & second.is_inside(corner) & third.is_inside(corner);
                if is_inside && self.heights[place] == 0.0 {
                    let plane = || hull.vertices.plane_out_of_line(vertices);
                    let Plane { m, error } = *known.get_or_insert_with(plane);
                    if error < f64::INFINITY {
                        self.heights[place] = m.dot(corner) * (1.0 + 2.0 * error + ROUNDING);
                    }
                }
            }
        }
    }
}
