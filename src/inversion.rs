//! Spherical flipping (paper §3, eq. 1): points move along their rays from the
//! viewpoint C to the far side of a sphere of radius R around it, nearest farthest.
//!
//! ```text
//!   before                          after
//!   C ·  ·· near ··  far   |R       C            | far ·· near        2R
//!     |----d---->|                  |------------2R − d---->|
//! ```

use glam::DVec3;

use crate::points::Points;

/// The flip around one viewpoint, with one fixed sequence of operations, so
/// that every platform rounds alike: v = p − C, d = √(vx² + vy² + vz²),
/// s = (2R − d)/d, q = v·s.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Flip {
    viewpoint: DVec3,
    radius: f64,
    /// A power of two that brings |q| near 1 where R is extreme; otherwise 1.
    scale: f64,
}

impl Flip {
    /// `radius` is at least the farthest distance, and 2R is finite.
    pub(crate) fn new(viewpoint: [f64; 3], radius: f64) -> Self {
        Self {
            viewpoint: DVec3::from_array(viewpoint),
            radius,
            scale: 1.0,
        }
    }

    /// The flipped point q, or `None` for a point at the viewpoint (d = 0 or s
    /// not finite), which is visible and takes no part in the hull.
    #[inline]
    pub(crate) fn apply(&self, p: [f64; 3]) -> Option<DVec3> {
        let v = DVec3::from_array(p) - self.viewpoint;
        let d = square_root(v.dot(v));
        // d = 0 makes s infinite or NaN.
        let s = (2.0 * self.radius - d) / d;
        s.is_finite().then(|| v * s * self.scale)
    }

    /// Twice the largest |q|, which is 2R but for rounding (and at most 2.5 R
    /// where squares underflow and make d too small).
    pub(crate) fn reach(&self) -> f64 {
        4.0 * self.radius * self.scale
    }

    pub(crate) fn viewpoint(&self) -> DVec3 {
        self.viewpoint
    }

    /// The largest |q| in the cloud's own units.
    pub(crate) fn reach_in_cloud(&self) -> f64 {
        2.0 * self.radius
    }

    /// A squared distance from which on every point flips to less than `length`, with
    /// all roundings: 2R − d < length where d > 2R − length.
    pub(crate) fn hidden_from(&self, length: f64) -> f64 {
        const ROUNDING: f64 = 1e-12;
        let diameter = 2.0 * self.radius;
        let distance = diameter * (1.0 + ROUNDING) - length / self.scale;
        distance.max(0.0) * distance.max(0.0) * (1.0 + ROUNDING)
    }

    /// Rescales the flipped cloud by a power of two where R is so extreme that
    /// floating-point filters would over- or underflow. Signs don't change with
    /// scale; where the scaling itself would round, it is left out.
    pub(crate) fn rescaled_for(self, points: &Points) -> Self {
        const MODERATE: core::ops::Range<f64> = 1e-30..1e30;
        if MODERATE.contains(&self.radius) {
            return self;
        }
        let scale = power_of_two_below(1.0 / self.radius);
        let scaled = Self { scale, ..self };
        let exact = points
            .iter()
            .all(|p| match (self.apply(p), scaled.apply(p)) {
                (Some(q), Some(small)) => small / scale == q,
                _ => true,
            });
        if exact { scaled } else { self }
    }
}

/// The correctly rounded square root, from the platform where there is one.
pub(crate) fn square_root(x: f64) -> f64 {
    #[cfg(feature = "std")]
    {
        x.sqrt()
    }
    #[cfg(not(feature = "std"))]
    {
        libm::sqrt(x)
    }
}

/// The largest normal power of two not above the positive number `x`, or the
/// smallest normal one.
fn power_of_two_below(x: f64) -> f64 {
    f64::from_bits(x.max(f64::MIN_POSITIVE).to_bits() & 0x7ff0_0000_0000_0000)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn glam_keeps_the_fixed_operation_order() {
        let c = [0.1, -7.3, 1e6];
        for i in 0..1000 {
            let i = f64::from(i);
            let p = [i * 0.37 - 90.0, i * i * 1e-3, 1e6 + i * 1e-3];
            let (x, y, z) = (p[0] - c[0], p[1] - c[1], p[2] - c[2]);
            let xx_yy = x * x + y * y;
            let d = (xx_yy + z * z).sqrt();
            let s = (2.0 * 5e3 - d) / d;
            let q = Flip::new(c, 5e3).apply(p).map(|q| q.to_array());
            assert_eq!(q, Some([x * s, y * s, z * s]));
        }
    }

    #[test]
    fn points_at_the_viewpoint_are_left_out() {
        let flip = Flip::new([1.0, 2.0, 3.0], 10.0);
        assert_eq!(flip.apply([1.0, 2.0, 3.0]), None);
        // d underflows to 0, then s overflows.
        assert_eq!(Flip::new([0.0; 3], 1.0).apply([1e-200, 0.0, 0.0]), None);
        assert_eq!(Flip::new([0.0; 3], 1e300).apply([1e-150, 0.0, 0.0]), None);
    }
}
