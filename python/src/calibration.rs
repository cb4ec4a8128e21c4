//! The thickness at which scanners see the points that they measured.

use hidden_point_removal::{Error, Options, PointCloud};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::{indices, place};
use crate::failure::option;
use crate::options::{shown, truths};

/// So many of the points of each station must be seen.
const ENOUGH: f64 = 0.985;
/// The first thickness, in spacings, how often it is doubled at most, and how often halves are tried then.
const FIRST: f64 = 0.125;
const DOUBLINGS: usize = 16;
const HALVINGS: usize = 3;

/// Where a scanner stood, and the points that it measured.
pub struct Station {
    viewpoint: [f64; 3],
    indices: Vec<u32>,
}

/// Reads stations of a cloud of so many indices.
pub fn stations(given: &Bound<'_, PyAny>, length: usize) -> PyResult<Vec<Station>> {
    let py = given.py();
    let none = || {
        let given = shown(given);
        option(
            py,
            format!("stations must be a list of at least one station, got {given}"),
        )
    };
    let list = given.try_iter().map_err(|_| none())?;
    let stations = list
        .enumerate()
        .map(|(number, entry)| station(&entry?, &format!("stations[{number}]"), length))
        .collect::<PyResult<Vec<_>>>()?;
    if stations.is_empty() {
        Err(none())
    } else {
        Ok(stations)
    }
}

fn station(given: &Bound<'_, PyAny>, name: &str, length: usize) -> PyResult<Station> {
    let py = given.py();
    let wrong = |problem: &str| option(py, format!("{name} {problem}"));
    let entries = given
        .cast::<PyDict>()
        .map_err(|_| wrong("must be a dictionary of viewpoint, and of indices or mask"))?;
    let entry =
        |name: &str| Ok::<_, PyErr>(entries.get_item(name)?.filter(|value| !value.is_none()));
    let viewpoint = entry("viewpoint")?.ok_or_else(|| wrong("has no viewpoint"))?;
    let own = match (entry("indices")?, entry("mask")?) {
        (Some(given), None) => indices(&given, &format!("the indices of {name}"))?,
        (None, Some(mask)) => {
            let marks = truths(py, &mask).filter(|marks| marks.len() == length);
            let marks = marks.ok_or_else(|| {
                wrong(&format!(
                    "must have a mask of {length} truth values, one for each index"
                ))
            })?;
            let marked = (0u32..).zip(marks).filter(|(_, mark)| *mark);
            marked.map(|(index, _)| index).collect()
        }
        _ => return Err(wrong("must have one of indices and mask")),
    };
    if let Some(stray) = own.iter().find(|&&index| index as usize >= length) {
        return Err(wrong(&format!(
            "has index {stray}, which must be below {length}"
        )));
    }
    if own.is_empty() {
        return Err(wrong("has no points"));
    }
    Ok(Station {
        viewpoint: place(&viewpoint, &format!("the viewpoint of {name}"))?,
        indices: own,
    })
}

/// A thickness, and the share of the points of each station that it shows.
pub struct Trial {
    pub thickness: f64,
    pub recall: Vec<f64>,
}

impl Trial {
    fn is_enough(&self) -> bool {
        self.recall.iter().all(|&share| share >= ENOUGH)
    }
}

/// The smallest thickness at which each station sees its own points. A given one is only measured.
pub fn calibrated(
    cloud: &PointCloud,
    spacing: f64,
    stations: &[Station],
    options: &Options,
) -> Result<Trial, Error> {
    let tried = |thickness: f64| {
        let asked = options.thickness(thickness);
        let mut recall = Vec::new();
        for station in stations {
            let mask = cloud.visible_from(station.viewpoint, &asked)?.mask();
            let seen = station
                .indices
                .iter()
                .filter(|&&index| mask[index as usize] == 1);
            recall.push(seen.count() as f64 / station.indices.len() as f64);
        }
        Ok::<_, Error>(Trial { thickness, recall })
    };
    if options.thickness.is_some() || spacing == 0.0 {
        return tried(options.thickness.unwrap_or(0.0));
    }
    let mut best = tried(FIRST * spacing)?;
    let mut least = 0.0;
    for _ in 0..DOUBLINGS {
        if best.is_enough() {
            break;
        }
        least = best.thickness;
        best = tried(2.0 * best.thickness)?;
    }
    for _ in 0..HALVINGS {
        if least == 0.0 || !best.is_enough() {
            break;
        }
        let between = tried((least * best.thickness).sqrt())?;
        if between.is_enough() {
            best = between;
        } else {
            least = between.thickness;
        }
    }
    Ok(best)
}
