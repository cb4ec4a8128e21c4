//! The one error type. Every variant names the value or index that was refused.

use core::fmt::{self, Write};

use crate::base::{FULL, MAX_POINTS};

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
    /// The radius is not finite and positive, or smaller than the distance of the farthest point, so
    /// the sphere would not hold the cloud (paper, eq. 1).
    Radius {
        /// The radius as given.
        radius: f64,
        /// The smallest radius that would be accepted; 0 for one that is not finite and positive.
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
            Self::Radius { .. } | Self::RadiusOverflow { .. } => "radius",
            Self::Parameter { .. }
            | Self::Excludes { .. }
            | Self::OutOfRange { .. }
            | Self::MaskLength { .. }
            | Self::Dimension { .. }
            | Self::IndexOutOfRange { .. }
            | Self::MergeRadius => "option",
            Self::IdsLength { .. } | Self::PositionsLength { .. } => "positions-length",
            Self::TooManyPoints { .. } | Self::OutOfMemory => "too-large",
        }
    }
}

/// What the marks in a message stand for: each `@` for the next word, each `#` for the next number.
pub(crate) struct Message {
    pub text: &'static str,
    pub words: [&'static str; 2],
    pub numbers: [f64; 3],
}

impl Error {
    /// The message, in a form that needs no formatting in the wasm.
    #[inline(never)]
    pub(crate) fn message(&self) -> Message {
        let (mut words, mut numbers) = ([""; 2], [0.0; 3]);
        let text = match *self {
            Self::NonFinite { count, first } => {
                numbers = [count as f64, first as f64, 0.0];
                "# point(s) have a coordinate that is NaN or infinite, the first at index #"
            }
            Self::Viewpoint { viewpoint } => {
                numbers = viewpoint;
                "the viewpoint must be finite, got #, #, #"
            }
            Self::Camera { problem, value } => {
                (words[0], numbers[0]) = (problem, value);
                "the camera's @, got #"
            }
            Self::Direction { direction } => {
                numbers = direction;
                "the direction must be finite and not zero, got #, #, #"
            }
            Self::ViewpointDimension { dimension } => {
                numbers[0] = dimension as f64;
                "the viewpoint must be # finite numbers"
            }
            Self::PositionsLength { len, dimension } => {
                numbers = [len as f64, dimension as f64, 0.0];
                "# coordinates are not a multiple of the dimension, #"
            }
            Self::Dimension { option, dimension } => {
                (words[0], numbers[0]) = (option, dimension as f64);
                "@ needs a cloud of dimension 3, not #"
            }
            Self::Excludes { option, other } => {
                words = [option, other];
                "@ cannot be combined with @"
            }
            Self::MaskLength { given, len } => {
                numbers = [len as f64, given as f64, 0.0];
                "within mask must have one element for each of # indices, got #"
            }
            Self::Radius { radius, farthest } => {
                numbers = [radius, farthest, 0.0];
                if radius > 0.0 && radius.is_finite() {
                    "radius # is smaller than the distance of the farthest point, #"
                } else {
                    "radius must be finite and positive, got #"
                }
            }
            Self::RadiusOverflow { radius, farthest } => {
                numbers = [radius.unwrap_or(farthest), farthest, 0.0];
                match radius {
                    Some(_) => {
                        "radius must be at most 8.98e307, got # (an exponent e makes it # * 10^e)"
                    }
                    None => "the farthest distance (#) exceeds the range of f64",
                }
            }
            Self::Parameter {
                option,
                must_be,
                value,
            } => {
                (words, numbers[0]) = ([option, must_be], value);
                "@ must be @, got #"
            }
            Self::OutOfRange {
                option,
                value,
                least,
                most,
            } => {
                (words[0], numbers) = (option, [least, most, value]);
                "@ must be from # to #, got #"
            }
            Self::TooManyPoints { count } => {
                numbers = [count as f64, MAX_POINTS as f64, 0.0];
                "# points exceed the limit of #"
            }
            // The small module does not merge.
            Self::MergeRadius if !FULL => "",
            Self::MergeRadius => {
                "merging needs the radius, in the cloud's units, or the exponential scale that all parts were seen with"
            }
            Self::IdsLength {
                part,
                positions,
                ids,
            } => {
                numbers = [part as f64, positions as f64, ids as f64];
                "part # has # positions, but # ids"
            }
            Self::IndexOutOfRange { index, len } => {
                numbers = [f64::from(index), len as f64, 0.0];
                "index # is out of range for a cloud of length #"
            }
            Self::OutOfMemory => "not enough memory for this cloud",
        };
        Message {
            text,
            words,
            numbers,
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let message = self.message();
        let (mut words, mut numbers) = (message.words.iter(), message.numbers.iter());
        message.text.chars().try_for_each(|mark| match mark {
            '@' => f.write_str(words.next().unwrap_or(&"")),
            '#' => Number(*numbers.next().unwrap_or(&0.0)).fmt(f),
            other => f.write_char(other),
        })
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

/// Refuses a box of which a minimum is above its maximum, or a coordinate is NaN.
pub(crate) fn check_box([min, max]: [[f64; 3]; 2]) -> Result<(), Error> {
    // This also refuses a NaN.
    let is_right = |axis: usize| min[axis] <= max[axis];
    let wrong = (0..3).find(|&axis| !is_right(axis));
    wrong.map_or(Ok(()), |axis| {
        Err(Error::Parameter {
            option: "a box",
            must_be: "[min, max], where no coordinate of min is above that of max",
            value: min[axis],
        })
    })
}

impl From<alloc::collections::TryReserveError> for Error {
    fn from(_: alloc::collections::TryReserveError) -> Self {
        Self::OutOfMemory
    }
}
