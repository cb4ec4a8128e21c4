//! How far K reaches along the corners of a grid of directions, read off the faces of a complete
//! hull.
//!
//! K contains each face and everything between the face and the viewpoint. So along a direction
//! (x, y, 1) that is certainly inside a face with the dual plane m, K reaches at least 1/(m·(x, y, 1))
//! times as far. A corner that is certainly inside no face, as on an edge, stays unknown.

use alloc::vec::Vec;
use glam::DVec3;

use crate::base::allocation::{OutOfMemory, filled, with_capacity};
use crate::base::real::{larger, smaller, square_root};
use crate::hull::depth::{Window, place, turned};
use crate::hull::dual_plane::Plane;
use crate::hull::memory::Memory;
use crate::hull::topology::{FaceId, Vertex};

/// The largest number of cells along a side of length 1. Then single precision still finds the cell
/// of a direction, except near its border.
const MOST_CELLS: f64 = 4096.0;
/// A bound of the roundings of a height, for each |m|: about twenty of terms up to 3|m|.
const HEIGHT_ERROR: f64 = 64.0 * f64::EPSILON;

/// A grid of directions, and how far K reaches along each corner. The numbers of the grid are exact in
/// single precision.
pub(crate) struct Reaches {
    pub windows: [Window; 6],
    pub cells_per_unit: f64,
    /// For each corner an upper bound of w: K ends at 1/w times (x, y, 1) or beyond. It is infinite where none is known.
    pub heights: Vec<f64>,
    /// The outer face that a corner of known height is certainly inside.
    pub faces: Vec<FaceId>,
}

/// From here on, the window of a side of the cube reaches to the side's edge.
const NEAR_EDGE: f64 = 0.95;

/// Three corners of a face on a side of the cube.
type Places = [[f64; 2]; 3];

impl Memory {
    /// The reaches of the hull of the last view, which is complete, along at most `count` corners.
    /// `None` where the hull is flat.
    #[inline(never)]
    pub(crate) fn reaches(&self, count: usize) -> Result<Option<Reaches>, OutOfMemory> {
        if !self.holds_hull() {
            return Ok(None);
        }
        let vertices = &self.hull.vertices.positions;
        let mut seen = with_capacity(vertices.len())?;
        // The origin comes first, and is on no face that is passed.
        seen.extend(vertices.iter().map(|&q| {
            let (side, x, y, _) = place(q);
            (side, [x, y])
        }));
        let mut sides = [Side::NONE; 6];
        for &(side, place) in &seen[1..] {
            sides[side].include(place);
        }
        let Some((windows, cells_per_unit)) = grid(&sides, count) else {
            return Ok(None);
        };
        let corners = windows.iter().map(Window::corners).sum();
        let mut reaches = Reaches {
            windows,
            cells_per_unit,
            heights: filled(corners, f64::INFINITY)?,
            faces: filled(corners, 0)?,
        };
        for (side, place) in &mut seen {
            *place = reaches.in_cells(*side, *place);
        }
        self.fill(&mut reaches, &seen);
        Ok(Some(reaches))
    }

    /// The corners of a face.
    pub(crate) fn corners(&self, id: FaceId) -> [Vertex; 3] {
        self.hull.surface.face(id).vertices
    }

    /// Writes each outer face, on each side of the cube that it is on. `seen`: the side and the place of each vertex, in
    /// cells.
    #[inline(never)]
    fn fill(&self, reaches: &mut Reaches, seen: &[(usize, [f64; 2])]) {
        let hull = &self.hull;
        for (id, face) in hull.surface.alive() {
            if face.data.is_exact_only() {
                continue;
            }
            let [a, b, c] = face.vertices;
            let [(a, p), (b, q), (c, r)] = [seen[a as usize], seen[b as usize], seen[c as usize]];
            if a == b && a == c {
                reaches.fill(a, [p, q, r], id, &face.data);
                continue;
            }
            let corners = face.vertices.map(|vertex| hull.vertices.at(vertex));
            for side in 0..6 {
                if ![a, b, c].contains(&side) {
                    continue;
                }
                // A face that reaches behind a side is left out there.
                let ahead = corners.map(|q| reaches.place_on(side, q));
                if let [Some(a), Some(b), Some(c)] = ahead {
                    reaches.fill(side, [a, b, c], id, &face.data);
                }
            }
        }
    }
}

/// The extent of some places on a side of the cube.
#[derive(Clone, Copy)]
pub(crate) struct Side {
    low: [f64; 2],
    high: [f64; 2],
}

impl Side {
    pub(crate) const NONE: Self = Self {
        low: [f64::INFINITY; 2],
        high: [f64::NEG_INFINITY; 2],
    };

    pub(crate) fn include(&mut self, place: [f64; 2]) {
        for axis in 0..2 {
            // Near an edge of the cube faces go on to the next side.
            let x = match place[axis] {
                x if x > NEAR_EDGE => 1.0,
                x if x < -NEAR_EDGE => -1.0,
                x => x,
            };
            self.low[axis] = smaller(self.low[axis], x);
            self.high[axis] = larger(self.high[axis], x);
        }
    }
}

/// Windows with square cells of one size, and at most `count` corners in all.
pub(crate) fn grid(sides: &[Side; 6], count: usize) -> Option<([Window; 6], f64)> {
    let area: f64 = sides
        .iter()
        .filter(|side| side.low[0] <= side.high[0])
        .map(|side| (side.high[0] - side.low[0]) * (side.high[1] - side.low[1]))
        .sum();
    let mut cells = square_root(count as f64 / larger(area, 1e-9));
    loop {
        cells = f64::from(smaller(cells, MOST_CELLS) as f32);
        let mut windows = [Window::default(); 6];
        let mut first = 0;
        for (window, side) in windows.iter_mut().zip(sides) {
            if side.low[0] > side.high[0] {
                continue;
            }
            // A little less than the extent, so that no point is on the first border.
            let start = |x: f64| f64::from((x - 0.37 / cells) as f32);
            let (x, y) = (start(side.low[0]), start(side.low[1]));
            *window = Window {
                x,
                y,
                columns: ((side.high[0] - x) * cells) as usize + 1,
                rows: ((side.high[1] - y) * cells) as usize + 1,
                first,
            };
            first += window.corners();
        }
        if first == 0 {
            return None;
        }
        if first <= count {
            return Some((windows, cells));
        }
        cells *= 0.98;
        // Not even one cell a side.
        if cells < 0.25 {
            return None;
        }
    }
}

impl Reaches {
    /// A place on a side of the cube in cells, from the first corner of its window.
    #[inline]
    fn in_cells(&self, side: usize, [x, y]: [f64; 2]) -> [f64; 2] {
        let Window {
            x: left, y: low, ..
        } = self.windows[side];
        [(x - left), (y - low)].map(|x| x * self.cells_per_unit)
    }

    /// The same for a point on a given side; `None` behind it.
    fn place_on(&self, side: usize, q: DVec3) -> Option<[f64; 2]> {
        let (x, y, z) = turned(side, q);
        let inverse = 1.0 / z;
        (z > 0.0).then(|| self.in_cells(side, [x * inverse, y * inverse]))
    }

    /// Writes a face at each corner that is certainly inside it.
    #[inline]
    fn fill(&mut self, side: usize, places: Places, id: FaceId, plane: &Plane) {
        let window = self.windows[side];
        let [a, b, c] = places;
        // Whole numbers, of which the least is found without a branch, which no processor could guess.
        let range = |axis: usize, last: usize| {
            let [a, b, c] = [a, b, c].map(|place| (place[axis] + 1.0) as u32);
            // The first whole number above and the last one below; one too many is harmless.
            let last_below = a.max(b).max(c).saturating_sub(1);
            (a.min(b).min(c), last_below.min(last as u32))
        };
        let (left, right) = range(0, window.columns);
        let (bottom, top) = range(1, window.rows);
        // Most faces have no corner inside.
        if left <= right && bottom <= top {
            self.fill_rows(side, places, [left, right, bottom, top], id, plane);
        }
    }

    #[inline(never)]
    fn fill_rows(
        &mut self,
        side: usize,
        [a, mut b, mut c]: Places,
        [left, right, bottom, top]: [u32; 4],
        id: FaceId,
        plane: &Plane,
    ) {
        let window = self.windows[side];
        // Faces are counter-clockwise. Three sides of the cube are mirrored.
        if side % 2 == 1 {
            core::mem::swap(&mut b, &mut c);
        }
        // A bound of the error of a comparison: places and corners are rounded by some units, and products reach over the
        // whole window.
        let largest: f64 = [a, b, c].as_flattened().iter().map(|x| x.abs()).sum();
        let doubt =
            64.0 * f64::EPSILON * (4.0 * self.cells_per_unit + largest) * (2.0 * largest + 1.0);
        let [p, q, r] = [(a, b), (b, c), (c, a)].map(|(start, end)| Edge::new(start, end, doubt));
        let cell = 1.0 / self.cells_per_unit;
        let (to_right, up, ahead) = turned(side, plane.m);
        let m = plane.m.abs();
        let height_doubt = (m.x + m.y + m.z) * HEIGHT_ERROR;
        let factor = 1.0 + 2.0 * plane.error;
        for row in bottom..=top {
            let y = f64::from(row);
            let [of_p, of_q, of_r] = [p.start(y), q.start(y), r.start(y)];
            let (mut first, mut last) = (left, right);
            if last - first > 3 {
                for (edge, start) in [(&p, of_p), (&q, of_q), (&r, of_r)] {
                    edge.narrow(start, &mut first, &mut last);
                }
                if first > last {
                    continue;
                }
            }
            let along = up * (window.y + y * cell) + ahead;
            let line = window.first + row as usize * (window.columns + 1);
            let run = line + first as usize..=line + last as usize;
            let corners = self.heights[run.clone()]
                .iter_mut()
                .zip(&mut self.faces[run]);
            for (column, (height, face)) in (first..).zip(corners) {
                let x = f64::from(column);
                let here = to_right * (window.x + x * cell) + along;
                let is_inside =
                    (of_p > p.down * x) & (of_q > q.down * x) & (of_r > r.down * x) & (here > 0.0);
                // No processor can guess a branch here.
                let keep = u64::from(is_inside).wrapping_sub(1);
                let known = (here * factor + height_doubt).to_bits();
                *height = f64::from_bits(height.to_bits() & keep | known & !keep);
                *face = *face & keep as u32 | id & !keep as u32;
            }
        }
    }
}

/// An edge of a face in cells. The face is on its left.
struct Edge {
    right: f64,
    down: f64,
    base: f64,
}

impl Edge {
    #[inline]
    fn new([x, y]: [f64; 2], end: [f64; 2], doubt: f64) -> Self {
        let [right, down] = [end[0] - x, end[1] - y];
        Self {
            right,
            down,
            base: down * x - right * y - doubt,
        }
    }

    /// A corner of this row is certainly on the left if this is more than `down` times its column.
    #[inline]
    fn start(&self, row: f64) -> f64 {
        self.right * row + self.base
    }

    /// Leaves out columns of a row that are on the right of the edge, except for two.
    fn narrow(&self, start: f64, first: &mut u32, last: &mut u32) {
        let crossing = start / self.down;
        if self.down < 0.0 {
            *first = (*first).max(crossing as u32);
        } else if self.down > 0.0 {
            *last = (*last).min((crossing + 1.0) as u32);
        }
    }
}
