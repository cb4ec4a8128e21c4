//! The test of a point against a map, in single precision: the same numbers as in a shader.
//!
//! Let u be 2⁻²³. A card may round a sum or a product by u, a quotient by 2.5 u and a root by 4 u,
//! relative to the result, may round the position and the viewpoint by u/2, and may flush numbers below
//! 2⁻¹²⁶ to 0. Let C be the largest coordinate of the viewpoint.
//!
//! - A coordinate of v = p − C is wrong by at most u·C besides a relative error of 2u.
//! - The place of v on its side of the cube is wrong by at most 9u, and by 2u·C/z. In cells, the
//!   first is at most `border`. A direction that is nearer than this to the border of its cell is not
//!   tested. Inside the cell, the interpolation changes by at most 2·`border`·(M − m).
//! - |v| is wrong by less than 16u of it, and by 2u·C.
//! - The interpolation of positive numbers is wrong by less than 16u of the largest.

use alloc::vec::Vec;

use crate::answers::visibility_map::gauge::{Asked, Gauge, MOST};
use crate::answers::visibility_map::grid::EMPTY;
use crate::answers::visibility_map::levels::{Champions, Levels};
use crate::answers::visibility_map::surface::spread;
use crate::base::allocation::{OutOfMemory, filled};
use crate::base::real::square_root;

/// The numbers before the first corner: eight for each side of the cube.
const HEADER: usize = 48;
/// The texture's width. The data fill whole rows.
const ROW: usize = 256;
/// Four numbers are written at once.
const SPARE: usize = 4;
const UNIT: f64 = f32::EPSILON as f64;

/// Which points are certainly hidden from a viewpoint. `docs/API.md` describes the data and
/// the shader.
#[derive(Clone, Debug, PartialEq)]
pub struct VisibilityMap {
    viewpoint: [f64; 3],
    origin: [f64; 3],
    /// The viewpoint relative to the origin.
    local: [f32; 3],
    /// A bound of the error of a coordinate relative to the viewpoint.
    error: f64,
    /// Cells a unit, border, border for each 1/z, and the error of a distance.
    numbers: [f32; 4],
    data: Vec<f32>,
}

impl VisibilityMap {
    /// A map that hides nothing.
    pub(super) fn empty(viewpoint: [f64; 3], origin: [f64; 3]) -> Self {
        let local = core::array::from_fn(|axis| (viewpoint[axis] - origin[axis]) as f32);
        let mut map = Self {
            viewpoint,
            origin,
            local,
            error: 0.0,
            numbers: [0.0; 4],
            data: Vec::new(),
        };
        map.error = map.distance_of_origin() * UNIT * 1.01 + 1e-36;
        map
    }

    /// A map that holds what another one does: its [`viewpoint`](Self::viewpoint), [`origin`](Self::origin),
    /// [`numbers`](Self::numbers) and [`data`](Self::data). So a map can be stored.
    #[must_use]
    pub fn from_parts(
        viewpoint: [f64; 3],
        origin: [f64; 3],
        numbers: [f32; 4],
        data: Vec<f32>,
    ) -> Self {
        Self {
            numbers,
            data,
            ..Self::empty(viewpoint, origin)
        }
    }

    /// The largest coordinate of the viewpoint relative to the origin.
    pub(super) fn distance_of_origin(&self) -> f64 {
        self.local
            .iter()
            .fold(0.0, |most, x| f64::from(x.abs()).max(most))
    }

    /// Writes the distances along the corners of the champions' grid.
    #[inline(never)]
    pub(super) fn fill(
        &mut self,
        champions: &Champions,
        levels: &mut Levels,
        asked: &Asked,
    ) -> Result<(), OutOfMemory> {
        let grid = &champions.grid;
        let nearest = champions
            .cells
            .iter()
            .fold(EMPTY, |least, &cell| cell.min(least));
        let nearest = f32::from_bits((nearest >> 32) as u32);
        let Some(gauge) = Gauge::new(asked, nearest) else {
            return Ok(());
        };
        let corners = grid.corners();
        let len = (HEADER + corners).next_multiple_of(ROW);
        let mut data = filled(len + SPARE, 0.0)?;
        for (to, window) in data.chunks_exact_mut(8).zip(&grid.windows) {
            let first = HEADER + window.first;
            to[..5].copy_from_slice(&[
                window.x as f32,
                window.y as f32,
                window.columns as f32,
                window.rows as f32,
                first as f32,
            ]);
        }
        let distances = &mut data[HEADER..];
        for (side, window) in grid.used() {
            levels.fill(champions, side, gauge, &mut distances[window.first..])?;
        }
        distances[corners..].fill(0.0);
        if let Asked::Looks(_, depth) = asked {
            spread(grid, depth.aside, &mut distances[..corners])?;
        }
        data.truncate(len);
        let cells = grid.cells_per_unit;
        let up = |x: f64| (x * (1.0 + UNIT)) as f32;
        self.numbers = [
            cells as f32,
            up(16.0 * UNIT * cells),
            up(2.2 * self.error * cells),
            up(2.0 * self.error),
        ];
        self.data = data;
        Ok(())
    }

    /// The viewpoint, in the cloud's coordinates.
    #[must_use]
    pub fn viewpoint(&self) -> [f64; 3] {
        self.viewpoint
    }

    /// What positions in a shader are relative to.
    #[must_use]
    pub fn origin(&self) -> [f64; 3] {
        self.origin
    }

    /// The texture: rows of 256 numbers. It is empty where nothing is hidden.
    #[must_use]
    pub fn data(&self) -> &[f32] {
        &self.data
    }

    /// The numbers of the shader besides the texture and the viewpoint: cells a unit, the border of a
    /// cell, what 1/z adds to it, and the error of a distance.
    #[must_use]
    pub fn numbers(&self) -> [f32; 4] {
        self.numbers
    }

    /// Whether a point at this place is certainly hidden.
    #[must_use]
    pub fn hides(&self, position: [f64; 3]) -> bool {
        let v = core::array::from_fn(|axis| {
            (position[axis] - self.origin[axis]) as f32 - self.local[axis]
        });
        self.hides_at(v).unwrap_or(false)
    }

    /// `None` where nothing is known.
    fn hides_at(&self, [x, y, z]: [f32; 3]) -> Option<bool> {
        let header: &[f32; HEADER] = self.data.first_chunk()?;
        let (a, b, c) = (x.abs(), y.abs(), z.abs());
        let (side, x, y, z) = if c >= a && c >= b {
            (0, x, y, z)
        } else if a >= b {
            (2, y, z, x)
        } else {
            (4, z, x, y)
        };
        let window = &header[8 * (side + usize::from(z < 0.0))..];
        let inverse = 1.0 / z.abs();
        let (x, y) = (x * inverse, y * inverse);
        let (right, up) = (
            (x - window[0]) * self.numbers[0],
            (y - window[1]) * self.numbers[0],
        );
        let border = self.numbers[1] + self.numbers[2] * inverse;
        // NaN and negative numbers become 0.
        let (column, row) = (right as usize, up as usize);
        let (s, t) = (right - column as f32, up - row as f32);
        let inner = |t: f32| t > border && t < 1.0 - border;
        let (columns, rows) = (window[2] as usize, window[3] as usize);
        if !(column < columns && row < rows && inner(s) && inner(t)) {
            return None;
        }
        let low = window[4] as usize + row * (columns + 1) + column;
        let [a, b] = *self.data.get(low..)?.first_chunk()?;
        let [c, d] = *self.data.get(low + columns + 1..)?.first_chunk()?;
        let mix = |a: f32, b: f32, t: f32| a * (1.0 - t) + b * t;
        let distance = mix(mix(a, b, s), mix(c, d, s), t);
        let most = a.max(b).max(c.max(d));
        let least = a.min(b).min(c.min(d));
        let limit = distance + (most - least) * (2.0 * border) + most * 4e-6;
        // The root in double precision, rounded once more, is the correctly rounded one.
        let root = square_root(f64::from(x * x + y * y + 1.0)) as f32;
        let length = z.abs() * root;
        // A cell with an unknown corner hides nothing, however far away. An infinite coordinate has no direction.
        let is_known = most < MOST as f32 && length < f32::INFINITY;
        Some(is_known && length * (1.0 - 8e-6) - self.numbers[3] > limit)
    }
}
