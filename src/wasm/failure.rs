//! An error, as JavaScript receives it. JavaScript words the message
//! (src/ts/instance/failure.ts): the formatting of numbers alone would add 30 kB of wasm.

use wasm_bindgen::JsValue;

use crate::wasm::objects::{list, object};
use crate::{Error, MAX_POINTS};

/// The number does not belong to a cloud, or its cloud was freed.
#[cold]
pub(super) fn disposed() -> JsValue {
    failure(["disposed", "disposed", "", ""], &[0.0; 3])
}

/// A refusal: its code, its problem, and the option and the numbers that its message names. `other`
/// is another option, or what is wanted of this one.
fn failure([code, problem, option, other]: [&str; 4], numbers: &[f64; 3]) -> JsValue {
    object(&[
        ("code", &code.into()),
        ("problem", &problem.into()),
        ("option", &option.into()),
        ("other", &other.into()),
        ("numbers", &list(numbers)),
    ])
}

impl From<Error> for JsValue {
    #[cold]
    #[inline(never)]
    fn from(error: Error) -> Self {
        let (mut named, mut other) = ("", "");
        let (problem, numbers) = match error {
            Error::NonFinite { count, first } => ("nonFinite", [count as f64, first as f64, 0.0]),
            Error::Viewpoint { viewpoint } => ("viewpoint", viewpoint),
            Error::RadiusInvalid { radius } => ("radiusInvalid", [radius, 0.0, 0.0]),
            Error::RadiusTooSmall { radius, farthest } => {
                ("radiusTooSmall", [radius, farthest, 0.0])
            }
            Error::RadiusOverflow {
                radius: Some(radius),
                farthest,
            } => ("radiusOverflow", [radius, farthest, 0.0]),
            Error::RadiusOverflow {
                radius: None,
                farthest,
            } => ("distanceOverflow", [farthest, 0.0, 0.0]),
            Error::Parameter {
                option,
                must_be,
                value,
            } => {
                (named, other) = (option, must_be);
                ("parameter", [value, 0.0, 0.0])
            }
            Error::TooManyPoints { count } => {
                ("tooManyPoints", [count as f64, MAX_POINTS as f64, 0.0])
            }
            Error::MergeRadius => ("mergeRadius", [0.0; 3]),
            Error::IdsLength {
                part,
                positions,
                ids,
            } => ("idsLength", [part as f64, positions as f64, ids as f64]),
            Error::IndexOutOfRange { index, len } => {
                ("indexOutOfRange", [f64::from(index), len as f64, 0.0])
            }
            Error::OutOfMemory => ("outOfMemory", [0.0; 3]),
            Error::OutOfRange {
                option,
                value,
                least,
                most,
            } => {
                named = option;
                ("outOfRange", [least, most, value])
            }
            Error::Excludes {
                option,
                other: with,
            } => {
                (named, other) = (option, with);
                ("excludes", [0.0; 3])
            }
            Error::Camera { problem, value } => {
                named = problem;
                ("camera", [value, 0.0, 0.0])
            }
            Error::BoundsInvalid => ("boundsInvalid", [0.0; 3]),
            Error::MaskLength { given, len } => ("maskLength", [given as f64, len as f64, 0.0]),
            Error::Dimension { option, dimension } => {
                named = option;
                ("dimension", [dimension as f64, 0.0, 0.0])
            }
            Error::Direction { direction } => ("direction", direction),
            Error::ViewpointDimension { dimension } => {
                ("viewpointDimension", [dimension as f64, 0.0, 0.0])
            }
            Error::PositionsLength { len, dimension } => {
                ("positionsLength", [len as f64, dimension as f64, 0.0])
            }
        };
        failure([error.code(), problem, named, other], &numbers)
    }
}
