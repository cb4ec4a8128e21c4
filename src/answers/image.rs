//! Images, whose values go to points.

use alloc::vec::Vec;

use crate::base::allocation::filled;
use crate::base::error::Error;
use crate::base::real::floor;

/// An image of the size of its camera's, row by row from above, the channels of a pixel side by side. A pixel with a
/// NaN gives no value, nor one with alpha 0 in an image of 4 bytes a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Image<'a> {
    /// The numbers.
    pub pixels: Pixels<'a>,
    /// How many numbers a pixel has.
    pub channels: usize,
}

/// The numbers of an image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pixels<'a> {
    /// Bytes.
    Bytes(&'a [u8]),
    /// Single precision.
    Singles(&'a [f32]),
    /// Double precision, which also holds whole numbers up to 2⁵³.
    Doubles(&'a [f64]),
}

impl Pixels<'_> {
    pub(crate) fn len(&self) -> usize {
        match self {
            Self::Bytes(numbers) => numbers.len(),
            Self::Singles(numbers) => numbers.len(),
            Self::Doubles(numbers) => numbers.len(),
        }
    }
}

/// An image and its size.
pub(crate) struct Raster<'a> {
    pub image: &'a Image<'a>,
    pub width: usize,
    pub height: usize,
}

impl Raster<'_> {
    /// The pixel in which a place is. Returns whether it has a value.
    pub fn at(&self, u: f64, v: f64, into: &mut [f64]) -> bool {
        self.nearest(floor(u), floor(v), into)
    }

    /// The pixel at this column and row, or the nearest one of the image.
    fn nearest(&self, column: f64, row: f64, into: &mut [f64]) -> bool {
        // Conversions saturate: negative numbers become 0.
        let x = (column as usize).min(self.width - 1);
        let y = (row as usize).min(self.height - 1);
        let at = (y * self.width + x) * into.len();
        match self.image.pixels {
            Pixels::Bytes(numbers) => {
                copy(&numbers[at..], into);
                !matches!(numbers[at..at + into.len()], [_, _, _, 0])
            }
            Pixels::Singles(numbers) => copy(&numbers[at..], into),
            Pixels::Doubles(numbers) => copy(&numbers[at..], into),
        }
    }

    /// Between four pixels, whose centers have whole coordinates here.
    pub fn between(&self, x: f64, y: f64, into: &mut [f64]) -> Result<bool, Error> {
        let (left, up) = (floor(x), floor(y));
        let (right, down) = (x - left, y - up);
        let mut sums: Vec<f64> = filled(into.len(), 0.0)?;
        let mut total = 0.0;
        for (i, j) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)] {
            let across = if i > 0.0 { right } else { 1.0 - right };
            let weight = across * if j > 0.0 { down } else { 1.0 - down };
            if weight > 0.0 && self.nearest(left + i, up + j, into) {
                (sums.iter_mut().zip(&*into)).for_each(|(sum, value)| *sum += weight * value);
                total += weight;
            }
        }
        (into.iter_mut().zip(sums)).for_each(|(to, sum)| *to = sum / total);
        Ok(total > 0.0)
    }
}

/// Copies the first numbers. Returns whether none is NaN.
fn copy<T: Copy + Into<f64>>(from: &[T], into: &mut [f64]) -> bool {
    (into.iter_mut().zip(from)).for_each(|(to, &from)| *to = from.into());
    !into.iter().any(|x| x.is_nan())
}
