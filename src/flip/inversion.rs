//! The flip: points move along their rays from the viewpoint C, and the nearest point goes
//! farthest. The default mirrors points in a sphere of radius R around C (paper §3, eq. 1).
//! Other inversions differ only in the distance (`kernel`).
//!
//! ```text
//!   before                          after
//!   C ·  ·· near ··  far   |R       C            | far ·· near        2R
//!     |----d---->|                  |------------2R − d---->|
//! ```

use glam::DVec3;

use crate::base::real::{power_of_two_below, square_root};
use crate::cloud::points::Points;
use crate::cloud::spatial::Bounds;
use crate::flip::kernel::Kernel;

#[cfg(test)]
mod tests;

/// The flip around one viewpoint. It has one fixed sequence of operations, so that every
/// platform rounds alike: v = p − C, d = √(vx² + vy² + vz²), s from d
/// ([`Kernel::factor`]; (2R − d)/d on a sphere), q = v·s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Flip {
    viewpoint: DVec3,
    kernel: Kernel,
    /// A power of two that brings an extreme |q| near 1; 1 where |q| is not extreme.
    scale: f64,
    /// No coordinate of a flipped point is larger, except for rounding and `scale`.
    extent: f64,
}

impl Flip {
    /// A radius in `kernel` is at least the farthest distance, and 2R is finite.
    pub(crate) fn new(viewpoint: [f64; 3], kernel: Kernel) -> Self {
        Self {
            viewpoint: DVec3::from_array(viewpoint),
            kernel,
            scale: 1.0,
            extent: kernel.radius().map_or(f64::INFINITY, |radius| 2.0 * radius),
        }
    }

    /// The flipped point q, or `None` for a point at the viewpoint (d = 0 or s
    /// not finite), which is visible and takes no part in the hull.
    #[inline]
    pub(crate) fn apply(&self, p: [f64; 3]) -> Option<DVec3> {
        let Kernel::Spherical { radius } = self.kernel else {
            return self.apply_other(p);
        };
        let v = DVec3::from_array(p) - self.viewpoint;
        let d = square_root(v.dot(v));
        // d = 0 makes s infinite or NaN.
        let s = (2.0 * radius - d) / d;
        s.is_finite().then(|| v * s * self.scale)
    }

    /// Whether to flip a point takes much less time than to locate it in a hull.
    pub(crate) fn is_fast(&self) -> bool {
        matches!(
            self.kernel,
            Kernel::Spherical { .. } | Kernel::Exponential { .. }
        )
    }

    /// Two numbers. Their quotient is at least the factor s of a point at `v` from the viewpoint,
    /// except for a few roundings, and at most 10⁻⁵ larger. The quotient is not finite for a point
    /// at the viewpoint.
    #[inline]
    pub(crate) fn ratio(&self, v: DVec3) -> (f64, f64) {
        let d = square_root(v.dot(v));
        match self.kernel {
            Kernel::Spherical { radius } => ((2.0 * radius - d) * self.scale, d),
            Kernel::Exponential { scale } if d >= 16.0 * scale => {
                // For x up to 1/16, exp(x) is at most 1 + x + x²/2 + x³/5.
                let x = scale / d;
                let length = 1.0 + x * (1.0 + x * (0.5 + x * 0.2));
                (length * self.scale, d)
            }
            kernel => (kernel.factor_out_of_line(d) * self.scale, 1.0),
        }
    }

    /// An upper bound of |q| for points at least `distance` from the viewpoint, roundings included.
    #[inline(never)]
    pub(crate) fn most_beyond(&self, distance: f64) -> f64 {
        const ROUNDING: f64 = 1e-12;
        let length = match self.kernel {
            Kernel::Spherical { radius } => 2.0 * radius * (1.0 + ROUNDING) - distance,
            Kernel::Power { .. } | Kernel::Exponential { .. } | Kernel::Growing { .. }
                if distance > 0.0 =>
            {
                self.kernel.length(distance) * (1.0 + ROUNDING)
            }
            _ => f64::INFINITY,
        };
        length * self.scale
    }

    /// 2R of a flip on a sphere.
    pub(crate) fn diameter(&self) -> Option<f64> {
        self.kernel.radius().map(|radius| 2.0 * radius)
    }

    /// How far a point at this distance reaches when it is flipped.
    #[inline(never)]
    pub(crate) fn reach_at(&self, distance: f64) -> f64 {
        self.kernel.length(distance) * self.scale
    }

    /// The least distance of a point that a hull hides which reaches so far along the point's ray;
    /// infinite where there is none. It is convex in the reach.
    #[inline(never)]
    pub(crate) fn distance_at(&self, reach: f64) -> f64 {
        self.kernel.distance(reach / self.scale)
    }

    /// The flipped point for any kernel. This is not inlined, to keep the hull's loops small. A
    /// point that leaves the range of f64 also counts as a point at the viewpoint.
    #[inline(never)]
    fn apply_other(&self, p: [f64; 3]) -> Option<DVec3> {
        let v = DVec3::from_array(p) - self.viewpoint;
        let q = v * self.kernel.factor(square_root(v.dot(v)));
        q.is_finite().then(|| q * self.scale)
    }

    /// A length of at least twice the largest |q|. It holds after the flip is
    /// [`rescaled_for`](Self::rescaled_for) the points. There is one exception: on a sphere, where
    /// squares underflow and make d too small, the largest |q| is at most 5/8 of this length.
    pub(crate) fn reach(&self) -> f64 {
        let times = match self.kernel {
            Kernel::Spherical { .. } => 2.0,
            // |q| is up to √3 of the largest coordinate.
            _ => 4.0,
        };
        times * self.extent * self.scale
    }

    /// A power of two that moves every point at most `farthest` away along its ray, to a place
    /// before its flipped one. So no direction is rounded.
    pub(crate) fn inward(&self, farthest: f64) -> f64 {
        power_of_two_below(0.5 * self.kernel.factor(farthest) * self.scale)
    }

    pub(crate) fn viewpoint(&self) -> DVec3 {
        self.viewpoint
    }

    /// Rescales the flipped cloud by a power of two, if it is so large or so small that
    /// floating-point filters would overflow or underflow. Signs do not depend on the scale.
    /// Where the scaling itself would round, it is left out.
    pub(crate) fn rescaled_for(mut self, points: &Points) -> Self {
        const MODERATE: core::ops::Range<f64> = 1e-30..1e30;
        match self.kernel {
            // The extent is known if the flip was rescaled before.
            _ if self.extent < f64::INFINITY => {}
            Kernel::Exponential { .. } | Kernel::Growing { .. } => {
                self.extent = self.length_of_nearest(points);
            }
            Kernel::Power { .. } => self.extent = self.largest_coordinate(points),
            Kernel::Spherical { .. } => {}
        }
        if MODERATE.contains(&self.extent) || self.extent == 0.0 {
            return self;
        }
        let scale = power_of_two_below((1.0 / self.extent).min(f64::MAX));
        let scaled = Self { scale, ..self };
        let exact = points.iter().all(|p| scaled.scales_exactly(p));
        if exact { scaled } else { self }
    }

    /// Whether the scale rounds no coordinate of this flipped point.
    #[inline]
    pub(crate) fn scales_exactly(&self, p: [f64; 3]) -> bool {
        let unscaled = Self {
            scale: 1.0,
            ..*self
        };
        self.scale == 1.0
            || match (unscaled.apply(p), self.apply(p)) {
                (Some(q), Some(small)) => small / self.scale == q,
                _ => true,
            }
    }

    /// Whether all points have the viewpoint's z, like those of a cloud in the plane.
    pub(crate) fn keeps_in_plane(&self, points: &Points) -> bool {
        points.iter().all(|p| p[2] == self.viewpoint.z)
    }

    /// |q| of the nearest point, which is the largest one, unless squares underflow; `reach` allows
    /// for that.
    fn length_of_nearest(&self, points: &Points) -> f64 {
        let mut nearest = f64::INFINITY;
        for p in points.iter() {
            let v = DVec3::from_array(p) - self.viewpoint;
            let squared = v.dot(v);
            if squared > 0.0 && squared < nearest {
                nearest = squared;
            }
        }
        let distance = square_root(nearest);
        if distance < f64::INFINITY {
            self.kernel.length(distance)
        } else {
            0.0
        }
    }

    fn largest_coordinate(&self, points: &Points) -> f64 {
        let flipped = points.iter().filter_map(|p| self.apply(p));
        flipped.fold(0.0, |largest, q| largest.max(q.abs().max_element()))
    }
}

// The limit of a flip for a viewpoint that recedes to infinity: points are lifted on a paraboloid.

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
