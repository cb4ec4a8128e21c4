//! Keyword arguments as options of a view.

use hidden_point_removal::{Exponential, Inversion, Options, Radius, Surface, Within};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict};

use crate::answers::{option, shown};
use crate::arguments::{corners, mask};

const NAMES: [&str; 9] = [
    "radius",
    "exponent",
    "inversion",
    "looks",
    "scores",
    "thickness",
    "surface",
    "within",
    "threads",
];

/// The signature of a question that takes the options of a view, in the form in which Python reads it from a docstring.
/// Inside, the options are one dictionary, so that an unknown one is refused as any bad input is.
macro_rules! asks {
    ($head:literal) => {
        concat!(
            $head,
            ", radius=None, exponent=None, inversion=None, looks=None, scores=False, thickness=None, surface=None, within=None, ",
            "threads=None)\n--\n"
        )
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
    /// How many threads compute. Without a number, the cloud's size decides.
    pub threads: Option<usize>,
    /// How many places are asked about, beside the first.
    pub more: usize,
}

/// Reads the options of a question that is not to one cloud. The core refuses a choice of points there.
pub fn read_without_cloud(py: Python<'_>, given: Option<&Bound<'_, PyDict>>) -> PyResult<Options> {
    let Asked { mut options, how } = read(py, given)?;
    if how.mask.is_some() {
        options.within.get_or_insert_default();
    }
    if how.threads.is_some() {
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
    let mut has_radius = false;
    let mut has_inversion = false;
    for (name, value) in given.iter() {
        let name: String = name.extract()?;
        if !NAMES.contains(&name.as_str()) {
            let known = NAMES.join(", ");
            return Err(option(
                py,
                format!("unknown option {name}; the options are {known}"),
            ));
        }
        if value.is_none() {
            continue;
        }
        match name.as_str() {
            "radius" | "exponent" => {
                if std::mem::replace(&mut has_radius, true) {
                    return Err(option(py, "radius and exponent exclude each other".into()));
                }
                options.radius = radius(py, &name, &value)?;
            }
            "inversion" | "looks" => {
                if std::mem::replace(&mut has_inversion, true) {
                    return Err(option(py, "inversion and looks exclude each other".into()));
                }
                options.inversion = if name == "looks" {
                    Inversion::Looks(count(py, &name, &value)?)
                } else {
                    inversion(py, &value)?
                };
            }
            "thickness" => options.thickness = thickness(py, &value)?,
            "surface" => options.surface = surface(py, &value)?,
            "within" => how.mask = within(py, &value, options)?,
            "threads" => how.threads = Some(count(py, &name, &value)?),
            _ => options.scores = truth(py, &name, &value)?,
        }
    }
    Ok(asked)
}

/// Refuses what a question about several cameras cannot answer.
pub fn refuse_scores(py: Python<'_>, options: &Options, name: &str) -> PyResult<()> {
    if options.scores {
        return Err(option(py, format!("scores cannot be combined with {name}")));
    }
    Ok(())
}

/// Reads an argument of a type that pyo3 knows. Another type is refused as any bad input is.
pub fn given<'py, T: for<'a> FromPyObject<'a, 'py>>(value: &Bound<'py, PyAny>) -> PyResult<T> {
    let refused = |_| {
        option(
            value.py(),
            format!("an argument must not be {}", shown(value)),
        )
    };
    value.extract().map_err(refused)
}

/// Reads a number, or "auto".
fn thickness(py: Python<'_>, value: &Bound<'_, PyAny>) -> PyResult<Option<f64>> {
    if value.extract::<&str>().is_ok_and(|word| word == "auto") {
        return Ok(None);
    }
    let wrong = || {
        format!(
            "thickness must be a number or \"auto\", got {}",
            shown(value)
        )
    };
    number(value).map(Some).ok_or_else(|| option(py, wrong()))
}

/// What the survey of a cloud finds.
pub const SURFACES: [(&str, Surface); 3] = [
    ("clean", Surface::Clean),
    ("noisy", Surface::Noisy),
    ("layered", Surface::Layered),
];

/// Reads the kind of a surface, or "auto".
fn surface(py: Python<'_>, value: &Bound<'_, PyAny>) -> PyResult<Option<Surface>> {
    let word: Option<String> = value.extract().ok();
    let known = SURFACES
        .iter()
        .find(|(name, _)| word.as_deref() == Some(name));
    match known {
        Some(&(_, surface)) => Ok(Some(surface)),
        None if word.as_deref() == Some("auto") => Ok(None),
        None => {
            let given = shown(value);
            let message = format!("surface must be auto, clean, noisy or layered, got {given}");
            Err(option(py, message))
        }
    }
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
        let name: String = name.extract()?;
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

/// A rule for the radius, or a number.
pub fn radius(py: Python<'_>, name: &str, value: &Bound<'_, PyAny>) -> PyResult<Radius> {
    let words = [("auto", Radius::Auto), ("opposite", Radius::Opposite)];
    let wrong = |words| {
        let given = shown(value);
        option(py, format!("{name} must be a number{words}, got {given}"))
    };
    if name == "exponent" {
        return number(value).map(Radius::Exponent).ok_or_else(|| wrong(""));
    }
    let word: Option<String> = value.extract().ok();
    let rule = words
        .iter()
        .find(|(known, _)| word.as_deref() == Some(known));
    rule.map(|(_, rule)| *rule)
        .or_else(|| number(value).map(Radius::Absolute))
        .ok_or_else(|| wrong(r#", "auto" or "opposite""#))
}

/// Reads an inversion.
pub fn inversion(py: Python<'_>, value: &Bound<'_, PyAny>) -> PyResult<Inversion> {
    if value
        .extract::<String>()
        .is_ok_and(|word| word == "spherical")
    {
        return Ok(Inversion::Spherical);
    }
    if let Ok(entries) = value.cast::<PyDict>() {
        if entries.len() == 1 {
            if let Some(power) = entries.get_item("power")?.as_ref().and_then(number) {
                return Ok(Inversion::Power(power));
            }
            if let Some(scale) = entries.get_item("exponential")? {
                if scale.extract::<String>().is_ok_and(|word| word == "auto") {
                    return Ok(Inversion::Exponential(Exponential::Auto));
                }
                if let Some(scale) = number(&scale) {
                    return Ok(Inversion::Exponential(Exponential::Scale(scale)));
                }
            }
        }
    }
    let message = format!(
        r#"inversion must be "spherical", {{"power": number}} or {{"exponential": number or "auto"}}, got {}"#,
        shown(value)
    );
    Err(option(py, message))
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

fn truth(py: Python<'_>, name: &str, value: &Bound<'_, PyAny>) -> PyResult<bool> {
    value.extract().map_err(|_| {
        option(
            py,
            format!("{name} must be True or False, got {}", shown(value)),
        )
    })
}
