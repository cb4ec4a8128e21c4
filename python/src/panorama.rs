//! What stands in each direction.

use hidden_point_removal as core;
use numpy::{IntoPyArray, PyArray2, PyArrayMethods};
use pyo3::prelude::*;

/// What stands in each direction around a viewpoint. Row 0 is up, column 0 looks along +x.
#[pyclass(frozen, module = "hidden_point_removal")]
pub struct Panorama {
    /// The distance to the surface in each direction; infinity for the sky: float32, (height, width).
    #[pyo3(get)]
    ranges: Py<PyArray2<f32>>,
    /// The visible point that is nearest by angle; 2**32 - 1 for the sky: uint32, (height, width).
    #[pyo3(get)]
    indices: Py<PyArray2<u32>>,
    /// The share of the sky in the upper half of the sphere, weighted by the cosine from up: 0 to 1.
    #[pyo3(get)]
    sky_view_factor: f64,
    /// How much of the sphere is surface, in steradians.
    #[pyo3(get)]
    solid_angle: f64,
}

impl Panorama {
    pub fn new(py: Python<'_>, made: core::Panorama, width: usize) -> PyResult<Self> {
        let shape = [made.ranges.len() / width, width];
        Ok(Self {
            ranges: made.ranges.into_pyarray(py).reshape(shape)?.unbind(),
            indices: made.indices.into_pyarray(py).reshape(shape)?.unbind(),
            sky_view_factor: made.sky_view_factor,
            solid_angle: made.solid_angle,
        })
    }
}
