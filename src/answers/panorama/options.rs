//! The size of a panorama, and the direction of each pixel.

use core::f64::consts::{PI, TAU};
use glam::DVec3;

use crate::base::error::{Error, in_range};
use crate::base::real::{sine_cosine, square_root};
use crate::view::resolved::normalized;

/// The largest width and height.
const MOST: f64 = 16_384.0;
/// +x is parallel to up if the sine of their angle is at most this.
const PARALLEL: f64 = 1e-9;

/// The size of a [`Panorama`](crate::Panorama), and where it is up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PanoramaOptions {
    /// The number of columns, 1 to 16384.
    pub width: usize,
    /// The number of rows, 1 to 16384.
    pub height: usize,
    /// The direction above the first row, of any length but 0. Column 0 looks along the part of +x that is
    /// perpendicular to it, or of +y where +x is parallel to it.
    pub up: [f64; 3],
}

impl Default for PanoramaOptions {
    fn default() -> Self {
        Self {
            width: 1024,
            height: 512,
            up: [0.0, 0.0, 1.0],
        }
    }
}

impl PanoramaOptions {
    pub(super) fn image(&self) -> Result<Image, Error> {
        let Self { width, height, up } = *self;
        in_range("width", width as f64, 1.0, MOST)?;
        in_range("height", height as f64, 1.0, MOST)?;
        let up = normalized(up).ok_or(Error::Direction { direction: up })?;
        let across = |axis: DVec3| {
            let across = axis - up * up.dot(axis);
            (across, square_root(across.length_squared()))
        };
        let (mut first, mut length) = across(DVec3::X);
        if length <= PARALLEL {
            (first, length) = across(DVec3::Y);
        }
        let first = first / length;
        Ok(Image {
            width,
            height,
            up,
            first,
            second: up.cross(first),
        })
    }
}

/// The pixels of a panorama.
pub(super) struct Image {
    pub width: usize,
    pub height: usize,
    pub up: DVec3,
    /// Where column 0 looks.
    first: DVec3,
    /// Where the column at a quarter of the width looks.
    second: DVec3,
}

impl Image {
    pub fn pixels(&self) -> usize {
        self.width * self.height
    }

    /// The cosine from up at the upper edge of a row.
    pub fn cosine(&self, row: usize) -> f64 {
        sine_cosine(PI * row as f64 / self.height as f64).1
    }

    /// The direction of a pixel's middle, of length 1.
    pub fn direction(&self, row: usize, column: usize) -> DVec3 {
        let (across, along) = sine_cosine(PI * (row as f64 + 0.5) / self.height as f64);
        let (sin, cos) = sine_cosine(TAU * column as f64 / self.width as f64);
        (self.first * cos + self.second * sin) * across + self.up * along
    }
}
