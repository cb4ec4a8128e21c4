//! NumPy arrays as the core reads them, without a copy where the memory allows it.

use numpy::{PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PySlice};

use crate::failure::problem;
use crate::options::shown;

/// Positions: (n, 3), in single or double precision, row after row in memory. Of more columns, the first three count.
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
}

impl<'py> Positions<'py> {
    /// Reads an argument. Arrays of other numbers, or with gaps in memory, are converted.
    pub fn read(argument: &Bound<'py, PyAny>, name: &str) -> PyResult<Self> {
        let py = argument.py();
        let argument = &array_of(argument)?;
        let wrong = |message: &str| problem(py, "positions-type", format!("{name} {message}"));
        let numpy = py.import("numpy")?;
        let array = numpy
            .call_method1("asarray", (argument,))
            .map_err(|_| wrong("must be an array of numbers"))?;
        let kind = kind_of(&array)?;
        if !["f", "i", "u"].contains(&kind.as_str()) {
            // An empty list has no numbers, and no type either.
            return Err(wrong("must be real numbers"));
        }
        // A masked coordinate is not a number, so its point is skipped or refused.
        let masks = numpy.getattr("ma")?;
        let masked = masks.call_method1("isMaskedArray", (argument,))?;
        let array = if masked.is_truthy()? {
            let mask = masks.call_method1("getmaskarray", (argument,))?;
            numpy.call_method1("where", (mask, f64::NAN, array))?
        } else {
            array
        };
        let shape: Vec<usize> = array.getattr("shape")?.extract()?;
        let array = match shape[..] {
            [_, 3] => array,
            // So many columns are points side by side, and not columns of a scan.
            [rows, columns] if columns > 3 && columns <= rows.max(64) => {
                let [all, first] = [PySlice::full(py), PySlice::new(py, 0, 3, 1)];
                array.get_item((all, first))?
            }
            [0] => array.call_method1("reshape", ((0, 3),))?,
            _ => {
                let message =
                    format!("{name} must have the shape (n, 3) or more columns, got {shape:?}");
                return Err(problem(py, "positions-length", message));
            }
        };
        let item: usize = array.getattr("dtype")?.getattr("itemsize")?.extract()?;
        let wanted = if kind == "f" && item == 4 {
            "float32"
        } else {
            "float64"
        };
        let array = numpy.call_method1("require", (array, wanted, ["C", "ALIGNED"]))?;
        array.extract()
    }

    pub fn points(&self) -> Points<'_> {
        match self {
            Self::Single(array) => Points::Single(rows(array.as_slice().unwrap_or(&[]))),
            Self::Double(array) => Points::Double(rows(array.as_slice().unwrap_or(&[]))),
        }
    }
}

/// What NumPy can read: a cloud of another library has its array as `points`, and a tensor as `numpy()`.
fn array_of<'py>(argument: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    if argument.hasattr("__array__")? {
        Ok(argument.clone())
    } else if argument.hasattr("points")? {
        argument.getattr("points")
    } else if argument.hasattr("numpy")? {
        argument.call_method0("numpy")
    } else {
        Ok(argument.clone())
    }
}

/// Each three numbers as a row.
fn rows<T: bytemuck::Pod>(numbers: &[T]) -> &[[T; 3]] {
    bytemuck::cast_slice(numbers)
}

/// Three finite numbers.
pub fn place(argument: &Bound<'_, PyAny>, name: &str) -> PyResult<[f64; 3]> {
    let numbers: Option<Vec<f64>> = argument.extract().ok();
    numbers
        .and_then(|numbers| numbers.try_into().ok())
        .filter(|place: &[f64; 3]| place.iter().all(|x| x.is_finite()))
        .ok_or_else(|| {
            let message = format!("{name} must be 3 finite numbers, got {}", shown(argument));
            problem(argument.py(), "viewpoint", message)
        })
}

/// Several places.
pub fn places(argument: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<[f64; 3]>> {
    each(argument, name, place)
}

/// Reads each entry of a list. Errors name it.
pub fn each<'py, T>(
    given: &Bound<'py, PyAny>,
    name: &str,
    read: impl Fn(&Bound<'py, PyAny>, &str) -> PyResult<T>,
) -> PyResult<Vec<T>> {
    // A camera is also a list, of its names.
    let list = given
        .try_iter()
        .ok()
        .filter(|_| !given.is_instance_of::<PyDict>());
    let list = list.ok_or_else(|| {
        let message = format!("{name} must be a list with an entry for each of them");
        problem(given.py(), "viewpoint", message)
    })?;
    list.enumerate()
        .map(|(number, entry)| read(&entry?, &format!("{name}[{number}]")))
        .collect()
}

/// Indices as the core reads them. Numbers out of range are refused.
pub fn indices(argument: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<u32>> {
    let py = argument.py();
    let wrong = |_| {
        let message = format!("{name} must be integers from 0 to {}", u32::MAX);
        problem(py, "option", message)
    };
    if let Ok(array) = argument.extract::<PyReadonlyArray1<'_, u32>>() {
        return Ok(array.as_array().to_vec());
    }
    listed(argument).extract::<Vec<u32>>().map_err(wrong)
}

/// An array as a list; anything else as it is.
pub fn listed<'py>(argument: &Bound<'py, PyAny>) -> Bound<'py, PyAny> {
    argument
        .call_method0("tolist")
        .unwrap_or_else(|_| argument.clone())
}

/// What the items of an array are, as NumPy says it: "f", "i", "u", "b" and others.
pub fn kind_of(array: &Bound<'_, PyAny>) -> PyResult<String> {
    array.getattr("dtype")?.getattr("kind")?.extract()
}

/// Real numbers, one after another.
pub fn numbers(argument: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<f64>> {
    listed(argument).extract().map_err(|_| {
        let message = format!("{name} must be a list of numbers");
        problem(argument.py(), "option", message)
    })
}
