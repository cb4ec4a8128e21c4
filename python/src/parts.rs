//! One answer from the answers of parts.

use hidden_point_removal::{Options, merge_visible_u64};
use numpy::{IntoPyArray, PyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arguments::{Points, Positions, ids as read_ids, place};
use crate::options;
use crate::shared::worked;

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
    #[pyo3(from_py_with = options::given)] parts: Vec<(Bound<'py, PyAny>, Bound<'py, PyAny>)>,
    viewpoint: &Bound<'py, PyAny>,
    options: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyArray1<u64>>> {
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
