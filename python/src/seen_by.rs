//! Which cameras see each point, and normals that are turned towards them.

use std::ops::Neg;

use hidden_point_removal::{Camera, CameraView, Error, Options, Threads};
use numpy::{Element, IntoPyArray, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

use crate::arrays::{Points, Positions};
use crate::failure::{option, problem};

/// What some cameras see. Each has a thread of its own; a single one is divided among all threads.
pub fn views(
    cloud: Threads<'_>,
    cameras: &[Camera],
    options: &Options,
) -> Result<Vec<CameraView>, Error> {
    if let [camera] = cameras {
        return Ok(vec![cloud.visible_from_camera(camera, options)?]);
    }
    std::thread::scope(|scope| {
        let spawn = |camera| scope.spawn(move || (*cloud).visible_from_camera(camera, options));
        let asked: Vec<_> = cameras.iter().map(spawn).collect();
        let answer = |thread: std::thread::ScopedJoinHandle<'_, _>| {
            thread
                .join()
                .unwrap_or_else(|fault| std::panic::resume_unwind(fault))
        };
        asked.into_iter().map(answer).collect()
    })
}

/// The views of all cameras as the rows of a sparse matrix, one for each of `length` points.
pub fn rows<'py>(
    py: Python<'py>,
    length: usize,
    views: &[CameraView],
) -> PyResult<Bound<'py, PyAny>> {
    let count: usize = views.iter().map(|view| view.pixels.len()).sum();
    if u32::try_from(count).is_err() {
        let message = format!("{count} entries exceed the limit of {}", u32::MAX);
        return Err(problem(py, "too-large", message));
    }
    let (offsets, cameras, pixels, towards) = py.detach(|| {
        let mut offsets = vec![0u32; length + 1];
        for view in views {
            for &index in view.visibility.indices() {
                offsets[index as usize + 1] += 1;
            }
        }
        for index in 0..length {
            offsets[index + 1] += offsets[index];
        }
        let mut next = offsets.clone();
        let mut cameras = vec![0u32; count];
        let mut pixels = vec![[0f32; 2]; count];
        let mut towards = vec![[0f32; 3]; count];
        for (number, view) in (0..).zip(views) {
            for (k, &index) in view.visibility.indices().iter().enumerate() {
                let at = next[index as usize] as usize;
                next[index as usize] += 1;
                cameras[at] = number;
                pixels[at] = view.pixels[k];
                towards[at] = view.towards[k];
            }
        }
        (offsets, cameras, pixels, towards)
    });
    let pixels = pixels.into_flattened().into_pyarray(py);
    let towards = towards.into_flattened().into_pyarray(py);
    let answers = py.import("hidden_point_removal.answers")?;
    answers.getattr("SeenBy")?.call1((
        offsets.into_pyarray(py),
        cameras.into_pyarray(py),
        pixels.reshape([count, 2])?,
        towards.reshape([count, 3])?,
    ))
}

/// Turns normals towards the cameras that see their points: the side that most of them look at.
///
/// In a tie, the sum of the cosines decides. What no camera sees stays as it is, and so does a normal of zeros.
///
/// normals: array of float32 or float64, shape (n, 3), one for each index of the cloud.
/// seen_by: what `PointCloud.seen_by` answers.
///
/// Returns new normals of the same type. Raises `HprError` with the code "option".
#[pyfunction]
pub fn orient_normals<'py>(
    normals: &Bound<'py, PyAny>,
    seen_by: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyAny>> {
    let py = normals.py();
    let normals = Positions::read(normals, "normals")
        .map_err(|error| option(py, error.value(py).to_string()))?;
    let points = normals.points();
    let count = match points {
        Points::Single(rows) => rows.len(),
        Points::Double(rows) => rows.len(),
    };
    let (offsets, towards) = directions(seen_by)
        .ok_or_else(|| option(py, "seen_by must be what seen_by of a cloud answers".into()))?;
    if offsets.len() != count + 1 {
        let indices = offsets.len() - 1;
        let message = format!("normals must have the shape ({indices}, 3), got {count} of them");
        return Err(option(py, message));
    }
    match points {
        Points::Single(rows) => turned(py, rows, &offsets, &towards),
        Points::Double(rows) => turned(py, rows, &offsets, &towards),
    }
}

/// The rows, whose offsets rise from 0 to the number of directions.
fn directions(seen_by: &Bound<'_, PyAny>) -> Option<(Vec<u32>, Vec<[f32; 3]>)> {
    let offsets: PyReadonlyArray1<'_, u32> = seen_by.getattr("offsets").ok()?.extract().ok()?;
    let towards: PyReadonlyArray2<'_, f32> = seen_by.getattr("towards").ok()?.extract().ok()?;
    let offsets = offsets.as_array().to_vec();
    let towards: Vec<[f32; 3]> = (towards.as_array().rows().into_iter())
        .map(|row| row.as_slice()?.try_into().ok())
        .collect::<Option<_>>()?;
    let is_whole = offsets.first() == Some(&0)
        && offsets
            .last()
            .is_some_and(|&last| last as usize == towards.len())
        && offsets.is_sorted();
    is_whole.then_some((offsets, towards))
}

fn turned<'py, T: Element + Copy + Into<f64> + Neg<Output = T>>(
    py: Python<'py>,
    normals: &[[T; 3]],
    offsets: &[u32],
    towards: &[[f32; 3]],
) -> PyResult<Bound<'py, PyAny>> {
    let turn = |(normal, range): (&[T; 3], &[u32])| {
        let (mut votes, mut sum) = (0, 0.0);
        for direction in &towards[range[0] as usize..range[1] as usize] {
            let [x, y, z]: [f64; 3] =
                core::array::from_fn(|axis| normal[axis].into() * f64::from(direction[axis]));
            let cosine = x + y + z;
            votes += i32::from(cosine > 0.0) - i32::from(cosine < 0.0);
            sum += cosine;
        }
        if votes < 0 || (votes == 0 && sum < 0.0) {
            normal.map(Neg::neg)
        } else {
            *normal
        }
    };
    let turned = || normals.iter().zip(offsets.windows(2)).flat_map(turn);
    let turned: Vec<T> = py.detach(|| turned().collect());
    Ok(turned
        .into_pyarray(py)
        .reshape([normals.len(), 3])?
        .into_any())
}
