//! The size of a map, and its directions.

use crate::base::MAX_POINTS;
use crate::base::error::{Error, in_range};
use crate::view::resolved::{check_viewpoint, normalized};

/// The size of a [`VisibilityMap`](crate::VisibilityMap), and its directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapOptions {
    /// How many points of the cloud are looked through at most; at least 16. With `towards` it is three times as many.
    /// The larger the cloud, the more are looked through: 200,000 and one in 10.
    pub points: usize,
    /// The only directions that the map is of: a direction, and the full opening of a cone
    /// around it, in degrees. [`Camera::cone`](crate::Camera::cone) gives those of a camera.
    pub towards: Option<([f64; 3], f64)>,
    /// What positions in a shader are relative to. Without a choice it is 0 for a cloud in single
    /// precision, and the middle of the cloud's box otherwise.
    pub origin: Option<[f64; 3]>,
}

impl Default for MapOptions {
    fn default() -> Self {
        Self {
            points: 750_000,
            towards: None,
            origin: None,
        }
    }
}

impl MapOptions {
    pub(super) fn check(&self) -> Result<(), Error> {
        in_range("points", self.points as f64, 16.0, MAX_POINTS as f64)?;
        if let Some((direction, angle)) = self.towards {
            normalized(direction).ok_or(Error::Direction { direction })?;
            in_range("towards angle", angle, f64::MIN_POSITIVE, 360.0)?;
        }
        self.origin.map_or(Ok(()), check_viewpoint)
    }
}
