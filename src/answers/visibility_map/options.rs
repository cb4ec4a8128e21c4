//! The size of a map, and its directions.

use crate::base::MAX_POINTS;
use crate::base::error::{Error, in_range};
use crate::view::resolved::{check_viewpoint, normalized};

/// How many corners a map may have: their numbers are exact in single precision.
const CORNERS: [f64; 2] = [64.0, 4_194_304.0];

/// The size of a [`VisibilityMap`](crate::VisibilityMap), and its directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapOptions {
    /// How many points the map's hull has at most; at least 16.
    pub points: usize,
    /// How many directions the map has at most: 64 to 2²².
    pub corners: usize,
    /// The only directions that get points and corners: a direction, and the full opening of a cone
    /// around it, in degrees. [`Camera::cone`](crate::Camera::cone) gives those of a camera.
    pub towards: Option<([f64; 3], f64)>,
    /// What positions in a shader are relative to. Without a choice it is 0 for a cloud in single
    /// precision, and the middle of the cloud's box otherwise.
    pub origin: Option<[f64; 3]>,
}

impl Default for MapOptions {
    fn default() -> Self {
        Self {
            points: 32_768,
            corners: 131_072,
            towards: None,
            origin: None,
        }
    }
}

impl MapOptions {
    pub(super) fn check(&self) -> Result<(), Error> {
        in_range("points", self.points as f64, 16.0, MAX_POINTS as f64)?;
        in_range("corners", self.corners as f64, CORNERS[0], CORNERS[1])?;
        if let Some((direction, angle)) = self.towards {
            normalized(direction).ok_or(Error::Direction { direction })?;
            in_range("towards angle", angle, f64::MIN_POSITIVE, 360.0)?;
        }
        self.origin.map_or(Ok(()), check_viewpoint)
    }
}
