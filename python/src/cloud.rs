//! The cloud, and what it can be asked.

use hidden_point_removal as core;
use hidden_point_removal::{Lighting, NonFinite, Options, Placing};
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::{Points, Positions, indices, numbers, place, places};
use crate::camera;
use crate::failure::{option, refused};
use crate::options::{self, Asked};
use crate::placement::Placement;
use crate::shared::Shared;
use crate::visibility::Visibility;

/// A point cloud, prepared for visibility queries.
#[pyclass(frozen, module = "hidden_point_removal")]
pub struct PointCloud {
    cloud: Shared<core::PointCloud>,
}

impl PointCloud {
    /// Asks the core, or the part of the cloud that a mask leaves. Other Python threads run meanwhile.
    fn ask<T: Send>(
        &self,
        py: Python<'_>,
        mask: Option<Vec<bool>>,
        query: impl Send + FnOnce(&core::PointCloud) -> Result<T, core::Error>,
    ) -> PyResult<T> {
        self.cloud.ask(py, |cloud| match mask {
            Some(mask) => query(&cloud.masked(&mask)?),
            None => query(cloud),
        })
    }

    fn view(
        &self,
        py: Python<'_>,
        given: Option<&Bound<'_, PyDict>>,
        query: impl Send + FnOnce(&core::PointCloud, &Options) -> Result<core::Visibility, core::Error>,
    ) -> PyResult<Visibility> {
        let Asked { options, mask } = options::read(py, given)?;
        let seen = self.ask(py, mask, |cloud| query(cloud, &options))?;
        Ok(Visibility::new(py, seen))
    }
}

#[pymethods]
impl PointCloud {
    #[new]
    #[pyo3(signature = (positions, non_finite="error"))]
    fn new(py: Python<'_>, positions: &Bound<'_, PyAny>, non_finite: &str) -> PyResult<Self> {
        let choice = match non_finite {
            "error" => NonFinite::Error,
            "skip" => NonFinite::Skip,
            other => {
                let message = format!(r#"non_finite must be "error" or "skip", got {other:?}"#);
                return Err(option(py, message));
            }
        };
        let positions = Positions::read(positions, "positions")?;
        let points = positions.points();
        let made = py.detach(|| match points {
            Points::Single(points) => core::PointCloud::with_non_finite(points, choice),
            Points::Double(points) => core::PointCloud::with_non_finite(points, choice),
        });
        let cloud = made.map_err(|error| refused(py, error))?;
        Ok(Self {
            cloud: Shared::new(cloud),
        })
    }

    fn __len__(&self, py: Python<'_>) -> PyResult<usize> {
        self.cloud.get(py, core::PointCloud::len)
    }

    #[getter]
    fn skipped(&self, py: Python<'_>) -> PyResult<usize> {
        self.cloud.get(py, core::PointCloud::skipped)
    }

    #[getter]
    fn spacing(&self, py: Python<'_>) -> PyResult<f64> {
        self.cloud.get(py, core::PointCloud::spacing)
    }

    #[getter]
    fn noise(&self, py: Python<'_>) -> PyResult<f64> {
        self.cloud.ask(py, core::PointCloud::noise)
    }

    #[pyo3(signature = (viewpoint, **options))]
    fn visible_from(
        &self,
        py: Python<'_>,
        viewpoint: &Bound<'_, PyAny>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Visibility> {
        let viewpoint = place(viewpoint, "viewpoint")?;
        self.view(py, options, |cloud, options| {
            cloud.visible_from(viewpoint, options)
        })
    }

    #[pyo3(signature = (direction, **options))]
    fn visible_from_direction(
        &self,
        py: Python<'_>,
        direction: &Bound<'_, PyAny>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Visibility> {
        let direction = place(direction, "direction")?;
        self.view(py, options, |cloud, options| {
            cloud.visible_from_direction(direction, options)
        })
    }

    #[pyo3(signature = (viewpoints, **options))]
    fn visible_from_any(
        &self,
        py: Python<'_>,
        viewpoints: &Bound<'_, PyAny>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Visibility> {
        let viewpoints = places(viewpoints, "viewpoints")?;
        self.view(py, options, |cloud, options| {
            cloud.visible_from_any(&viewpoints, options)
        })
    }

    #[pyo3(signature = (k, viewpoints, **options))]
    fn visible_from_at_least(
        &self,
        py: Python<'_>,
        k: &Bound<'_, PyAny>,
        viewpoints: &Bound<'_, PyAny>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Visibility> {
        let k = options::count(py, "k", k)?;
        let viewpoints = places(viewpoints, "viewpoints")?;
        self.view(py, options, |cloud, options| {
            cloud.visible_from_at_least(k, &viewpoints, options)
        })
    }

    #[pyo3(signature = (camera, **options))]
    fn visible_from_camera(
        &self,
        py: Python<'_>,
        camera: &Bound<'_, PyAny>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Visibility> {
        let camera = camera::read(py, camera)?;
        let Asked { options, mask } = options::read(py, options)?;
        let view = self.ask(py, mask, |cloud| {
            cloud.visible_from_camera(&camera, &options)
        })?;
        Visibility::of_camera(py, view)
    }

    #[pyo3(signature = (viewpoint, positions, **options))]
    fn sees<'py>(
        &self,
        py: Python<'py>,
        viewpoint: &Bound<'_, PyAny>,
        positions: &Bound<'_, PyAny>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Bound<'py, PyArray1<bool>>> {
        let viewpoint = place(viewpoint, "viewpoint")?;
        let Asked { options, mask } = options::read(py, options)?;
        let positions = Positions::read(positions, "positions")?;
        let points = positions.points();
        let seen = self.ask(py, mask, |cloud| match points {
            Points::Single(points) => cloud.sees(viewpoint, points, &options),
            Points::Double(points) => cloud.sees(viewpoint, points, &options),
        })?;
        Ok(seen.into_pyarray(py))
    }

    #[pyo3(signature = (viewpoints, **options))]
    fn coverage<'py>(
        &self,
        py: Python<'py>,
        viewpoints: &Bound<'_, PyAny>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Bound<'py, PyArray1<u32>>> {
        let viewpoints = places(viewpoints, "viewpoints")?;
        let Asked { options, mask } = options::read(py, options)?;
        let counts = self.ask(py, mask, |cloud| cloud.coverage(&viewpoints, &options))?;
        Ok(counts.into_pyarray(py))
    }

    #[pyo3(signature = (candidates, count=None, share=None, weights=None, **options))]
    fn place_viewpoints(
        &self,
        py: Python<'_>,
        candidates: &Bound<'_, PyAny>,
        count: Option<&Bound<'_, PyAny>>,
        share: Option<&Bound<'_, PyAny>>,
        weights: Option<&Bound<'_, PyAny>>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Placement> {
        let candidates = places(candidates, "candidates")?;
        let Asked { options, mask } = options::read(py, options)?;
        let weights = weights.map(|given| numbers(given, "weights")).transpose()?;
        let wrong = || option(py, "share must be a number".into());
        let placing = Placing {
            count: count
                .map(|given| options::count(py, "count", given))
                .transpose()?,
            share: share
                .map(|given| options::number(given).ok_or_else(wrong))
                .transpose()?,
            weights: weights.as_deref(),
        };
        let placed = self.ask(py, mask, |cloud| {
            cloud.place_viewpoints(&candidates, &options, &placing)
        })?;
        Ok(Placement::new(py, placed))
    }

    #[pyo3(signature = (viewpoint, rule="auto"))]
    fn auto_radius(
        &self,
        py: Python<'_>,
        viewpoint: &Bound<'_, PyAny>,
        rule: &str,
    ) -> PyResult<(f64, f64, u32)> {
        let viewpoint = place(viewpoint, "viewpoint")?;
        let word = rule.into_pyobject(py)?.into_any();
        let rule = options::radius(py, "radius", &word)?;
        let chosen = self.ask(py, None, |cloud| cloud.auto_radius(viewpoint, rule))?;
        Ok((chosen.radius, chosen.exponent, chosen.evaluations))
    }

    #[pyo3(signature = (viewpoint, max_edge=None, **options))]
    fn reconstruct<'py>(
        &self,
        py: Python<'py>,
        viewpoint: &Bound<'_, PyAny>,
        max_edge: Option<f64>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<(Visibility, Bound<'py, PyArray2<u32>>)> {
        let viewpoint = place(viewpoint, "viewpoint")?;
        let Asked { options, mask } = options::read(py, options)?;
        let made = self.ask(py, mask, |cloud| {
            cloud.reconstruct(viewpoint, &options, max_edge)
        })?;
        let count = made.triangles.len();
        let triangles = made.triangles.into_flattened().into_pyarray(py);
        Ok((
            Visibility::new(py, made.visibility),
            triangles.reshape([count, 3])?,
        ))
    }

    #[pyo3(signature = (lights, triangles=None, smoothing=1, ambient=0.0, **options))]
    fn illuminate<'py>(
        &self,
        py: Python<'py>,
        lights: &Bound<'_, PyAny>,
        triangles: Option<&Bound<'_, PyAny>>,
        smoothing: usize,
        ambient: f64,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Bound<'py, PyArray1<f32>>> {
        let lights = places(lights, "lights")?;
        let Asked { options, mask } = options::read(py, options)?;
        let corners = triangles
            .map(|given| corners(given, self.__len__(py)?))
            .transpose()?;
        let lighting = Lighting {
            triangles: corners.as_deref(),
            smoothing,
            ambient,
        };
        let brightness = self.ask(py, mask, |cloud| {
            cloud.illuminate(&lights, &options, &lighting)
        })?;
        Ok(brightness.into_pyarray(py))
    }

    fn append(&self, py: Python<'_>, positions: &Bound<'_, PyAny>) -> PyResult<()> {
        let positions = Positions::read(positions, "positions")?;
        let points = positions.points();
        self.cloud.change(py, |cloud| match points {
            Points::Single(points) => cloud.append(points),
            Points::Double(points) => cloud.append(points),
        })
    }

    fn remove(&self, py: Python<'_>, indices_: &Bound<'_, PyAny>) -> PyResult<()> {
        let removed = indices(indices_, "indices")?;
        self.cloud.change(py, |cloud| cloud.remove(&removed))
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        Ok(format!("PointCloud({} points)", self.__len__(py)?))
    }
}

/// Corners of triangles, checked to be points of the cloud.
fn corners(given: &Bound<'_, PyAny>, points: usize) -> PyResult<Vec<[u32; 3]>> {
    let py = given.py();
    let wrong = || {
        option(
            py,
            format!("triangles must be an (n, 3) array of indices below {points}"),
        )
    };
    let array = py
        .import("numpy")?
        .call_method1("ascontiguousarray", (given,))?;
    let kind: String = array.getattr("dtype")?.getattr("kind")?.extract()?;
    let shape: Vec<usize> = array.getattr("shape")?.extract()?;
    if !["i", "u"].contains(&kind.as_str()) || shape.len() != 2 || shape[1] != 3 {
        return Err(wrong());
    }
    let wide = array.call_method1("astype", ("int64",))?;
    let wide: PyReadonlyArray2<'_, i64> = wide.extract()?;
    let in_range = |corner: &i64| (0..points as i64).contains(corner);
    let flat = wide.as_slice().map_err(|_| wrong())?;
    if !flat.iter().all(in_range) {
        return Err(wrong());
    }
    Ok(flat
        .chunks_exact(3)
        .map(|row| [row[0] as u32, row[1] as u32, row[2] as u32])
        .collect())
}
