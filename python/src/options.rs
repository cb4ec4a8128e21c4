//! Keyword arguments as options of a view.

use hidden_point_removal::{Given, Options, Within};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict};

use crate::answers::{option, shown};
use crate::arguments::{corners, mask};

// Options of a view, from src/options.json.
#[rustfmt::skip]
const OPTIONS: [(&str, &str, &[&str]); 8] = [
    ("radius", r#"a number, "auto" or "opposite""#, &["exponent"]),
    ("exponent", r#"a number"#, &[]),
    ("inversion", r#""spherical", {"power": number} or {"exponential": number or "auto"}"#, &[]),
    ("looks", r#"2 or 3"#, &["radius", "exponent", "inversion"]),
    ("scores", r#"True or False"#, &[]),
    ("thickness", r#"a number or "auto""#, &[]),
    ("surface", r#""auto", "clean", "noisy" or "layered""#, &[]),
    ("within", r#"a dictionary of distance, box and mask"#, &[]),
];

macro_rules! signature {
    () => {
        ", radius=None, exponent=None, inversion=None, looks=None, scores=False, thickness=None, surface=None, within=None"
    };
}

macro_rules! about_options {
    () => {
        r##"radius: a number, "auto" or "opposite". R of the flipping sphere in the cloud's units, or how R is chosen: `"auto"`
    (the default), `"opposite"` (the paper's rule, about 40 hulls).
exponent: a number. R = farthest distance · 10^exponent, instead of `radius`; at least 0.
inversion: "spherical", {"power": number} or {"exponential": number or "auto"}. `"spherical"` (the default);
    `{"power": γ}`, 1 < γ ≤ 16; `{"exponential": c}`, exp(c/d): one c, or `"auto"`, serves every viewpoint.
looks: 2 or 3. 2 or 3 hulls; each decides only the points that it is sure of (docs/LOOKS.md). Excludes the three
    options above.
scores: True or False. With `looks`, for one viewpoint: also an estimate for each index of how likely it is visible.
thickness: a number or "auto". With `looks`: how far behind the surface before it a point may lie and still be seen;
    `"auto"` (the default): by the cloud's noise.
surface: "auto", "clean", "noisy" or "layered". With `looks`: what the cloud is, if `cloud.surface` (`"auto"`, the
    default) finds it wrongly: `"clean"`, `"noisy"`, `"layered"`.
within: a dictionary of distance, box and mask. `{"distance", "box": [min, max], "mask"}`: only these points take
    part, as a cloud of these alone."##
    };
}
// End of options.

/// The signature of a question that takes the options of a view, in the form in which Python reads it from a docstring.
/// Inside, the options are one dictionary, so that an unknown one is refused as any bad input is.
macro_rules! asks {
    ($head:literal) => {
        concat!($head, signature!(), ", threads=None)\n--\n")
    };
}

/// The options of a view.
#[derive(Default)]
pub struct Asked {
    pub options: Options,
    pub how: How,
}

/// How a cloud is asked.
#[derive(Clone, Default)]
pub struct How {
    /// Only these indices take part.
    pub mask: Option<Vec<bool>>,
    /// How many places are asked about, beside the first.
    pub more: usize,
}

/// Reads the options of a question that is not to one cloud. The core refuses a choice of points there.
pub fn read_without_cloud(py: Python<'_>, given: Option<&Bound<'_, PyDict>>) -> PyResult<Options> {
    let Asked { mut options, how } = read(py, given)?;
    if how.mask.is_some() {
        options.within.get_or_insert_default();
    }
    if options.threads > 0 {
        return Err(option(py, "threads needs a PointCloud".into()));
    }
    Ok(options)
}

/// Reads the options of a view. Options that are `None` count as left out.
pub fn read(py: Python<'_>, given: Option<&Bound<'_, PyDict>>) -> PyResult<Asked> {
    let mut asked = Asked::default();
    let Some(given) = given else {
        return Ok(asked);
    };
    let Asked { options, how } = &mut asked;
    let mut found = Vec::new();
    for (name, value) in given.iter() {
        let name: String = name.extract()?;
        let row = OPTIONS.iter().find(|(known, ..)| *known == name);
        if row.is_none() && name != "threads" {
            let known = OPTIONS.map(|(known, ..)| known).join(", ");
            let message = format!("unknown option {name}; the options are {known}, threads");
            return Err(option(py, message));
        }
        if value.is_none() {
            continue;
        }
        match row {
            None => options.threads = count(py, &name, &value)?,
            Some(("within", ..)) => how.mask = within(py, &value, options)?,
            Some((_, values, _)) => {
                if !set(options, &name, &value)? {
                    let given = shown(&value);
                    return Err(option(py, format!("{name} must be {values}, got {given}")));
                }
            }
        }
        found.push(name);
    }
    for (name, _, excludes) in OPTIONS {
        let is_found = |name: &str| found.iter().any(|own| own == name);
        if let Some(other) = excludes
            .iter()
            .find(|other| is_found(name) && is_found(other))
        {
            let message = format!("{name} and {other} exclude each other; give one of the two");
            return Err(option(py, message));
        }
    }
    Ok(asked)
}

/// Hands a value to the core. Returns whether it is one of the option's.
fn set(options: &mut Options, name: &str, value: &Bound<'_, PyAny>) -> PyResult<bool> {
    if let Ok(entries) = value.cast::<PyDict>() {
        let [(key, value)] = &entries.iter().collect::<Vec<_>>()[..] else {
            return Ok(false);
        };
        let key: String = given(key)?;
        let set = |value: Given<'_>| options.set(name, Given::Entry(&key, &value));
        return Ok(with_plain(value, set));
    }
    Ok(with_plain(value, |value| options.set(name, value)))
}

/// Hands on a truth value, a number or a word.
fn with_plain(value: &Bound<'_, PyAny>, set: impl FnOnce(Given<'_>) -> bool) -> bool {
    if let Ok(truth) = value.extract() {
        set(Given::Truth(truth))
    } else if let Some(number) = number(value) {
        set(Given::Number(number))
    } else {
        (value.extract::<String>()).is_ok_and(|word| set(Given::Word(&word)))
    }
}

/// Refuses what a question about several cameras cannot answer.
pub fn refuse_scores(py: Python<'_>, options: &Options, name: &str) -> PyResult<()> {
    if options.scores {
        return Err(option(py, format!("scores cannot be combined with {name}")));
    }
    Ok(())
}

/// Reads an argument of a type that pyo3 knows. Another type is refused as any bad input is.
fn given<'py, T: for<'a> FromPyObject<'a, 'py>>(value: &Bound<'py, PyAny>) -> PyResult<T> {
    let refused = |_| {
        option(
            value.py(),
            format!("an argument must not be {}", shown(value)),
        )
    };
    value.extract().map_err(refused)
}

/// Reads an argument that is a number or a word, by its name. `None` counts as left out; a truth value is neither.
pub fn named<'py, T: for<'a> FromPyObject<'a, 'py>>(
    value: Option<&Bound<'py, PyAny>>,
    (name, wanted): (&str, &str),
    usual: T,
) -> PyResult<T> {
    let Some(value) = value else {
        return Ok(usual);
    };
    let read = (!value.is_instance_of::<PyBool>()).then(|| value.extract().ok());
    read.flatten().ok_or_else(|| {
        let got = shown(value);
        option(value.py(), format!("{name} must be {wanted}, got {got}"))
    })
}

/// Reads a distance and a box into the options. Returns the mask.
fn within(
    py: Python<'_>,
    value: &Bound<'_, PyAny>,
    options: &mut Options,
) -> PyResult<Option<Vec<bool>>> {
    let wrong = |message: String| option(py, format!("within: {message}"));
    let entries = value
        .cast::<PyDict>()
        .map_err(|_| wrong(format!("it must be a dictionary, got {}", shown(value))))?;
    let mut chosen = Within::default();
    let mut chosen_mask = None;
    for (name, value) in entries.iter() {
        if value.is_none() {
            continue;
        }
        let name: String = given(&name)?;
        match name.as_str() {
            "distance" => {
                let distance = number(&value).ok_or_else(|| {
                    wrong(format!("distance must be a number, got {}", shown(&value)))
                })?;
                chosen.distance = Some(distance);
            }
            "box" => {
                chosen.bounds = Some(corners(&value, "within: box")?);
            }
            "mask" => chosen_mask = Some(mask(&value, "within: mask")?),
            _ => {
                return Err(wrong(format!(
                    "unknown entry {name}; the entries are distance, box, mask"
                )));
            }
        }
    }
    if chosen != Within::default() {
        options.within = Some(chosen);
    }
    Ok(chosen_mask)
}

/// A number; a truth value is none.
pub fn number(value: &Bound<'_, PyAny>) -> Option<f64> {
    (!value.is_instance_of::<PyBool>())
        .then(|| value.extract().ok())
        .flatten()
}

/// A number of things, at least 1.
pub fn count(py: Python<'_>, name: &str, value: &Bound<'_, PyAny>) -> PyResult<usize> {
    let number = (!value.is_instance_of::<PyBool>()).then(|| value.extract::<usize>().ok());
    match number.flatten() {
        Some(count) if count > 0 => Ok(count),
        _ => Err(option(
            py,
            format!("{name} must be a positive integer, got {}", shown(value)),
        )),
    }
}
