//! Where the points are that take part in a view: within a distance and a box.

use glam::DVec3;

use crate::base::error::{Error, check_box, in_range};
use crate::base::real::square_root;
use crate::cloud::points::is_finite;

/// Only these points take part in a view. The others are not visible and hide nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Within {
    /// The points at most this far from the viewpoint, in the cloud's units; at least 0.
    pub distance: Option<f64>,
    /// The points in this box, its faces included: the lowest and the highest coordinates.
    pub bounds: Option<[[f64; 3]; 2]>,
}

impl Within {
    pub(crate) fn check(&self) -> Result<(), Error> {
        if let Some(distance) = self.distance {
            in_range("within distance", distance, 0.0, f64::INFINITY)?;
        }
        self.bounds.map_or(Ok(()), check_box)
    }

    /// The places of the points that take part in a view from `viewpoint`; `None` if that is
    /// everywhere. Without a viewpoint, the distance does not count.
    pub(crate) fn region(&self, viewpoint: Option<[f64; 3]>) -> Result<Option<Region>, Error> {
        self.check()?;
        let around = self.distance.zip(viewpoint);
        if let Some((_, viewpoint)) = around {
            if !is_finite(viewpoint) {
                return Err(Error::Viewpoint { viewpoint });
            }
        }
        let bounds = self.bounds;
        let is_somewhere = around.is_some() || bounds.is_some();
        Ok(is_somewhere.then_some(Region { around, bounds }))
    }
}

/// A part of space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Region {
    /// A distance and the center from which it counts.
    around: Option<(f64, [f64; 3])>,
    bounds: Option<[[f64; 3]; 2]>,
}

impl Region {
    #[inline(never)]
    pub(crate) fn holds(&self, p: [f64; 3]) -> bool {
        let is_near = self.around.is_none_or(|(distance, center)| {
            let v = DVec3::from_array(p) - DVec3::from_array(center);
            square_root(v.dot(v)) <= distance
        });
        let is_inside = |[min, max]: [[f64; 3]; 2]| {
            (0..3).all(|axis| min[axis] <= p[axis] && p[axis] <= max[axis])
        };
        is_near && self.bounds.is_none_or(is_inside)
    }
}
