//! An answer.

use hidden_point_removal as core;
use hidden_point_removal::{Exponential, Inversion};
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

use crate::failure::option;
use crate::options;

const INVERTED: &std::ffi::CStr = c"next to no points are in this image, but many are in that of the inverse pose: is it camera_to_world or world_to_camera?";

/// Which points are visible.
#[pyclass(frozen, module = "hidden_point_removal")]
pub struct Visibility {
    /// The indices of the visible points, ascending: uint32.
    #[pyo3(get)]
    indices: Py<PyArray1<u32>>,
    /// A score from 0 to 1 for each index: float32. None unless it was asked for.
    #[pyo3(get)]
    scores: Option<Py<PyArray1<f32>>>,
    /// R of the flipping sphere; 0 where the inversion has none.
    #[pyo3(get)]
    radius: f64,
    /// log10(R / farthest distance); 0 where the inversion has none.
    #[pyo3(get)]
    exponent: f64,
    /// How many hulls the choice of R took.
    #[pyo3(get)]
    evaluations: u32,
    /// False only for drafts and samples.
    #[pyo3(get)]
    exact: bool,
    /// Where each visible point is in the camera's image, x and y: (count, 2), float32. None without a camera.
    #[pyo3(get)]
    pixels: Option<Py<PyArray2<f32>>>,
    /// The depth of each visible point along the optical axis: float32. None without a camera.
    #[pyo3(get)]
    depths: Option<Py<PyArray1<f32>>>,
    inversion: Inversion,
    looks: Vec<f64>,
    mask: Vec<u8>,
}

impl Visibility {
    pub fn new(py: Python<'_>, seen: core::Visibility) -> Self {
        let scores = seen.scores();
        let scores = (!scores.is_empty()).then(|| scores.to_vec().into_pyarray(py).unbind());
        Self {
            scores,
            radius: seen.radius(),
            exponent: seen.exponent(),
            evaluations: seen.evaluations(),
            exact: seen.exact(),
            inversion: seen.inversion(),
            looks: seen.looks().to_vec(),
            mask: seen.mask(),
            indices: seen.into_indices().into_pyarray(py).unbind(),
            pixels: None,
            depths: None,
        }
    }

    pub fn of_camera(py: Python<'_>, view: core::CameraView) -> PyResult<Self> {
        warn_if_inverted(py, view.seems_inverted)?;
        let count = view.pixels.len();
        let pixels = view.pixels.into_flattened().into_pyarray(py);
        Ok(Self {
            pixels: Some(pixels.reshape([count, 2])?.unbind()),
            depths: Some(view.depths.into_pyarray(py).unbind()),
            ..Self::new(py, view.visibility)
        })
    }
}

/// Warns if the pose of a camera was probably given the wrong way round.
pub fn warn_if_inverted(py: Python<'_>, seems_inverted: bool) -> PyResult<()> {
    if seems_inverted {
        let category = py.get_type::<pyo3::exceptions::PyUserWarning>();
        PyErr::warn(py, &category, INVERTED, 1)?;
    }
    Ok(())
}

#[pymethods]
#[expect(clippy::too_many_arguments, reason = "they are the fields")]
impl Visibility {
    /// How many points are visible.
    #[getter]
    fn count(&self, py: Python<'_>) -> PyResult<usize> {
        self.indices.bind(py).len()
    }

    /// The inversion that was used, with numbers only.
    #[getter]
    fn inversion<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let named = |name: &str, value: Bound<'py, PyAny>| {
            let entries = PyDict::new(py);
            entries.set_item(name, value)?;
            Ok(entries.into_any())
        };
        match self.inversion {
            Inversion::Power(power) => named("power", power.into_pyobject(py)?.into_any()),
            Inversion::Exponential(Exponential::Scale(scale)) => {
                named("exponential", scale.into_pyobject(py)?.into_any())
            }
            Inversion::Looks(_) => named("looks", self.looks.clone().into_pyobject(py)?),
            _ => Ok("spherical".into_pyobject(py)?.into_any()),
        }
    }

    /// One truth value for each index: True where the point is visible.
    fn mask<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<bool>> {
        let mask: Vec<bool> = self.mask.iter().map(|&byte| byte == 1).collect();
        mask.into_pyarray(py)
    }

    /// For pickle and copy.
    fn __reduce__<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let state = (
            &self.indices,
            &self.scores,
            (self.radius, self.exponent, self.evaluations, self.exact),
            &self.pixels,
            &self.depths,
            self.inversion(py)?,
            self.mask.len(),
        );
        let answers = py.import("hidden_point_removal.answers")?;
        Ok((answers.getattr("restored")?, state.into_pyobject(py)?))
    }

    #[staticmethod]
    fn _restored(
        py: Python<'_>,
        indices: Py<PyArray1<u32>>,
        scores: Option<Py<PyArray1<f32>>>,
        numbers: (f64, f64, u32, bool),
        pixels: Option<Py<PyArray2<f32>>>,
        depths: Option<Py<PyArray1<f32>>>,
        inversion: &Bound<'_, PyAny>,
        length: usize,
    ) -> PyResult<Self> {
        let (radius, exponent, evaluations, exact) = numbers;
        let looks: Vec<f64> = match inversion.cast::<PyDict>() {
            Ok(entries) => {
                (entries.get_item("looks")?).map_or(Ok(Vec::new()), |looks| looks.extract())?
            }
            Err(_) => Vec::new(),
        };
        let inversion = if looks.is_empty() {
            options::inversion(py, inversion)?
        } else {
            Inversion::Looks(looks.len())
        };
        let mut mask = vec![0; length];
        for &index in indices.bind(py).readonly().as_array() {
            let marked = mask.get_mut(index as usize);
            *marked.ok_or_else(|| option(py, format!("index {index} must be below {length}")))? = 1;
        }
        Ok(Self {
            indices,
            scores,
            radius,
            exponent,
            evaluations,
            exact,
            pixels,
            depths,
            inversion,
            looks,
            mask,
        })
    }

    fn __len__(&self, py: Python<'_>) -> PyResult<usize> {
        self.count(py)
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let (count, all) = (self.count(py)?, self.mask.len());
        Ok(format!(
            "Visibility({count} of {all} points, radius={})",
            self.radius
        ))
    }
}
