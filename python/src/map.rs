//! A map of directions, which tells the points that are certainly hidden.

use hidden_point_removal as core;
use hidden_point_removal::MapOptions;
use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1, ToPyArray};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::answers::{option, refused, shown};
use crate::arguments::{Points, Positions, camera, place};
use crate::options::{count, number};

/// A map of directions around a viewpoint. It tells which points are certainly hidden: here, or in a shader.
///
/// It never hides a point that `visible_from` shows with the same options, except a few with looks.
#[pyclass(frozen, module = "hidden_point_removal")]
pub struct VisibilityMap {
    map: core::VisibilityMap,
}

impl VisibilityMap {
    pub fn new(map: core::VisibilityMap) -> Self {
        Self { map }
    }
}

/// The viewpoint, the origin, the numbers and the texture of a map.
type Pickled<'py> = ([f64; 3], [f64; 3], [f32; 4], Bound<'py, PyArray1<f32>>);

/// A map of these parts.
#[pyfunction]
#[pyo3(name = "_map")]
pub fn of_parts(
    viewpoint: [f64; 3],
    origin: [f64; 3],
    numbers: [f32; 4],
    data: PyReadonlyArray1<'_, f32>,
) -> VisibilityMap {
    let data = data.as_array().to_vec();
    VisibilityMap::new(core::VisibilityMap::from_parts(
        viewpoint, origin, numbers, data,
    ))
}

#[pymethods]
impl VisibilityMap {
    /// For pickle and copy: what makes the same map again.
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, Pickled<'py>)> {
        let make = py.import("hidden_point_removal._native")?.getattr("_map")?;
        let map = &self.map;
        let data = map.data().to_pyarray(py);
        Ok((make, (map.viewpoint(), map.origin(), map.numbers(), data)))
    }

    /// The viewpoint, in the cloud's coordinates: 3 float.
    #[getter]
    fn viewpoint(&self) -> (f64, f64, f64) {
        self.map.viewpoint().into()
    }

    /// The place that positions in a shader are relative to: 3 float.
    #[getter]
    fn origin(&self) -> (f64, f64, f64) {
        self.map.origin().into()
    }

    /// The shader's texture `hprDepths`: float32, rows of 256 numbers. It is empty where nothing is hidden.
    #[getter]
    fn data<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f32>> {
        self.map.data().to_pyarray(py)
    }

    /// The numbers of the shader: a dict of `hprViewpoint` (3 float, relative to the origin) and `hprMargins` (4 float:
    /// cells a unit, the border of a cell, what 1/z adds to it, and the error of a distance).
    #[getter]
    fn uniforms<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let (place, origin) = (self.map.viewpoint(), self.map.origin());
        let local: [f64; 3] =
            ::core::array::from_fn(|axis| f64::from((place[axis] - origin[axis]) as f32));
        let uniforms = PyDict::new(py);
        uniforms.set_item("hprViewpoint", <(f64, f64, f64)>::from(local))?;
        uniforms.set_item(
            "hprMargins",
            <(f32, f32, f32, f32)>::from(self.map.numbers()),
        )?;
        Ok(uniforms)
    }

    /// Which places are certainly hidden.
    ///
    /// positions: array of float32 or float64, shape (m, 3), in the cloud's coordinates.
    ///
    /// Returns an array of bool, one for each place. One that is not finite is not hidden.
    fn hides<'py>(
        &self,
        py: Python<'py>,
        positions: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyArray1<bool>>> {
        let positions = Positions::read(positions, "positions")?;
        let points = positions.points();
        let hidden: Vec<bool> = py.detach(|| match points {
            Points::Single(points) => (points.iter())
                .map(|p| self.map.hides(p.map(f64::from)))
                .collect(),
            Points::Double(points) => points.iter().map(|&p| self.map.hides(p)).collect(),
        });
        Ok(hidden.into_pyarray(py))
    }
}

/// The size of a map, and its directions. The core checks the ranges.
pub fn choices(
    py: Python<'_>,
    points: Option<&Bound<'_, PyAny>>,
    towards: Option<&Bound<'_, PyAny>>,
    origin: Option<&Bound<'_, PyAny>>,
) -> PyResult<MapOptions> {
    let usual = MapOptions::default().points;
    Ok(MapOptions {
        points: points.map_or(Ok(usual), |given| count(py, "points", given))?,
        towards: towards.map(cone).transpose()?,
        origin: origin.map(|given| place(given, "origin")).transpose()?,
    })
}

fn cone(towards: &Bound<'_, PyAny>) -> PyResult<([f64; 3], f64)> {
    let py = towards.py();
    let wrong = || {
        let given = shown(towards);
        let message =
            format!("towards must be a camera or a dictionary of direction and angle, got {given}");
        option(py, message)
    };
    let entries = towards.cast::<PyDict>().map_err(|_| wrong())?;
    match (entries.get_item("direction")?, entries.get_item("angle")?) {
        (None, None) => camera(towards, "towards")?
            .cone()
            .map_err(|error| refused(py, error)),
        (Some(direction), Some(angle)) if entries.len() == 2 => {
            let angle = number(&angle).ok_or_else(wrong)?;
            Ok((place(&direction, "direction")?, angle))
        }
        _ => Err(wrong()),
    }
}
