//! Arguments as the core takes them. `hidden_point_removal._arguments` makes arrays and numbers of whatever is given.

use hidden_point_removal::{Camera, CameraModel, Convention, Pose, Seat};
use numpy::{Element, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::call::PyCallArgs;
use pyo3::prelude::*;

use crate::answers::{option, problem};

/// Positions: (n, 3), row after row in memory.
#[derive(FromPyObject)]
pub enum Positions<'py> {
    Single(PyReadonlyArray2<'py, f32>),
    Double(PyReadonlyArray2<'py, f64>),
}

/// Points of one precision.
#[derive(Clone, Copy)]
pub enum Points<'a> {
    Single(&'a [[f32; 3]]),
    Double(&'a [[f64; 3]]),
}

impl Points<'_> {
    /// The same points in double precision.
    pub fn widened(&self) -> Vec<[f64; 3]> {
        match *self {
            Self::Single(points) => points.iter().map(|p| p.map(f64::from)).collect(),
            Self::Double(points) => points.to_vec(),
        }
    }

    pub fn len(&self) -> usize {
        match self {
            Self::Single(points) => points.len(),
            Self::Double(points) => points.len(),
        }
    }
}

impl<'py> Positions<'py> {
    pub fn read(given: &Bound<'py, PyAny>, name: &str) -> PyResult<Self> {
        read(given, "positions", (given, name))?.extract()
    }

    pub fn points(&self) -> Points<'_> {
        match self {
            Self::Single(array) => Points::Single(rows(array.as_slice().unwrap_or(&[]))),
            Self::Double(array) => Points::Double(rows(array.as_slice().unwrap_or(&[]))),
        }
    }
}

/// Calls a reader of `hidden_point_removal._arguments`.
fn read<'py>(
    given: &Bound<'py, PyAny>,
    reader: &str,
    arguments: impl PyCallArgs<'py>,
) -> PyResult<Bound<'py, PyAny>> {
    let module = given.py().import("hidden_point_removal._arguments")?;
    module.getattr(reader)?.call1(arguments)
}

/// Each three numbers as a row.
fn rows<T: bytemuck::Pod>(numbers: &[T]) -> &[[T; 3]] {
    bytemuck::cast_slice(numbers)
}

fn listed<T: Element + Copy>(array: &Bound<'_, PyAny>) -> PyResult<Vec<T>> {
    let array: PyReadonlyArray1<'_, T> = array.extract()?;
    Ok(array.as_array().to_vec())
}

/// Three finite numbers.
pub fn place(given: &Bound<'_, PyAny>, name: &str) -> PyResult<[f64; 3]> {
    let place: (f64, f64, f64) = read(given, "place", (given, name))?.extract()?;
    Ok(place.into())
}

/// Several places.
pub fn places(given: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<[f64; 3]>> {
    let entries: Vec<Bound<'_, PyAny>> = read(given, "listed", (given, name))?.extract()?;
    (entries.iter().enumerate())
        .map(|(number, entry)| place(entry, &format!("{name}[{number}]")))
        .collect()
}

/// Where scanners stood, and the indices of their points, in a cloud of so many.
pub fn stations(given: &Bound<'_, PyAny>, length: usize) -> PyResult<Vec<([f64; 3], Vec<u32>)>> {
    let read = read(given, "stations", (given, "stations", length))?;
    let entries: Vec<((f64, f64, f64), Bound<'_, PyAny>)> = read.extract()?;
    (entries.into_iter())
        .map(|(place, own)| Ok((place.into(), listed(&own)?)))
        .collect()
}

/// Indices of a cloud of so many, or a mask of them.
pub fn indices(given: &Bound<'_, PyAny>, name: &str, length: usize) -> PyResult<Vec<u32>> {
    listed(&read(given, "indices", (given, name, length))?)
}

/// Truth values.
pub fn mask(given: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<bool>> {
    listed(&read(given, "mask", (given, name))?)
}

/// Real numbers, one after another.
pub fn numbers(given: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<f64>> {
    listed(&read(given, "numbers", (given, name))?)
}

/// The lowest and the highest coordinates.
pub fn corners(given: &Bound<'_, PyAny>, name: &str) -> PyResult<[[f64; 3]; 2]> {
    let array = read(given, "numbers", (given, name, (2, 3)))?;
    array.call_method0("tolist")?.extract()
}

pub fn ids(given: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<u64>> {
    listed(&read(given, "ids", (given, name))?)
}

/// Three indices of a cloud of so many for each triangle.
pub fn triangles(given: &Bound<'_, PyAny>, name: &str, length: usize) -> PyResult<Vec<[u32; 3]>> {
    let array = read(given, "triangles", (given, name, length))?;
    let array: PyReadonlyArray2<'_, u32> = array.extract()?;
    Ok(rows(array.as_slice().unwrap_or(&[])).to_vec())
}

/// Several viewpoints, or cameras in their place.
pub fn seats(given: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<Seat>> {
    let entries: Vec<Bound<'_, PyAny>> = read(given, "seats", (given, name))?.extract()?;
    let seat =
        |(number, entry): (usize, &Bound<'_, PyAny>)| match entry.extract::<(f64, f64, f64)>() {
            Ok(place) => Ok(Seat::Viewpoint(place.into())),
            Err(_) => made_camera(entry, &format!("{name}[{number}]")).map(Seat::Camera),
        };
    entries.iter().enumerate().map(seat).collect()
}

/// Several cameras.
pub fn cameras(given: &Bound<'_, PyAny>) -> PyResult<Vec<Camera>> {
    let entries: Vec<Bound<'_, PyAny>> = read(given, "cameras", (given, "cameras"))?.extract()?;
    (entries.iter().enumerate())
        .map(|(number, entry)| made_camera(entry, &format!("cameras[{number}]")))
        .collect()
}

/// A camera. The core checks its numbers.
pub fn camera(given: &Bound<'_, PyAny>, name: &str) -> PyResult<Camera> {
    made_camera(&read(given, "camera", (given, name))?, name)
}

/// What the reader `camera` gives.
type Fields = (bool, [f64; 16], bool, String, Option<Vec<f64>>, [f64; 8]);

fn made_camera(fields: &Bound<'_, PyAny>, name: &str) -> PyResult<Camera> {
    let py = fields.py();
    let wrong = |message: String| problem(py, "viewpoint", format!("{name}: {message}"));
    let (is_inverse, pose, is_opengl, model, distortion, lens): Fields = fields.extract()?;
    let [fx, fy, cx, cy, width, height, near, far] = lens;
    let mut camera = Camera::new(fx, fy, cx, cy, width, height);
    (camera.near, camera.far) = (near, far);
    camera.pose = if is_inverse {
        Pose::WorldToCamera(pose)
    } else {
        Pose::CameraToWorld(pose)
    };
    if is_opengl {
        camera.convention = Convention::OpenGl;
    }
    let known = CameraModel::ALL
        .into_iter()
        .find(|known| known.name() == model);
    camera.model = known.ok_or_else(|| {
        let names = CameraModel::ALL.map(CameraModel::name).join(", ");
        option(py, format!("{name}: model must be one of {names}"))
    })?;
    if let Some(list) = distortion {
        let count = camera.model.coefficients();
        if list.len() != count && !(camera.model == CameraModel::OpenCv && list.len() == 4) {
            let given = list.len();
            return Err(wrong(format!(
                "distortion must hold {count} numbers for {model}, got {given}"
            )));
        }
        camera.distortion[..list.len()].copy_from_slice(&list);
    }
    camera
        .check()
        .map_err(|refused| wrong(refused.to_string()))?;
    Ok(camera)
}
