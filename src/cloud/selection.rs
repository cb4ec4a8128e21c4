//! Which points of a cloud take part in a view: those within a distance and a box, and a sample
//! of them.

use glam::DVec3;

use crate::base::error::{Error, in_range};
use crate::base::real::square_root;

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
        if let Some([min, max]) = self.bounds {
            // The comparison also refuses a NaN.
            if !(0..3).all(|axis| min[axis] <= max[axis]) {
                return Err(Error::BoundsInvalid);
            }
        }
        Ok(())
    }

    /// The choice that is left in a box; `None` if all points there take part.
    pub(crate) fn without_bounds(self) -> Option<Self> {
        self.distance.map(|distance| Self {
            distance: Some(distance),
            bounds: None,
        })
    }
}

/// All that decides which points take part in a view. Two views with equal selections are of the
/// same points.
#[derive(Clone, Copy, Default, PartialEq)]
pub(crate) struct Selection {
    pub within: Option<Within>,
    /// The viewpoint, if `within` has a distance.
    pub viewpoint: Option<[f64; 3]>,
    /// The number of sampled points; `None` where all take part.
    pub sample: Option<usize>,
}

impl Selection {
    /// The points within a box, and within a distance from `viewpoint` if there is one.
    pub(crate) fn new(within: Within, viewpoint: Option<[f64; 3]>) -> Self {
        Self {
            within: Some(within),
            viewpoint,
            sample: None,
        }
    }

    /// Whether `p` is in the box and near the viewpoint.
    #[inline(never)]
    pub(crate) fn holds(&self, p: [f64; 3]) -> bool {
        let Within { distance, bounds } = self.within.unwrap_or_default();
        let is_near = match (distance, self.viewpoint) {
            (Some(distance), Some(viewpoint)) => {
                let v = DVec3::from_array(p) - DVec3::from_array(viewpoint);
                square_root(v.dot(v)) <= distance
            }
            _ => true,
        };
        let is_inside = |[min, max]: [[f64; 3]; 2]| {
            (0..3).all(|axis| min[axis] <= p[axis] && p[axis] <= max[axis])
        };
        is_near && bounds.is_none_or(is_inside)
    }
}
