//! The limit of a flip for a viewpoint that recedes to infinity: points are lifted on a paraboloid.

use glam::DVec3;

use crate::base::real::square_root;
use crate::cloud::spatial::Bounds;

/// The map p → (x, y, z + a·(x² + y²)), with one fixed sequence of operations:
/// v = p·k − center·k, x and y its products with the axes across, z with the
/// direction (each summed left to right), w = z + (a/k)·(x·x + y·y).
pub(crate) struct Lift {
    right: DVec3,
    up: DVec3,
    ahead: DVec3,
    /// The center in scaled coordinates.
    center: DVec3,
    /// k, a power of two that brings the box to a size near 1.
    scale: f64,
    bend: f64,
}

impl Lift {
    pub(crate) fn new(bounds: &Bounds, ahead: DVec3, bend: f64) -> Self {
        /// The largest bend. With a larger one only the lift would count. Products are still in
        /// range.
        const MAX_BEND: f64 = 1e50;
        let across = ahead.cross(DVec3::AXES[ahead.abs().min_position()]);
        let right = across / square_root(across.dot(across));
        let (center, scale) = bounds.coarse_center();
        Self {
            right,
            up: right.cross(ahead),
            ahead,
            center: DVec3::from_array(center),
            scale,
            bend: (bend / scale).min(MAX_BEND),
        }
    }

    /// A place near the middle of the cloud.
    pub(crate) fn middle(&self) -> DVec3 {
        self.center / self.scale
    }

    /// A power of two that brings the cloud to a size near 1.
    pub(crate) fn scale(&self) -> f64 {
        self.scale
    }

    pub(crate) fn apply(&self, p: [f64; 3]) -> DVec3 {
        let v = DVec3::from_array(p) * self.scale - self.center;
        let x = v.dot(self.right);
        let y = v.dot(self.up);
        let z = v.dot(self.ahead);
        DVec3::new(x, y, z + self.bend * (x * x + y * y))
    }
}
