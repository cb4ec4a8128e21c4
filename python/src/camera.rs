//! A camera as a dictionary.

use hidden_point_removal::{Camera, CameraModel, Convention, Pose, Seat};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::{each, listed, numbers, place};
use crate::failure::{option, problem};
use crate::options::{self, number};

const SHAPES: &str = "exactly one of camera_to_world and world_to_camera must hold 16 numbers: 4 rows as an array of shape (4, 4), or flat, column by column";

/// Several viewpoints, or cameras in their place.
pub fn seats(given: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<Seat>> {
    each(given, name, |entry, name| {
        if entry.is_instance_of::<PyDict>() {
            read(entry, name).map(Seat::Camera)
        } else {
            place(entry, name).map(Seat::Viewpoint)
        }
    })
}

/// Several cameras.
pub fn cameras(given: &Bound<'_, PyAny>) -> PyResult<Vec<Camera>> {
    each(given, "cameras", read)
}

/// Each camera, with its fx, fy, cx, cy, width and height.
#[pyfunction]
#[pyo3(name = "_lenses")]
pub fn lenses<'py>(given: &Bound<'py, PyAny>) -> PyResult<Vec<(Bound<'py, PyAny>, [f64; 6])>> {
    each(given, "cameras", |entry, name| {
        let own = read(entry, name)?;
        let lens = [own.fx, own.fy, own.cx, own.cy, own.width, own.height];
        Ok((entry.clone(), lens))
    })
}

/// Reads a camera. The core checks its numbers.
pub fn read(given: &Bound<'_, PyAny>, whose: &str) -> PyResult<Camera> {
    let py = given.py();
    let wrong = |message: String| problem(py, "viewpoint", format!("{whose}: {message}"));
    let entries = given
        .cast::<PyDict>()
        .map_err(|_| wrong("must be a dictionary".into()))?;
    let mut camera = Camera::new(f64::NAN, f64::NAN, f64::NAN, f64::NAN, 0.0, 0.0);
    let mut poses = 0;
    let mut distortion = None;
    for (name, value) in entries.iter() {
        let name: String = options::given(&name)?;
        let one = || number(&value).ok_or_else(|| wrong(format!("{name} must be a number")));
        match name.as_str() {
            "camera_to_world" | "world_to_camera" if value.is_none() => {}
            "camera_to_world" | "world_to_camera" => {
                let numbers = matrix(&value).ok_or_else(|| wrong(SHAPES.into()))?;
                camera.pose = if name == "camera_to_world" {
                    Pose::CameraToWorld(numbers)
                } else {
                    Pose::WorldToCamera(numbers)
                };
                poses += 1;
            }
            "convention" => {
                camera.convention = match value.extract::<String>().as_deref() {
                    Ok("opencv") => Convention::OpenCv,
                    Ok("opengl") => Convention::OpenGl,
                    _ => return Err(wrong(r#"convention must be "opencv" or "opengl""#.into())),
                };
            }
            "distortion" if value.is_none() => {}
            "distortion" => {
                let list = numbers(&value, &name);
                distortion =
                    Some(list.map_err(|_| wrong("distortion must be a list of numbers".into()))?);
            }
            "model" if value.is_none() => {}
            "model" => {
                let given: Option<String> = value.extract().ok();
                let names = CameraModel::ALL.map(CameraModel::name);
                let number = names.iter().position(|own| given.as_deref() == Some(own));
                let number = number.ok_or_else(|| {
                    option(
                        py,
                        format!("{whose}: model must be one of {}", names.join(", ")),
                    )
                })?;
                camera.model = CameraModel::ALL[number];
            }
            "fx" => camera.fx = one()?,
            "fy" => camera.fy = one()?,
            "cx" => camera.cx = one()?,
            "cy" => camera.cy = one()?,
            "width" => camera.width = one()?,
            "height" => camera.height = one()?,
            "near" => camera.near = one()?,
            "far" => camera.far = one()?,
            _ => return Err(wrong(format!("unknown entry {name}"))),
        }
    }
    if poses != 1 {
        return Err(wrong(SHAPES.into()));
    }
    if let Some(list) = distortion {
        let count = camera.model.coefficients();
        if list.len() != count && !(camera.model == CameraModel::OpenCv && list.len() == 4) {
            let (name, given) = (camera.model.name(), list.len());
            return Err(wrong(format!(
                "distortion must hold {count} numbers for {name}, got {given}"
            )));
        }
        camera.distortion[..list.len()].copy_from_slice(&list);
    }
    camera
        .check()
        .map_err(|refused| wrong(refused.to_string()))?;
    Ok(camera)
}

/// Four rows, or 16 numbers column by column: column by column.
fn matrix(value: &Bound<'_, PyAny>) -> Option<[f64; 16]> {
    if let Ok(flat) = numbers(value, "matrix") {
        return flat.try_into().ok();
    }
    let rows: Vec<Vec<f64>> = listed(value).extract().ok()?;
    let is_square = rows.len() == 4 && rows.iter().all(|row| row.len() == 4);
    is_square.then(|| core::array::from_fn(|at| rows[at % 4][at / 4]))
}
