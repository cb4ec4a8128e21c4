//! The cloud. What it can be asked is in `views`, `surveys` and `surfaces`.

use std::sync::atomic::{AtomicUsize, Ordering};

use hidden_point_removal as core;
use hidden_point_removal::{Camera, CameraView, NonFinite, Options, Seat};
use numpy::{IntoPyArray, PyArray1, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyType};

use crate::answers::{answer, camera_answer, option, warn_if_inverted};
use crate::arguments::{Points, Positions, indices as read_indices};
use crate::options::{self, Asked, How};
use crate::shared::{Shared, worked};

/// A point cloud, prepared for visibility queries.
///
/// positions: array or tensor of shape (n, 3), in any units; of more columns, the first three count. Also a cloud of Open3D,
///     laspy, pye57, trimesh or PyVista; a table of pandas, polars or Arrow, or a dict, with columns x, y and z; or the path
///     of a LAS, LAZ, COPC, Parquet or NumPy file. Contiguous arrays of float32 and float64 are read without a copy. Other
///     numbers are converted to float64. A masked coordinate counts as not finite.
/// non_finite: "error" (default) refuses NaN and infinity. With "skip", such points keep their index and are never
///     visible.
///
/// Raises `HprError`, a ValueError: its `code` is "positions-type", "positions-length", "non-finite", "option" or
/// "too-large".
#[pyclass(frozen, module = "hidden_point_removal")]
pub struct PointCloud {
    cloud: Shared<core::PointCloud>,
    non_finite: &'static str,
    changes: AtomicUsize,
}

impl PointCloud {
    /// Asks the core, or the part of the cloud that a mask leaves. Other Python threads run meanwhile.
    pub fn ask<T: Send>(
        &self,
        py: Python<'_>,
        how: How,
        query: impl Send + FnOnce(&core::PointCloud) -> Result<T, core::Error>,
    ) -> PyResult<T> {
        let points = self.__len__(py)?.saturating_mul(how.more + 1);
        self.cloud.ask(py, points, |cloud| match how.mask {
            Some(mask) => query(&cloud.masked(&mask)?),
            None => query(cloud),
        })
    }

    /// What each camera sees, by as many threads. Warns of poses that were probably given the wrong way round.
    pub fn camera_views<'py>(
        slf: &Bound<'py, Self>,
        cameras: &[Camera],
        asked: &Asked,
        on_progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Vec<(Bound<'py, PyAny>, Bound<'py, PyAny>)>> {
        let mut found = Vec::new();
        let own = slf.get();
        own.in_groups(slf.py(), cameras, asked, on_progress, |cloud, group| {
            found.extend(views(cloud, group, &asked.options)?);
            Ok(())
        })?;
        let answers = found.into_iter().map(|view| camera_answer(slf, view));
        answers.collect()
    }

    /// Warns of each camera whose pose was probably given the wrong way round.
    pub fn warn_of_inverted(&self, py: Python<'_>, seats: &[Seat]) -> PyResult<()> {
        for seat in seats {
            if let Seat::Camera(camera) = seat {
                let seems_inverted = self
                    .cloud
                    .ask(py, 0, |cloud| cloud.seems_inverted(camera))?;
                warn_if_inverted(py, seems_inverted)?;
            }
        }
        Ok(())
    }

    /// Asks about as many places at once as there are threads, and reports the progress between. The cloud is free then, so
    /// the listener may ask it.
    pub fn in_groups<T: Sync>(
        &self,
        py: Python<'_>,
        places: &[T],
        asked: &Asked,
        on_progress: Option<&Bound<'_, PyAny>>,
        mut query: impl Send + FnMut(&core::PointCloud, &[T]) -> Result<(), core::Error>,
    ) -> PyResult<()> {
        check_listener(py, on_progress)?;
        let size = asked.options.threads;
        // Without a place, the options are checked all the same.
        let mut groups = places
            .chunks(size)
            .chain(places.is_empty().then_some(places));
        let Some(listener) = on_progress else {
            let more = places.len();
            let how = How {
                more,
                ..asked.how.clone()
            };
            return self.ask(py, how, |cloud| {
                groups.try_for_each(|group| query(cloud, group))
            });
        };
        let (mut done, before) = (0, self.changes());
        for group in groups {
            self.ask(py, asked.how.clone(), |cloud| query(cloud, group))?;
            done += group.len();
            self.tell(listener, [done, places.len()], before)?;
        }
        Ok(())
    }

    /// Reads the options of a view of this cloud.
    pub fn read(&self, py: Python<'_>, given: Option<&Bound<'_, PyDict>>) -> PyResult<Asked> {
        let mut asked = options::read(py, given)?;
        if asked.options.threads == 0 {
            asked.options.threads = default_threads(self.__len__(py)?);
        }
        Ok(asked)
    }

    /// How often points have come or gone.
    pub fn changes(&self) -> usize {
        self.changes.load(Ordering::Relaxed)
    }

    /// Tells a listener the share that is done. It must leave the cloud as it is.
    pub fn tell(
        &self,
        listener: &Bound<'_, PyAny>,
        [done, every]: [usize; 2],
        before: usize,
    ) -> PyResult<()> {
        let py = listener.py();
        py.check_signals()?;
        if done > 0 {
            listener.call1((done as f64 / every as f64,))?;
        }
        if self.changes() != before {
            return Err(option(py, "on_progress must not change the cloud".into()));
        }
        Ok(())
    }

    /// Reads the options of a view, and asks for it.
    pub fn view<'py>(
        slf: &Bound<'py, Self>,
        places: usize,
        given: Option<&Bound<'_, PyDict>>,
        query: impl Send + FnOnce(&core::PointCloud, &Options) -> Result<core::Visibility, core::Error>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let Asked { options, mut how } = slf.get().read(slf.py(), given)?;
        how.more = places;
        let seen = slf.get().ask(slf.py(), how, |cloud| query(cloud, &options));
        answer(slf, seen?)
    }

    fn ask_core<T: Send>(
        &self,
        py: Python<'_>,
        query: impl Send + FnOnce(&core::PointCloud) -> Result<T, core::Error>,
    ) -> PyResult<T> {
        self.cloud.ask(py, self.__len__(py)?, query)
    }
}

pub fn check_listener(py: Python<'_>, listener: Option<&Bound<'_, PyAny>>) -> PyResult<()> {
    if listener.is_some_and(|listener| !listener.is_callable()) {
        return Err(option(py, "on_progress must be callable".into()));
    }
    Ok(())
}

/// What some cameras see.
pub fn views(
    cloud: &core::PointCloud,
    cameras: &[Camera],
    options: &Options,
) -> Result<Vec<CameraView>, core::Error> {
    each(cameras, options, |camera, options| {
        cloud.visible_from_camera(camera, options)
    })
}

/// Asks about some places. Each has a thread of its own; a single one is divided among all threads.
pub fn each<P: Sync, A: Send>(
    places: &[P],
    options: &Options,
    ask: impl Sync + Fn(&P, &Options) -> Result<A, core::Error>,
) -> Result<Vec<A>, core::Error> {
    if let [place] = places {
        return Ok(vec![ask(place, options)?]);
    }
    let (stop, ask) = (core::stop(), &ask);
    let alone = options.with_threads(1);
    std::thread::scope(|scope| {
        let spawn = |place| {
            let stop = stop.clone();
            scope.spawn(move || {
                core::stop_by(stop);
                ask(place, &alone)
            })
        };
        let asked: Vec<_> = places.iter().map(spawn).collect();
        let answers = asked.into_iter().map(|thread| {
            thread
                .join()
                .unwrap_or_else(|fault| std::panic::resume_unwind(fault))
        });
        answers.collect()
    })
}

/// What pickle makes a cloud of: the class, its arguments, and the indices to remove.
type Reduced<'py> = (
    Bound<'py, PyType>,
    (Bound<'py, PyAny>, &'static str),
    Bound<'py, PyArray1<u32>>,
);

#[pymethods]
impl PointCloud {
    #[new]
    #[pyo3(
        signature = (positions, non_finite=None),
        text_signature = "(positions, non_finite='error')"
    )]
    fn new(
        py: Python<'_>,
        positions: &Bound<'_, PyAny>,
        non_finite: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let wanted = ("non_finite", r#""error" or "skip""#);
        let non_finite: String = options::named(non_finite, wanted, "error".into())?;
        let (choice, non_finite) = match non_finite.as_str() {
            "error" => (NonFinite::Error, "error"),
            "skip" => (NonFinite::Skip, "skip"),
            other => {
                let message = format!(r#"non_finite must be "error" or "skip", got {other:?}"#);
                return Err(option(py, message));
            }
        };
        let positions = Positions::read(positions, "positions")?;
        let points = positions.points();
        let cloud = worked(py, points.len(), || match points {
            Points::Single(points) => core::PointCloud::with_non_finite(points, choice),
            Points::Double(points) => core::PointCloud::with_non_finite(points, choice),
        })?;
        Ok(Self {
            cloud: Shared::new(cloud),
            non_finite,
            changes: AtomicUsize::new(0),
        })
    }

    pub fn __len__(&self, py: Python<'_>) -> PyResult<usize> {
        self.cloud.get(py, core::PointCloud::len)
    }

    /// The positions: (n, 3), in the cloud's precision. NaN where a point was removed or left out. A new array each time.
    #[getter]
    fn positions<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let (positions, is_single) =
            self.ask_core(py, |cloud| Ok((cloud.positions()?, cloud.is_single())))?;
        let place = |position: Option<[f64; 3]>| position.unwrap_or([f64::NAN; 3]);
        in_precision(py, positions.into_iter().map(place).collect(), is_single)
    }

    /// How many points were left out because they are not finite: int.
    #[getter]
    fn skipped(&self, py: Python<'_>) -> PyResult<usize> {
        self.cloud.get(py, core::PointCloud::skipped)
    }

    /// The mean distance of a point to its 6 nearest points: float, in the cloud's units.
    #[getter]
    pub fn spacing(&self, py: Python<'_>) -> PyResult<f64> {
        self.ask_core(py, core::PointCloud::spacing)
    }

    /// How far measured points lie off their surface: float, one standard deviation, in the cloud's units. 0 where
    /// nothing tells of noise.
    #[getter]
    fn noise(&self, py: Python<'_>) -> PyResult<f64> {
        self.ask_core(py, core::PointCloud::noise)
    }

    /// What the survey found: "clean", an even sample of a surface; "noisy", a sensor's noise everywhere; or "layered",
    /// registered scans, or plants. With looks, the option `surface` overrides it.
    #[getter]
    fn surface(&self, py: Python<'_>) -> PyResult<&'static str> {
        Ok(self.ask_core(py, core::PointCloud::surface)?.name())
    }

    /// Adds points, all or none. They take the next indices.
    ///
    /// positions: array of float32 or float64, shape (m, 3).
    fn append(&self, py: Python<'_>, positions: &Bound<'_, PyAny>) -> PyResult<()> {
        let positions = Positions::read(positions, "positions")?;
        let points = positions.points();
        self.changes.fetch_add(1, Ordering::Relaxed);
        let every = self.__len__(py)? + points.len();
        self.cloud.change(py, every, |cloud| match points {
            Points::Single(points) => cloud.append(points),
            Points::Double(points) => cloud.append(points),
        })
    }

    /// Removes points. They are never visible again, and their indices are never given again.
    ///
    /// indices: list or array of int, or of bool, one for each index. Those that were removed before are ignored.
    #[pyo3(signature = (indices))]
    fn remove(&self, py: Python<'_>, indices: &Bound<'_, PyAny>) -> PyResult<()> {
        let length = self.__len__(py)?;
        let removed = read_indices(indices, "indices", length)?;
        self.changes.fetch_add(1, Ordering::Relaxed);
        self.cloud
            .change(py, length, |cloud| cloud.remove(&removed))
    }

    /// For pickle and copy: the arguments of a new cloud, and the indices to remove from it.
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        let (py, own) = (slf.py(), slf.get());
        let (positions, is_single, mut skipped) = own.ask(py, How::default(), |cloud| {
            Ok((cloud.positions()?, cloud.is_single(), cloud.skipped()))
        })?;
        let mut removed = Vec::new();
        // A removed point needs some place; that of another point changes nothing.
        let other = positions
            .iter()
            .flatten()
            .next()
            .copied()
            .unwrap_or_default();
        let place = |(index, position): (u32, Option<[f64; 3]>)| {
            position.unwrap_or_else(|| {
                if skipped > 0 {
                    skipped -= 1;
                    return [f64::NAN; 3];
                }
                removed.push(index);
                other
            })
        };
        let rows: Vec<[f64; 3]> = (0..).zip(positions).map(place).collect();
        let positions = in_precision(py, rows, is_single)?;
        Ok((
            slf.get_type(),
            (positions, own.non_finite),
            removed.into_pyarray(py),
        ))
    }

    fn __setstate__(&self, py: Python<'_>, removed: &Bound<'_, PyAny>) -> PyResult<()> {
        self.remove(py, removed)
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        Ok(format!("PointCloud({} points)", self.__len__(py)?))
    }
}

fn in_precision<'py>(
    py: Python<'py>,
    rows: Vec<[f64; 3]>,
    is_single: bool,
) -> PyResult<Bound<'py, PyAny>> {
    let count = rows.len();
    let array = rows.into_flattened().into_pyarray(py).reshape([count, 3])?;
    let precision = if is_single { "float32" } else { "float64" };
    array.call_method1("astype", (precision,))
}

/// All cores for clouds from 200,000 points on: a second thread gains too little for smaller ones.
fn default_threads(points: usize) -> usize {
    if points < 200_000 {
        return 1;
    }
    std::thread::available_parallelism().map_or(1, |cores| cores.get().min(256))
}
