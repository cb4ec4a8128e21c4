//! Clouds in parts: the hull of a part, which screens the rest, and one answer from those of the parts.

use hidden_point_removal as core;
use hidden_point_removal::{Options, Radius, merge_visible_u64};
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::answers::{problem, refused, shown_inversion};
use crate::arguments::{Points, Positions, ids as read_ids, place};
use crate::options;
use crate::shared::{Shared, worked};

/// The hull of some points of a cloud, as seen from one viewpoint. What it hides is hidden in the whole cloud.
///
/// viewpoint: 3 numbers, in the cloud's units.
/// radius: float, R of the flipping sphere for the whole cloud.
/// inversion: instead, {"power": float} or {"exponential": float}.
#[pyclass(frozen, module = "hidden_point_removal")]
pub struct Horizon {
    horizon: Shared<core::Horizon>,
    viewpoint: [f64; 3],
    options: Options,
}

/// What pickle makes a horizon of: the viewpoint, and the options.
type Arguments<'py> = (([f64; 3],), Bound<'py, PyDict>);

#[pymethods]
impl Horizon {
    #[new]
    #[pyo3(signature = (viewpoint, **options), text_signature = "(viewpoint, *, radius=None, inversion=None)")]
    fn new(
        py: Python<'_>,
        viewpoint: &Bound<'_, PyAny>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let viewpoint = place(viewpoint, "viewpoint")?;
        let options = options::read_without_cloud(py, options)?;
        let horizon =
            core::Horizon::new(viewpoint, &options).map_err(|error| refused(py, error))?;
        Ok(Self {
            horizon: Shared::new(horizon),
            viewpoint,
            options,
        })
    }

    /// For pickle and copy: the arguments of a new horizon. Its state is the points that hide the others.
    fn __getnewargs_ex__<'py>(&self, py: Python<'py>) -> PyResult<Arguments<'py>> {
        let options = PyDict::new(py);
        if let Radius::Absolute(radius) = self.options.radius {
            options.set_item("radius", radius)?;
        }
        options.set_item("inversion", shown_inversion(py, &self.options.inversion)?)?;
        Ok(((self.viewpoint,), options))
    }

    fn __getstate__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.visible(py)
    }

    fn __setstate__(&self, py: Python<'_>, points: &Bound<'_, PyAny>) -> PyResult<()> {
        self.add(py, points)
    }

    /// Adds points.
    ///
    /// positions: array of float32 or float64, shape (m, 3).
    fn add(&self, py: Python<'_>, positions: &Bound<'_, PyAny>) -> PyResult<()> {
        let positions = Positions::read(positions, "positions")?;
        let points = positions.points();
        self.horizon
            .change(py, points.len(), |horizon| match points {
                Points::Single(points) => horizon.add(points),
                Points::Double(points) => horizon.add(points),
            })
    }

    /// The points that the horizon does not hide.
    ///
    /// positions: array of float32 or float64, shape (m, 3).
    ///
    /// Returns their numbers, ascending: uint32.
    fn screen<'py>(
        &self,
        py: Python<'py>,
        positions: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyArray1<u32>>> {
        let positions = Positions::read(positions, "positions")?;
        let points = positions.points();
        let left = self.horizon.ask(py, points.len(), |horizon| match points {
            Points::Single(points) => horizon.screen(points),
            Points::Double(points) => horizon.screen(points),
        })?;
        Ok(left.into_pyarray(py))
    }

    /// Whether every point in a box is certainly hidden: bool.
    ///
    /// min, max: 3 numbers each, the lowest and the highest coordinates.
    fn hides_box(
        &self,
        py: Python<'_>,
        min: &Bound<'_, PyAny>,
        max: &Bound<'_, PyAny>,
    ) -> PyResult<bool> {
        let corner = |argument, name| {
            place(argument, name)
                .map_err(|error| problem(py, "option", error.value(py).to_string()))
        };
        let (min, max) = (corner(min, "min")?, corner(max, "max")?);
        self.horizon
            .ask(py, 0, |horizon| horizon.hides_box(min, max))
    }

    /// The points that were added and are visible among them: float64, shape (m, 3).
    fn visible<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let points = self.horizon.ask(py, 0, core::Horizon::visible)?;
        let count = points.len();
        points.into_flattened().into_pyarray(py).reshape([count, 3])
    }
}

/// The ids of the points that are visible in a whole cloud. Exact: visible(A + B) = visible(visible(A) + visible(B)).
///
/// parts: list of (positions, ids), the visible points of each part: an array of shape (m, 3), and m int that are
///     less than 2**64.
/// viewpoint: 3 numbers.
/// radius: float, R of the flipping sphere for the whole cloud.
/// inversion: instead, {"power": float} or {"exponential": float}.
///
/// Returns an array of uint64, ascending.
#[pyfunction]
#[pyo3(
    signature = (parts, viewpoint, **options),
    text_signature = "(parts, viewpoint, *, radius=None, inversion=None)"
)]
pub fn merge_visible<'py>(
    py: Python<'py>,
    parts: &Bound<'py, PyAny>,
    viewpoint: &Bound<'py, PyAny>,
    options: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyArray1<u64>>> {
    let wanted = ("parts", "a list of (positions, ids)");
    let parts: Vec<(Bound<'py, PyAny>, Bound<'py, PyAny>)> =
        options::named(Some(parts), wanted, Vec::new())?;
    let viewpoint = place(viewpoint, "viewpoint")?;
    let options = options::read_without_cloud(py, options)?;
    let mut positions = Vec::with_capacity(parts.len());
    let mut ids = Vec::with_capacity(parts.len());
    for (number, (own, numbers)) in parts.iter().enumerate() {
        positions.push(Positions::read(own, &format!("parts[{number}]"))?);
        ids.push(read_ids(numbers, &format!("the ids of parts[{number}]"))?);
    }
    let points: Vec<Points<'_>> = positions.iter().map(Positions::points).collect();
    let count = points.iter().map(Points::len).sum();
    let merged = worked(py, count, || merge(&points, &ids, viewpoint, &options))?;
    Ok(merged.into_pyarray(py))
}

fn merge(
    points: &[Points<'_>],
    ids: &[Vec<u64>],
    viewpoint: [f64; 3],
    options: &Options,
) -> Result<Vec<u64>, hidden_point_removal::Error> {
    type Part<'a, T> = (&'a [[T; 3]], &'a [u64]);
    let singles: Option<Vec<Part<'_, f32>>> = points
        .iter()
        .zip(ids)
        .map(|(points, ids)| match *points {
            Points::Single(points) => Some((points, &ids[..])),
            Points::Double(_) => None,
        })
        .collect();
    if let Some(parts) = singles {
        return merge_visible_u64(&parts, viewpoint, options);
    }
    // A part in double precision makes all of them double.
    let wide: Vec<Vec<[f64; 3]>> = points.iter().map(Points::widened).collect();
    let parts: Vec<Part<'_, f64>> = wide
        .iter()
        .zip(ids)
        .map(|(points, ids)| (&points[..], &ids[..]))
        .collect();
    merge_visible_u64(&parts, viewpoint, options)
}
