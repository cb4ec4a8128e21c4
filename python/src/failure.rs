//! Refusals as Python exceptions: `HprError`, a `ValueError` with a `code`.

use hidden_point_removal::Error;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

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
