//! Chosen viewpoints.

use hidden_point_removal as core;
use numpy::{IntoPyArray, PyArray1};
use pyo3::prelude::*;

/// Viewpoints that were chosen among candidates.
#[pyclass(frozen, module = "hidden_point_removal")]
pub struct Placement {
    /// The numbers of the chosen candidates, in the order of their choice.
    #[pyo3(get)]
    chosen: Vec<usize>,
    /// The weight that each of them adds to those before it.
    #[pyo3(get)]
    gains: Vec<f64>,
    /// The indices that at least one chosen viewpoint sees, ascending: uint32.
    #[pyo3(get)]
    seen: Py<PyArray1<u32>>,
    /// The indices that no candidate sees, ascending: uint32.
    #[pyo3(get)]
    unseen: Py<PyArray1<u32>>,
}

impl Placement {
    pub fn new(py: Python<'_>, placed: core::Placement) -> Self {
        Self {
            chosen: placed.chosen,
            gains: placed.gains,
            seen: placed.seen.into_pyarray(py).unbind(),
            unseen: placed.unseen.into_pyarray(py).unbind(),
        }
    }
}
