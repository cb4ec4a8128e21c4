//! What a lens does to the image of a pinhole: COLMAP's models.

use crate::base::error::Error;
use crate::base::real::{sine_cosine, square_root};

/// COLMAP's models of a camera, in the order of its numbers for them. Each lists the coefficients of
/// its distortion in COLMAP's order.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CameraModel {
    /// No distortion.
    SimplePinhole,
    /// No distortion.
    Pinhole,
    /// k.
    SimpleRadial,
    /// k1, k2.
    Radial,
    /// k1, k2, p1, p2; OpenCV adds k3.
    #[default]
    OpenCv,
    /// k1 to k4, of the angle from the optical axis.
    OpenCvFisheye,
    /// k1, k2, p1, p2, k3, k4, k5, k6.
    FullOpenCv,
    /// The lens's field of view ω, in radians, from 0 to π.
    Fov,
    /// k, of the angle.
    SimpleRadialFisheye,
    /// k1, k2, of the angle.
    RadialFisheye,
    /// k1, k2, p1, p2, k3, k4, sx1, sy1, of the angle.
    ThinPrismFisheye,
}

impl CameraModel {
    /// All models, by COLMAP's numbers.
    pub const ALL: [Self; 11] = [
        Self::SimplePinhole,
        Self::Pinhole,
        Self::SimpleRadial,
        Self::Radial,
        Self::OpenCv,
        Self::OpenCvFisheye,
        Self::FullOpenCv,
        Self::Fov,
        Self::SimpleRadialFisheye,
        Self::RadialFisheye,
        Self::ThinPrismFisheye,
    ];

    /// COLMAP's name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::SimplePinhole => "SIMPLE_PINHOLE",
            Self::Pinhole => "PINHOLE",
            Self::SimpleRadial => "SIMPLE_RADIAL",
            Self::Radial => "RADIAL",
            Self::OpenCv => "OPENCV",
            Self::OpenCvFisheye => "OPENCV_FISHEYE",
            Self::FullOpenCv => "FULL_OPENCV",
            Self::Fov => "FOV",
            Self::SimpleRadialFisheye => "SIMPLE_RADIAL_FISHEYE",
            Self::RadialFisheye => "RADIAL_FISHEYE",
            Self::ThinPrismFisheye => "THIN_PRISM_FISHEYE",
        }
    }

    /// The number of coefficients. With 5, those of [`Self::OpenCv`] include k3.
    #[must_use]
    pub const fn coefficients(self) -> usize {
        match self {
            Self::SimplePinhole | Self::Pinhole => 0,
            Self::SimpleRadial | Self::SimpleRadialFisheye | Self::Fov => 1,
            Self::Radial | Self::RadialFisheye => 2,
            Self::OpenCvFisheye => 4,
            Self::OpenCv => 5,
            Self::FullOpenCv | Self::ThinPrismFisheye => 8,
        }
    }
}

/// A distortion that was checked. All models but one are the same formula with other zeros.
pub(crate) struct Distortion {
    bend: Bend,
    /// The radial factor is the quotient of two polynomials in the square of the radius.
    above: [f64; 5],
    below: [f64; 4],
    tangential: [f64; 2],
    prism: [f64; 2],
    /// The square of the radius from which on the radial part does not grow.
    limit: f64,
}

/// What replaces the radius at first.
enum Bend {
    None,
    /// The angle from the optical axis.
    Angle,
    /// The angle, in the model of a lens with the field of view ω: atan(r · 2 tan(ω/2)) / ω.
    Fov {
        omega: f64,
        twice: f64,
    },
}

impl Distortion {
    pub(crate) fn new(model: CameraModel, coefficients: &[f64; 8]) -> Result<Self, Error> {
        let (own, others) = coefficients.split_at(model.coefficients());
        let (least, largest) = match model {
            CameraModel::Fov => (0.0, core::f64::consts::PI),
            _ => (-f64::MAX, f64::MAX),
        };
        let wrong = |problem, list: &[f64], least: f64, largest: f64| {
            // The range also refuses a NaN.
            let value = list.iter().find(|value| !(least..=largest).contains(value));
            value.map_or(Ok(()), |&value| Err(Error::Camera { problem, value }))
        };
        wrong(
            "distortion must be finite, and from 0 to pi for FOV",
            own,
            least,
            largest,
        )?;
        wrong(
            "distortion has more numbers than its model",
            others,
            0.0,
            0.0,
        )?;
        let [a, b, c, d, e, f, g, h] = *coefficients;
        let zero = [0.0; 2];
        let (bend, radial, below, tangential, prism) = match model {
            CameraModel::Fov => {
                let (sin, cos) = sine_cosine(0.5 * a);
                let twice = 2.0 * sin / cos;
                let bend = if a > 0.0 {
                    Bend::Fov { omega: a, twice }
                } else {
                    Bend::None
                };
                (bend, [0.0; 4], [0.0; 3], zero, zero)
            }
            CameraModel::OpenCvFisheye => (Bend::Angle, [a, b, c, d], [0.0; 3], zero, zero),
            CameraModel::SimpleRadialFisheye | CameraModel::RadialFisheye => {
                (Bend::Angle, [a, b, 0.0, 0.0], [0.0; 3], zero, zero)
            }
            CameraModel::ThinPrismFisheye => (Bend::Angle, [a, b, e, f], [0.0; 3], [c, d], [g, h]),
            // The coefficients that a model does not have are 0.
            _ => (Bend::None, [a, b, e, 0.0], [f, g, h], [c, d], zero),
        };
        let [k1, k2, k3, k4] = radial;
        let above = [1.0, k1, k2, k3, k4];
        let [k4, k5, k6] = below;
        let below = [1.0, k4, k5, k6];
        // The sign of the derivative of r · above(r²) / below(r²), with the squares of all factors left out.
        let mut growth = [0.0; 8];
        for (i, a) in above.into_iter().enumerate() {
            for (j, b) in below.into_iter().enumerate() {
                growth[i + j] += a * b * (1.0 + 2.0 * (i as f64 - j as f64));
            }
        }
        let pole = first_zero([1.0, k4, k5, k6, 0.0, 0.0, 0.0, 0.0]);
        let limit = first_zero(growth).min(pole);
        Ok(Self {
            bend,
            above,
            below,
            tangential,
            prism,
            limit,
        })
    }

    /// Whether the lens may show directions at any angle from its axis.
    pub(crate) fn bends(&self) -> bool {
        !matches!(self.bend, Bend::None)
    }

    /// Where the point x, y of the plane at depth 1 appears in that plane. Nowhere if the distortion no
    /// longer grows there.
    pub(crate) fn apply(&self, x: f64, y: f64) -> Option<[f64; 2]> {
        let squared = x * x + y * y;
        // Of such a radius, an angle would keep no direction.
        if !squared.is_finite() {
            return None;
        }
        let factor = match self.bend {
            Bend::None => 1.0,
            _ if squared == 0.0 => 1.0,
            Bend::Angle => {
                let radius = square_root(squared);
                libm::atan(radius) / radius
            }
            Bend::Fov { omega, twice } => {
                let radius = square_root(squared);
                libm::atan(radius * twice) / (radius * omega)
            }
        };
        let (x, y) = (x * factor, y * factor);
        let squared = x * x + y * y;
        if squared >= self.limit {
            return None;
        }
        let radial = value(&self.above, squared) / value(&self.below, squared);
        let ([p1, p2], [s1, s2]) = (self.tangential, self.prism);
        let both = 2.0 * x * y;
        Some([
            x * radial + p1 * both + p2 * (squared + 2.0 * x * x) + s1 * squared,
            y * radial + p2 * both + p1 * (squared + 2.0 * y * y) + s2 * squared,
        ])
    }
}

/// A polynomial, by its coefficients from low to high.
fn value(polynomial: &[f64], x: f64) -> f64 {
    polynomial.iter().rev().fold(0.0, |sum, a| sum * x + a)
}

/// The first positive zero of a polynomial that is 1 at 0; infinite if there is none.
fn first_zero(polynomial: [f64; 8]) -> f64 {
    /// No image reaches that far.
    const LARGEST: f64 = 1e30;
    let mut derivatives = [polynomial; 8];
    for order in 1..8 {
        derivatives[order] = [0.0; 8];
        for power in 1..8 {
            derivatives[order][power - 1] = power as f64 * derivatives[order - 1][power];
        }
    }
    // Between the zeros of its derivative, a polynomial is monotone.
    let mut ends = [LARGEST; 8];
    for polynomial in derivatives.iter().rev() {
        let mut zeros = [LARGEST; 8];
        let mut count = 0;
        let mut low = 0.0;
        for end in ends {
            let is_positive = |x: f64| value(polynomial, x) > 0.0;
            if is_positive(low) != is_positive(end) {
                zeros[count] = bisected(low, end, &is_positive);
                count += 1;
            }
            low = end;
        }
        ends = zeros;
    }
    if ends[0] < LARGEST {
        ends[0]
    } else {
        f64::INFINITY
    }
}

/// The least number above `low` at which a sign is another than at `low`, as it is at `high`.
fn bisected(mut low: f64, mut high: f64, is_positive: &dyn Fn(f64) -> bool) -> f64 {
    let first = is_positive(low);
    loop {
        let middle = low + 0.5 * (high - low);
        if middle <= low || middle >= high {
            return high;
        }
        if is_positive(middle) == first {
            low = middle;
        } else {
            high = middle;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The first zero of a polynomial of a lower degree.
    fn first(coefficients: &[f64]) -> f64 {
        let mut all = [0.0; 8];
        all[..coefficients.len()].copy_from_slice(coefficients);
        first_zero(all)
    }

    #[test]
    fn the_first_zero_of_a_cubic_is_found() {
        let is_near = |x: f64, y: f64| (x - y).abs() <= 1e-12 * y;
        assert!(is_near(first(&[1.0, -0.5]), 2.0));
        assert!(is_near(first(&[1.0, -1.25, 0.25]), 1.0));
        // (1 − x)(1 − x/2)(1 − x/3), and one zero only.
        assert!(is_near(first(&[1.0, -11.0 / 6.0, 1.0, -1.0 / 6.0]), 1.0));
        assert!(is_near(first(&[1.0, 1.0, 1.0, -3.0]), 1.0));
        for positive in [
            [1.0, 0.0, 0.0, 0.0],
            [1.0, 3.0, 2.0, 1.0],
            [1.0, -1.0, 1.0, 0.0],
            [1.0, -1.0, 0.5, 0.1],
        ] {
            assert_eq!(first(&positive), f64::INFINITY, "{positive:?}");
        }
    }

    #[test]
    fn the_first_zero_is_found_wherever_the_others_are() {
        for zeros in [
            &[1.2, 1.5][..],
            &[1.2, 1.5, 1.7],
            &[1.2, 1.5, -3.0],
            &[-0.3, -2.0, 40.0],
            &[-0.5, 0.25, 0.26],
            &[0.7],
            &[-1.0, -2.0],
            &[3e4, 4e5, -1.0],
            &[5.0, 4.0, 3.0, 2.0, 1.0, 0.5],
            &[-5.0, 4.0, -3.0, 2.0, -1.0, -0.5, 9.0],
        ] {
            // The product of 1 - x/z over the zeros.
            let mut product = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
            for z in zeros {
                for power in (1..8).rev() {
                    product[power] -= product[power - 1] / z;
                }
            }
            let found = first_zero(product);
            let first = zeros.iter().copied().filter(|z| *z > 0.0);
            let first = first.fold(f64::INFINITY, f64::min);
            assert!(
                found == first || (found / first - 1.0).abs() < 1e-9,
                "{zeros:?}: {found}"
            );
        }
    }
}
