//! The one error type. Every variant names the value or index that was refused.

use core::fmt;

/// Why a cloud, a viewpoint or an option was refused.
///
/// [`Error::code`] gives the stable short name that the JavaScript package
/// reports as `HprError.code`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Error {
    /// Some positions hold NaN or an infinity.
    NonFinite {
        /// How many points are affected.
        count: usize,
        /// The lowest index among them, counted in the positions given.
        first: usize,
    },
    /// The viewpoint holds NaN or an infinity.
    Viewpoint {
        /// The viewpoint as given.
        viewpoint: [f64; 3],
    },
    /// A camera has no size, or is not finite, or its pose is not rigid.
    Camera {
        /// What the camera must be.
        problem: &'static str,
        /// The number that is wrong. For a pose that is not rigid, its deviation.
        value: f64,
    },
    /// The direction of a view is zero, or holds NaN or an infinity.
    Direction {
        /// The direction as given.
        direction: [f64; 3],
    },
    /// The viewpoint is of another dimension than the cloud, or not finite.
    ViewpointDimension {
        /// How many finite numbers a viewpoint needs.
        dimension: usize,
    },
    /// The number of coordinates is not a multiple of the dimension.
    PositionsLength {
        /// How many coordinates there are.
        len: usize,
        /// The cloud's dimension.
        dimension: usize,
    },
    /// The option needs three dimensions.
    Dimension {
        /// The option, as the JavaScript package calls it.
        option: &'static str,
        /// The cloud's dimension.
        dimension: usize,
    },
    /// The radius is NaN, infinite, zero or negative.
    RadiusInvalid {
        /// The radius as given.
        radius: f64,
    },
    /// The radius is smaller than the distance of the farthest point, so the
    /// sphere would not hold the cloud (paper, eq. 1).
    RadiusTooSmall {
        /// The radius as given.
        radius: f64,
        /// The smallest radius that would be accepted.
        farthest: f64,
    },
    /// A distance from the viewpoint, or twice the radius, exceeds the range of `f64`.
    RadiusOverflow {
        /// The radius, where the radius is too large rather than a distance.
        radius: Option<f64>,
        /// The farthest distance, infinite where it overflowed.
        farthest: f64,
    },
    /// A number of an option that is not as it must be.
    Parameter {
        /// The option, as the JavaScript package calls it.
        option: &'static str,
        /// What it must be.
        must_be: &'static str,
        /// The number as given.
        value: f64,
    },
    /// Two options exclude each other, or a question has no such option.
    Excludes {
        /// The option, as the JavaScript package calls it.
        option: &'static str,
        /// The other option, or the question.
        other: &'static str,
    },
    /// A box has a minimum above its maximum, or a coordinate that is NaN (or, for a horizon, infinite).
    BoundsInvalid,
    /// A mask does not have one element for each index of the cloud.
    MaskLength {
        /// How many elements it has.
        given: usize,
        /// How many indices the cloud has given out.
        len: usize,
    },
    /// A number is out of its range, or NaN.
    OutOfRange {
        /// The option or argument, as the JavaScript package calls it.
        option: &'static str,
        /// The number as given.
        value: f64,
        /// The smallest accepted number.
        least: f64,
        /// The largest accepted number.
        most: f64,
    },
    /// There are more points than [`MAX_POINTS`](crate::MAX_POINTS).
    TooManyPoints {
        /// How many were given.
        count: usize,
    },
    /// A merge needs the radius with which each part was seen.
    MergeRadius,
    /// A part of a merge has more positions than ids, or fewer.
    IdsLength {
        /// Which of the parts.
        part: usize,
        /// How many positions it has.
        positions: usize,
        /// How many ids it has.
        ids: usize,
    },
    /// No point of the cloud ever had the index that is to be removed.
    IndexOutOfRange {
        /// The index as given.
        index: u32,
        /// How many indices the cloud has given out.
        len: usize,
    },
    /// The allocator refused memory; nothing was changed.
    OutOfMemory,
}

impl Error {
    /// The stable short name of this error.
    #[must_use]
    pub fn code(&self) -> &'static str {
        match self {
            Self::NonFinite { .. } => "non-finite",
            Self::Viewpoint { .. }
            | Self::Camera { .. }
            | Self::ViewpointDimension { .. }
            | Self::Direction { .. } => "viewpoint",
            Self::RadiusInvalid { .. }
            | Self::RadiusTooSmall { .. }
            | Self::RadiusOverflow { .. } => "radius",
            Self::Parameter { .. }
            | Self::Excludes { .. }
            | Self::OutOfRange { .. }
            | Self::BoundsInvalid
            | Self::MaskLength { .. }
            | Self::Dimension { .. }
            | Self::IndexOutOfRange { .. }
            | Self::MergeRadius => "option",
            Self::IdsLength { .. } | Self::PositionsLength { .. } => "positions-length",
            Self::TooManyPoints { .. } | Self::OutOfMemory => "too-large",
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::NonFinite { count, first } => write!(
                f,
                "{count} point(s) have a coordinate that is NaN or infinite, the first at index {first}"
            ),
            Self::Viewpoint {
                viewpoint: [x, y, z],
            } => {
                let (x, y, z) = (Number(x), Number(y), Number(z));
                write!(f, "the viewpoint must be finite, got {x}, {y}, {z}")
            }
            Self::Camera { problem, value } => {
                write!(f, "the camera's {problem}, got {}", Number(value))
            }
            Self::Direction {
                direction: [x, y, z],
            } => {
                let (x, y, z) = (Number(x), Number(y), Number(z));
                write!(
                    f,
                    "the direction must be finite and not zero, got {x}, {y}, {z}"
                )
            }
            Self::ViewpointDimension { dimension } => {
                write!(f, "the viewpoint must be {dimension} finite numbers")
            }
            Self::PositionsLength { len, dimension } => write!(
                f,
                "{len} coordinates are not a multiple of the dimension, {dimension}"
            ),
            Self::Dimension { option, dimension } => {
                write!(f, "{option} needs a cloud of dimension 3, not {dimension}")
            }
            Self::Excludes { option, other } => {
                write!(f, "{option} cannot be combined with {other}")
            }
            Self::BoundsInvalid => write!(
                f,
                "a box must be [min, max], where no coordinate of min is above that of max"
            ),
            Self::MaskLength { given, len } => write!(
                f,
                "within mask must have one element for each of {len} indices, got {given}"
            ),
            Self::RadiusInvalid { radius } => {
                let radius = Number(radius);
                write!(f, "radius must be finite and positive, got {radius}")
            }
            Self::RadiusTooSmall { radius, farthest } => write!(
                f,
                "radius {} is smaller than the distance of the farthest point, {}",
                Number(radius),
                Number(farthest)
            ),
            Self::RadiusOverflow {
                radius: Some(radius),
                farthest,
            } => write!(
                f,
                "radius must be at most 8.98e307, got {} (an exponent e makes it {} * 10^e)",
                Number(radius),
                Number(farthest)
            ),
            Self::RadiusOverflow {
                radius: None,
                farthest,
            } => write!(
                f,
                "the farthest distance ({}) exceeds the range of f64",
                Number(farthest)
            ),
            Self::Parameter {
                option,
                must_be,
                value,
            } => write!(f, "{option} must be {must_be}, got {}", Number(value)),
            Self::OutOfRange {
                option,
                value,
                least,
                most,
            } => {
                let (value, least, most) = (Number(value), Number(least), Number(most));
                write!(f, "{option} must be from {least} to {most}, got {value}")
            }
            Self::TooManyPoints { count } => write!(
                f,
                "{count} points exceed the limit of {}",
                crate::base::limit::MAX_POINTS
            ),
            Self::MergeRadius => write!(
                f,
                "merging needs the radius, in the cloud's units, or the exponential scale that all parts were seen with"
            ),
            Self::IdsLength {
                part,
                positions,
                ids,
            } => write!(f, "part {part} has {positions} positions, but {ids} ids"),
            Self::IndexOutOfRange { index, len } => {
                write!(
                    f,
                    "index {index} is out of range for a cloud of length {len}"
                )
            }
            Self::OutOfMemory => write!(f, "not enough memory for this cloud"),
        }
    }
}

/// A number as people write it: 5 rather than 5.0, ∞ rather than `inf`, and never
/// hundreds of digits.
struct Number(f64);

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(number) = *self;
        let size = number.abs();
        if size.is_infinite() {
            f.write_str(if number > 0.0 {
                "infinity"
            } else {
                "-infinity"
            })
        } else if size == 0.0 || size.is_nan() || (1e-6..1e21).contains(&size) {
            write!(f, "{number}")
        } else {
            write!(f, "{number:e}")
        }
    }
}

impl core::error::Error for Error {}

/// `value` if it is in the range; an error if it is not, or NaN.
#[inline(never)]
pub(crate) fn in_range(
    option: &'static str,
    value: f64,
    least: f64,
    most: f64,
) -> Result<f64, Error> {
    if (least..=most).contains(&value) {
        Ok(value)
    } else {
        Err(Error::OutOfRange {
            option,
            value,
            least,
            most,
        })
    }
}

impl From<alloc::collections::TryReserveError> for Error {
    fn from(_: alloc::collections::TryReserveError) -> Self {
        Self::OutOfMemory
    }
}
