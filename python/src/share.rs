//! One sector of a cloud in parts.

use hidden_point_removal as core;
use numpy::{IntoPyArray, PyReadonlyArray3};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::{Points, Positions, place};
use crate::failure::{option, refused};
use crate::options;
use crate::visibility::python;

/// Which of the own points of a cloud are visible, where only a part of the cloud is at hand.
///
/// If points are undecided, ask again with them as own points. The other needed points and the points of the missing
/// boxes are then others, and these boxes are left out.
///
/// own, others: arrays of shape (m, 3): the points that are asked about, and points near them.
/// boxes: array of shape (b, 2, 3), the lowest and the highest coordinates of boxes that hold all further points.
/// viewpoint: 3 numbers.
/// radius: float, R of the flipping sphere for the whole cloud.
/// inversion: instead, {"power": float} or {"exponential": float}.
///
/// Returns a `Share`.
#[pyfunction]
#[pyo3(
    signature = (own, others, boxes, viewpoint, **options),
    text_signature = "(own, others, boxes, viewpoint, *, radius=None, inversion=None)"
)]
pub fn share_visible<'py>(
    py: Python<'py>,
    own: &Bound<'_, PyAny>,
    others: &Bound<'_, PyAny>,
    boxes: &Bound<'_, PyAny>,
    viewpoint: &Bound<'_, PyAny>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<Bound<'py, PyAny>> {
    let viewpoint = place(viewpoint, "viewpoint")?;
    let options = options::read_without_cloud(py, options)?;
    let own = Positions::read(own, "own")?;
    let others = Positions::read(others, "others")?;
    let boxes = read_boxes(boxes)?;
    let (own, others) = (own.points(), others.points());
    let share = py.detach(|| match (own, others) {
        (Points::Single(own), Points::Single(others)) => {
            core::share_visible(own, others, &boxes, viewpoint, &options)
        }
        // Points in double precision make all of them double.
        _ => core::share_visible(
            &own.widened(),
            &others.widened(),
            &boxes,
            viewpoint,
            &options,
        ),
    });
    let share = share.map_err(|error| refused(py, error))?;
    let list = |numbers: &[u32]| numbers.to_vec().into_pyarray(py);
    let [visible, undecided] = [share.visible(), share.undecided()].map(list);
    let [needed, missing] = [share.needed(), share.missing()].map(list);
    python(py, "Share")?.call1((visible, undecided, needed, missing))
}

/// Boxes: (n, 2, 3), the least and the largest coordinates of each.
fn read_boxes(argument: &Bound<'_, PyAny>) -> PyResult<Vec<[[f64; 3]; 2]>> {
    let py = argument.py();
    let wrong = |_| option(py, "boxes must be numbers of the shape (n, 2, 3)".into());
    let numpy = py.import("numpy")?;
    let array = numpy
        .call_method1("ascontiguousarray", (argument, "float64"))
        .map_err(wrong)?;
    if array.len()? == 0 {
        return Ok(Vec::new());
    }
    let array: PyReadonlyArray3<'_, f64> = array.extract().map_err(wrong)?;
    let numbers = array.as_slice().map_err(|error| wrong(error.into()))?;
    if array.as_array().shape()[1..] != [2, 3] {
        return Err(option(
            py,
            "boxes must be numbers of the shape (n, 2, 3)".into(),
        ));
    }
    Ok(bytemuck::cast_slice::<f64, [[f64; 3]; 2]>(numbers).to_vec())
}
