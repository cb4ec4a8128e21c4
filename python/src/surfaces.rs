//! Questions to a cloud about the surface between its points: maps, triangles, light.

use hidden_point_removal::Lighting;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::{kind_of, place, places};
use crate::cloud::PointCloud;
use crate::failure::option;
use crate::map::{self, VisibilityMap};
use crate::options::{self, Asked};
use crate::visibility::answer;

#[pymethods]
impl PointCloud {
    #[doc = asks!("visibility_map($self, viewpoint, *, points=32768, corners=131072, towards=None, origin=None")]
    /// A map of directions, which tells for any number of places whether they are certainly hidden.
    ///
    /// viewpoint: 3 numbers.
    /// points: int, at least 16. So many points has the map's hull at most.
    /// corners: int, from 64 to 4194304. So many directions has the map at most.
    /// towards: a camera, or a dict of direction (3 numbers) and angle (the full opening of a cone, in degrees). Only
    ///     these directions get points and corners.
    /// origin: 3 numbers that positions in a shader are relative to. Default: 0 for float32, else the middle of the
    ///     cloud's box.
    /// Options: those of `visible_from`. Not with scores and "opposite".
    /// Returns a `VisibilityMap`.
    #[pyo3(
        signature = (viewpoint, *, points=None, corners=None, towards=None, origin=None, **options),
        text_signature = None
    )]
    #[expect(clippy::too_many_arguments, reason = "they are keywords in Python")]
    fn visibility_map(
        &self,
        py: Python<'_>,
        viewpoint: &Bound<'_, PyAny>,
        points: Option<&Bound<'_, PyAny>>,
        corners: Option<&Bound<'_, PyAny>>,
        towards: Option<&Bound<'_, PyAny>>,
        origin: Option<&Bound<'_, PyAny>>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<VisibilityMap> {
        let viewpoint = place(viewpoint, "viewpoint")?;
        let choices = map::choices(py, points, corners, towards, origin)?;
        let Asked { options, how } = options::read(py, options)?;
        let made = self.ask(py, how, |cloud| {
            cloud.visibility_map(viewpoint, &options, &choices)
        })?;
        Ok(VisibilityMap::new(made))
    }

    #[doc = asks!("reconstruct($self, viewpoint, max_edge=None, *")]
    /// The visible points, and the triangles between them.
    ///
    /// viewpoint: 3 numbers.
    /// max_edge: float. Triangles with a longer edge are left out. Default 5 spacings.
    /// Options: those of `visible_from`. Not with looks.
    /// Returns (`Visibility`, array of uint32 of shape (m, 3)): three indices for each triangle, counter-clockwise seen
    /// from the viewpoint.
    #[pyo3(signature = (viewpoint, max_edge=None, **options), text_signature = None)]
    fn reconstruct<'py>(
        &self,
        py: Python<'py>,
        viewpoint: &Bound<'_, PyAny>,
        #[pyo3(from_py_with = options::given)] max_edge: Option<f64>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyArray2<u32>>)> {
        let viewpoint = place(viewpoint, "viewpoint")?;
        let Asked { options, how } = options::read(py, options)?;
        let made = self.ask(py, how, |cloud| {
            cloud.reconstruct(viewpoint, &options, max_edge)
        })?;
        let count = made.triangles.len();
        let triangles = made.triangles.into_flattened().into_pyarray(py);
        Ok((answer(py, made.visibility)?, triangles.reshape([count, 3])?))
    }

    #[doc = asks!("illuminate($self, lights, triangles=None, smoothing=1, ambient=0.0, *")]
    /// Light and shadow: ambient + (1 - ambient) * (lights that see a point / lights), then softened.
    ///
    /// lights: list of 3 numbers each, or array of shape (m, 3).
    /// triangles: array of int of shape (t, 3), indices of a mesh to soften over. Default: the 6 nearest points.
    /// smoothing: int, rounds of softening.
    /// ambient: float, from 0 to 1.
    /// Options: those of `visible_from`. Not with looks.
    /// Returns an array of float32, one brightness from 0 to 1 for each index.
    #[pyo3(signature = (lights, triangles=None, smoothing=1, ambient=0.0, **options), text_signature = None)]
    fn illuminate<'py>(
        &self,
        py: Python<'py>,
        lights: &Bound<'_, PyAny>,
        triangles: Option<&Bound<'_, PyAny>>,
        #[pyo3(from_py_with = options::given)] smoothing: usize,
        #[pyo3(from_py_with = options::given)] ambient: f64,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Bound<'py, PyArray1<f32>>> {
        let lights = places(lights, "lights")?;
        let Asked { options, how } = options::read(py, options)?;
        let corners = triangles
            .map(|given| corners(given, self.__len__(py)?))
            .transpose()?;
        let lighting = Lighting {
            triangles: corners.as_deref(),
            smoothing,
            ambient,
        };
        let brightness = self.ask(py, how, |cloud| {
            cloud.illuminate(&lights, &options, &lighting)
        })?;
        Ok(brightness.into_pyarray(py))
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
    let numpy = py.import("numpy")?;
    let array = numpy.call_method1("ascontiguousarray", (given,))?;
    let kind = kind_of(&array)?;
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
