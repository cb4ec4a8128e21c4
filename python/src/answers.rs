//! Answers, as `hidden_point_removal._answers` keeps them, and refusals: `HprError`, a `ValueError` with a `code`.

use hidden_point_removal as core;
use hidden_point_removal::{CameraView, Error, Exponential, Inversion};
use numpy::{IntoPyArray, PyArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{IntoPyDict, PyTuple};

const INVERTED: &std::ffi::CStr = c"next to no points are in this image, but many are in that of the inverse pose: is it camera_to_world or world_to_camera?";

/// A class or a function of `hidden_point_removal._answers`.
pub fn python<'py>(py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
    py.import("hidden_point_removal._answers")?.getattr(name)
}

/// Which points are visible.
pub fn answer<'py>(
    cloud: &Bound<'py, PyAny>,
    seen: core::Visibility,
) -> PyResult<Bound<'py, PyAny>> {
    python(cloud.py(), "Visibility")?.call1(fields(cloud, seen)?)
}

/// What a camera sees, and the direction of length 1 from each visible point to it.
pub fn camera_answer<'py>(
    cloud: &Bound<'py, PyAny>,
    view: CameraView,
) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
    let py = cloud.py();
    warn_if_inverted(py, view.seems_inverted)?;
    let count = view.depths.len();
    let pixels = view.pixels.into_flattened().into_pyarray(py);
    let pixels = pixels.reshape([count, 2])?.into_any();
    let depths = view.depths.into_pyarray(py).into_any();
    let towards = view.towards.into_flattened().into_pyarray(py);
    let towards = towards.reshape([count, 3])?.into_any();
    let fields = fields(cloud, view.visibility)?.to_list();
    fields.append(pixels)?;
    fields.append(depths)?;
    let made = python(py, "CameraView")?.call1(fields.to_tuple())?;
    Ok((made, towards))
}

/// The fields of a `Visibility`.
fn fields<'py>(cloud: &Bound<'py, PyAny>, seen: core::Visibility) -> PyResult<Bound<'py, PyTuple>> {
    let py = cloud.py();
    let inversion = match seen.inversion() {
        Inversion::Looks(_) => [("looks", seen.looks())].into_py_dict(py)?.into_any(),
        other => shown_inversion(py, &other)?,
    };
    let scores = seen.scores();
    let scores = (!scores.is_empty()).then(|| scores.to_vec().into_pyarray(py));
    let (radius, exponent, evaluations) = (seen.radius(), seen.exponent(), seen.evaluations());
    let (exact, length) = (seen.exact(), seen.mask().len());
    let indices = seen.into_indices().into_pyarray(py);
    let seen = (
        indices,
        scores,
        radius,
        exponent,
        evaluations,
        exact,
        inversion,
        length,
        cloud,
    );
    seen.into_pyobject(py)
}

/// An inversion as an option, with numbers only.
pub fn shown_inversion<'py>(py: Python<'py>, inversion: &Inversion) -> PyResult<Bound<'py, PyAny>> {
    Ok(match *inversion {
        Inversion::Power(power) => [("power", power)].into_py_dict(py)?.into_any(),
        Inversion::Exponential(Exponential::Scale(scale)) => {
            [("exponential", scale)].into_py_dict(py)?.into_any()
        }
        _ => "spherical".into_pyobject(py)?.into_any(),
    })
}

/// Warns if the pose of a camera was probably given the wrong way round.
pub fn warn_if_inverted(py: Python<'_>, seems_inverted: bool) -> PyResult<()> {
    if seems_inverted {
        let category = py.get_type::<pyo3::exceptions::PyUserWarning>();
        PyErr::warn(py, &category, INVERTED, 1)?;
    }
    Ok(())
}

pyo3::create_exception!(
    hidden_point_removal,
    HprError,
    PyValueError,
    "Bad input. `code` names the kind of problem: positions-length, positions-type, non-finite,\n\
     viewpoint, radius, option, too-large or load."
);

/// An `HprError` with this code.
pub fn problem(py: Python<'_>, code: &str, message: String) -> PyErr {
    let error = HprError::new_err(message);
    match error.value(py).setattr("code", code) {
        Ok(()) => error,
        Err(failed) => failed,
    }
}

/// The refusal of an option.
pub fn option(py: Python<'_>, message: String) -> PyErr {
    problem(py, "option", message)
}

/// A refusal by the core.
pub fn refused(py: Python<'_>, error: Error) -> PyErr {
    problem(py, error.code(), error.to_string())
}

/// A short text of a value, for messages.
pub fn shown(value: &Bound<'_, PyAny>) -> String {
    let text = value
        .repr()
        .map_or_else(|_| "?".into(), |text| text.to_string());
    text.chars().take(60).collect()
}
