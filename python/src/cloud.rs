//! The cloud, and what it can be asked.

use hidden_point_removal as core;
use hidden_point_removal::{
    Camera, CameraView, Lighting, NonFinite, Options, PanoramaOptions, Placing, Threads,
};
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyType};

use crate::arrays::{Points, Positions, indices as read_indices, numbers, place, places};
use crate::calibration;
use crate::camera;
use crate::failure::{option, refused};
use crate::map::{self, VisibilityMap};
use crate::options::{self, Asked, How, refuse_draft_and_scores};
use crate::panorama::Panorama;
use crate::placement::Placement;
use crate::seen_by;
use crate::shared::Shared;
use crate::visibility::{Visibility, warn_if_inverted};

/// A point cloud, prepared for visibility queries.
///
/// positions: array of float32 or float64, shape (n, 3), in any units. Of more columns, the first three count. Also a
///     tensor in main memory, or a cloud of another library that has its array as `points`, such as Open3D's. Arrays that
///     are contiguous are read without a copy. Other numbers are converted to float64. A masked coordinate counts as not
///     finite.
/// non_finite: "error" (default) refuses NaN and infinity. With "skip", such points keep their index and are never
///     visible.
///
/// Raises `HprError`, a ValueError: its `code` is "positions-type", "positions-length", "non-finite", "option" or
/// "too-large".
#[pyclass(frozen, module = "hidden_point_removal")]
pub struct PointCloud {
    cloud: Shared<core::PointCloud>,
    non_finite: &'static str,
}

impl PointCloud {
    /// Asks the core, or the part of the cloud that a mask leaves. Other Python threads run meanwhile.
    fn ask<T: Send>(
        &self,
        py: Python<'_>,
        how: How,
        query: impl Send + FnOnce(Threads<'_>) -> Result<T, core::Error>,
    ) -> PyResult<T> {
        self.cloud.ask(py, |cloud| {
            let threads = how.threads.unwrap_or_else(|| default_threads(cloud.len()));
            match how.mask {
                Some(mask) => query(cloud.masked(&mask)?.with_threads(threads)?),
                None => query(cloud.with_threads(threads)?),
            }
        })
    }

    /// What each camera sees, by as many threads. Warns of poses that were probably given the wrong way round.
    pub fn camera_views(
        &self,
        py: Python<'_>,
        cameras: &[Camera],
        asked: &Asked,
        on_progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Vec<CameraView>> {
        let mut views = Vec::new();
        self.in_groups(py, cameras, asked, on_progress, |cloud, group| {
            views.extend(seen_by::views(cloud, group, &asked.options)?);
            Ok(())
        })?;
        views
            .iter()
            .try_for_each(|view| warn_if_inverted(py, view))?;
        Ok(views)
    }

    /// Asks about as many places at once as there are threads, and reports the progress between. The cloud is free then, so
    /// the listener may use it.
    fn in_groups<T: Sync>(
        &self,
        py: Python<'_>,
        places: &[T],
        asked: &Asked,
        on_progress: Option<&Bound<'_, PyAny>>,
        mut query: impl Send + FnMut(Threads<'_>, &[T]) -> Result<(), core::Error>,
    ) -> PyResult<()> {
        if on_progress.is_some_and(|listener| !listener.is_callable()) {
            return Err(option(py, "on_progress must be callable".into()));
        }
        let threads = asked.how.threads;
        let size = threads.unwrap_or(default_threads(self.__len__(py)?)).max(1);
        let mut done = 0;
        // Without a place, the options are checked all the same.
        let groups = places
            .chunks(size)
            .chain(places.is_empty().then_some(places));
        for group in groups {
            self.ask(py, asked.how.clone(), |cloud| query(cloud, group))?;
            done += group.len();
            if let Some(listener) = on_progress.filter(|_| done > 0) {
                listener.call1((done as f64 / places.len() as f64,))?;
            }
        }
        Ok(())
    }

    fn view(
        &self,
        py: Python<'_>,
        given: Option<&Bound<'_, PyDict>>,
        query: impl Send + FnOnce(Threads<'_>, &Options) -> Result<core::Visibility, core::Error>,
    ) -> PyResult<Visibility> {
        let Asked { options, how } = options::read(py, given)?;
        let seen = self.ask(py, how, |cloud| query(cloud, &options))?;
        Ok(Visibility::new(py, seen))
    }
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
    #[pyo3(signature = (positions, non_finite="error"))]
    fn new(py: Python<'_>, positions: &Bound<'_, PyAny>, non_finite: &str) -> PyResult<Self> {
        let (choice, non_finite) = match non_finite {
            "error" => (NonFinite::Error, "error"),
            "skip" => (NonFinite::Skip, "skip"),
            other => {
                let message = format!(r#"non_finite must be "error" or "skip", got {other:?}"#);
                return Err(option(py, message));
            }
        };
        let positions = Positions::read(positions, "positions")?;
        let points = positions.points();
        let made = py.detach(|| match points {
            Points::Single(points) => core::PointCloud::with_non_finite(points, choice),
            Points::Double(points) => core::PointCloud::with_non_finite(points, choice),
        });
        let cloud = made.map_err(|error| refused(py, error))?;
        Ok(Self {
            cloud: Shared::new(cloud),
            non_finite,
        })
    }

    pub fn __len__(&self, py: Python<'_>) -> PyResult<usize> {
        self.cloud.get(py, core::PointCloud::len)
    }

    /// How many points were left out because they are not finite: int.
    #[getter]
    fn skipped(&self, py: Python<'_>) -> PyResult<usize> {
        self.cloud.get(py, core::PointCloud::skipped)
    }

    /// The mean distance of a point to its 6 nearest points: float, in the cloud's units.
    #[getter]
    fn spacing(&self, py: Python<'_>) -> PyResult<f64> {
        self.cloud.get(py, core::PointCloud::spacing)
    }

    /// How far measured points lie off their surface: float, one standard deviation, in the cloud's units. 0 where
    /// nothing tells of noise.
    #[getter]
    fn noise(&self, py: Python<'_>) -> PyResult<f64> {
        self.cloud.ask(py, core::PointCloud::noise)
    }

    #[doc = asks!("visible_from($self, viewpoint, *")]
    /// The points that can be seen from a viewpoint.
    ///
    /// The operator flips all points on a sphere around the viewpoint. Those on the convex hull of the flipped points and
    /// the viewpoint are visible (Katz, Tal and Basri 2007, section 3). The answer is exact for the flipped points.
    ///
    /// viewpoint: 3 numbers, in the cloud's units.
    /// radius: float, "auto" (default), "search" or "opposite". R of the flipping sphere in the cloud's units, at least the
    ///     distance of the farthest point; or the rule that chooses it. A larger R shows more points.
    /// exponent: float, at least 0. R = distance of the farthest point * 10**exponent, the paper's parameter.
    /// inversion: "spherical" (default), {"power": float} or {"exponential": float or "auto"}.
    /// looks: 2 or 3. So many hulls, each trusted where it is sure: fewer errors, slower. Not with radius, exponent,
    ///     inversion and draft.
    /// scores: bool. With looks: the answer has a score from 0 to 1 for each index.
    /// thickness: float or "auto" (default). With looks: how far behind the surface before it a point may lie and still be
    ///     seen, in the cloud's units.
    /// denoise: int. Before the view, each point moves to the plane of its k nearest points.
    /// vote: int. A point is visible if more than 0.4 of itself and its k nearest points are.
    /// draft: bool. An early answer: all visible points, and some hidden ones.
    /// sample: int. Only an even sample of about so many points takes part.
    /// within: dict of distance (float), box (two corners) and mask (n truth values). Only these points take part.
    /// threads: int, from 1 to 256. So many threads compute; they change no answer. Default: all cores from 200,000 points
    ///     on, else 1.
    ///
    /// An option that is None counts as left out. Returns a `Visibility`. Raises `HprError` with the code "viewpoint",
    /// "radius", "option" or "too-large".
    #[pyo3(signature = (viewpoint, **options), text_signature = None)]
    fn visible_from(
        &self,
        py: Python<'_>,
        viewpoint: &Bound<'_, PyAny>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Visibility> {
        let viewpoint = place(viewpoint, "viewpoint")?;
        self.view(py, options, |cloud, options| {
            cloud.visible_from(viewpoint, options)
        })
    }

    #[doc = asks!("visible_from_direction($self, direction, *")]
    /// The points that can be seen along a direction, from infinitely far away: an orthographic view.
    ///
    /// direction: 3 numbers, the way the viewer looks. Their length does not matter.
    /// Options: those of `visible_from`. Not with "search", "opposite", {"power": float} and a distance in within.
    /// Returns a `Visibility`.
    #[pyo3(signature = (direction, **options), text_signature = None)]
    fn visible_from_direction(
        &self,
        py: Python<'_>,
        direction: &Bound<'_, PyAny>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Visibility> {
        let direction = place(direction, "direction")?;
        self.view(py, options, |cloud, options| {
            cloud.visible_from_direction(direction, options)
        })
    }

    #[doc = asks!("visible_from_any($self, viewpoints, *")]
    /// The points that at least one viewpoint sees.
    ///
    /// viewpoints: list of 3 numbers each, or array of shape (m, 3). A camera may stand in the place of a viewpoint; it
    ///     sees only what is in its image. Each view chooses its own radius.
    /// Options: those of `visible_from`. Not with scores.
    /// Returns a `Visibility` with the largest radius.
    #[pyo3(signature = (viewpoints, **options), text_signature = None)]
    fn visible_from_any(
        &self,
        py: Python<'_>,
        viewpoints: &Bound<'_, PyAny>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Visibility> {
        let viewpoints = camera::seats(viewpoints, "viewpoints")?;
        self.view(py, options, |cloud, options| {
            cloud.visible_from_any(&viewpoints, options)
        })
    }

    #[doc = asks!("visible_from_at_least($self, k, viewpoints, *")]
    /// The points that at least `k` viewpoints see.
    ///
    /// k: int, from 1 to the number of viewpoints.
    /// viewpoints: list of 3 numbers each, or array of shape (m, 3). A camera may stand in the place of a viewpoint; it
    ///     sees only what is in its image. Each view chooses its own radius.
    /// Options: those of `visible_from`. Not with scores.
    /// Returns a `Visibility` with the largest radius.
    #[pyo3(signature = (k, viewpoints, **options), text_signature = None)]
    fn visible_from_at_least(
        &self,
        py: Python<'_>,
        k: &Bound<'_, PyAny>,
        viewpoints: &Bound<'_, PyAny>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Visibility> {
        let k = options::count(py, "k", k)?;
        let viewpoints = camera::seats(viewpoints, "viewpoints")?;
        self.view(py, options, |cloud, options| {
            cloud.visible_from_at_least(k, &viewpoints, options)
        })
    }

    #[doc = asks!("visible_from_camera($self, camera, *")]
    /// The points that a camera sees: `visible_from` its place, cut to its image.
    ///
    /// camera: dict of
    ///     camera_to_world or world_to_camera: array of shape (4, 4), rigid;
    ///     fx, fy, cx, cy, width, height: float, in pixels. u = fx*x/z + cx, with x to the right, y down, z forward, and
    ///         u = 0 at the left edge of the first pixel;
    ///     convention: "opencv" (default) or "opengl", where y is up and z backward;
    ///     model: COLMAP's name of the lens (default "OPENCV"), and distortion: its coefficients as COLMAP lists them;
    ///     near, far: float, limits of the depth along the optical axis, in the cloud's units.
    /// Options: those of `visible_from`.
    /// Returns a `Visibility` with `pixels` and `depths`. A camera that is no such dict raises the code "viewpoint".
    #[pyo3(signature = (camera, **options), text_signature = None)]
    fn visible_from_camera(
        &self,
        py: Python<'_>,
        camera: &Bound<'_, PyAny>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Visibility> {
        let camera = camera::read(camera, "camera")?;
        let Asked { options, how } = options::read(py, options)?;
        let view = self.ask(py, how, |cloud| {
            cloud.visible_from_camera(&camera, &options)
        })?;
        Visibility::of_camera(py, view)
    }

    #[doc = asks!("sees($self, viewpoint, positions, *")]
    /// Which places could be seen that are not in the cloud: labels, sensors, targets.
    ///
    /// viewpoint: 3 numbers.
    /// positions: array of shape (m, 3). Each place is asked alone, with the radius of the view without it. One that is
    ///     farther than the radius is not visible.
    /// Options: those of `visible_from`. Not with draft and scores.
    /// Returns an array of bool, one for each place.
    #[pyo3(signature = (viewpoint, positions, **options), text_signature = None)]
    fn sees<'py>(
        &self,
        py: Python<'py>,
        viewpoint: &Bound<'_, PyAny>,
        positions: &Bound<'_, PyAny>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Bound<'py, PyArray1<bool>>> {
        let viewpoint = place(viewpoint, "viewpoint")?;
        let Asked { options, how } = options::read(py, options)?;
        let positions = Positions::read(positions, "positions")?;
        let points = positions.points();
        let seen = self.ask(py, how, |cloud| match points {
            Points::Single(points) => cloud.sees(viewpoint, points, &options),
            Points::Double(points) => cloud.sees(viewpoint, points, &options),
        })?;
        Ok(seen.into_pyarray(py))
    }

    #[doc = asks!("coverage($self, viewpoints, *, on_progress=None")]
    /// How many of the viewpoints see each point.
    ///
    /// viewpoints: list of 3 numbers each, or array of shape (m, 3). A camera may stand in the place of a viewpoint; it
    ///     sees only what is in its image.
    /// on_progress: is called with the share that is done. An exception in it ends the question.
    /// Options: those of `visible_from`. Not with draft and scores.
    /// Returns an array of uint32, one number for each index.
    #[pyo3(signature = (viewpoints, *, on_progress=None, **options), text_signature = None)]
    fn coverage<'py>(
        &self,
        py: Python<'py>,
        viewpoints: &Bound<'_, PyAny>,
        on_progress: Option<&Bound<'_, PyAny>>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Bound<'py, PyArray1<u32>>> {
        let viewpoints = camera::seats(viewpoints, "viewpoints")?;
        let asked = options::read(py, options)?;
        let mut counts = Vec::new();
        self.in_groups(py, &viewpoints, &asked, on_progress, |cloud, group| {
            let more = cloud.coverage(group, &asked.options)?;
            // A listener may have appended points.
            counts.resize(more.len(), 0);
            (counts.iter_mut().zip(more)).for_each(|(count, more): (&mut u32, u32)| *count += more);
            Ok(())
        })?;
        Ok(counts.into_pyarray(py))
    }

    #[doc = asks!("place_viewpoints($self, candidates, count=None, share=None, weights=None, *")]
    /// Chooses viewpoints that together see much: always the one that adds most weight, ties to the lowest number.
    ///
    /// candidates: list of 3 numbers each, or array of shape (m, 3). Cameras may stand in their places.
    /// count: int. At most so many are chosen.
    /// share: float, above 0 and at most 1. No more are chosen than see this share of the weight that some candidate sees.
    /// weights: n numbers of at least 0, one for each index. Default 1 each.
    /// Options: those of `visible_from`. Not with draft and scores.
    /// Returns a `Placement`.
    #[pyo3(signature = (candidates, count=None, share=None, weights=None, **options), text_signature = None)]
    fn place_viewpoints(
        &self,
        py: Python<'_>,
        candidates: &Bound<'_, PyAny>,
        count: Option<&Bound<'_, PyAny>>,
        share: Option<&Bound<'_, PyAny>>,
        weights: Option<&Bound<'_, PyAny>>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Placement> {
        let candidates = camera::seats(candidates, "candidates")?;
        let Asked { options, how } = options::read(py, options)?;
        let weights = weights.map(|given| numbers(given, "weights")).transpose()?;
        let wrong = || option(py, "share must be a number".into());
        let placing = Placing {
            count: count
                .map(|given| options::count(py, "count", given))
                .transpose()?,
            share: share
                .map(|given| options::number(given).ok_or_else(wrong))
                .transpose()?,
            weights: weights.as_deref(),
        };
        let placed = self.ask(py, how, |cloud| {
            cloud.place_viewpoints(&candidates, &options, &placing)
        })?;
        Ok(Placement::new(py, placed))
    }

    #[doc = asks!("panorama($self, viewpoint, width, height, up=(0, 0, 1), *")]
    /// The surface of the visible points as an equirectangular image of ranges, and how much sky is left.
    ///
    /// viewpoint: 3 numbers.
    /// width: int, 1 to 16384. Column 0 looks along +x, the column at a quarter of the width along +y.
    /// height: int, 1 to 16384. Row 0 is up.
    /// up: 3 numbers, the direction above row 0. Column 0 then looks along the part of +x that is perpendicular to it.
    /// Options: those of `visible_from`. Not with draft and scores.
    /// Returns a `Panorama`.
    #[pyo3(signature = (viewpoint, width, height, up=None, **options), text_signature = None)]
    fn panorama(
        &self,
        py: Python<'_>,
        viewpoint: &Bound<'_, PyAny>,
        width: &Bound<'_, PyAny>,
        height: &Bound<'_, PyAny>,
        up: Option<&Bound<'_, PyAny>>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Panorama> {
        let viewpoint = place(viewpoint, "viewpoint")?;
        let width = options::count(py, "width", width)?;
        let size = PanoramaOptions {
            width,
            height: options::count(py, "height", height)?,
            up: up.map_or(Ok([0.0, 0.0, 1.0]), |up| place(up, "direction"))?,
        };
        let Asked { options, how } = options::read(py, options)?;
        let made = self.ask(py, how, |cloud| cloud.panorama(viewpoint, &options, &size))?;
        Panorama::new(py, made, width)
    }

    /// The radius that a rule chooses for a viewpoint.
    ///
    /// viewpoint: 3 numbers.
    /// rule: "auto" (default), "search" or "opposite".
    ///
    /// Returns (radius, exponent, evaluations): two float, and how many hulls the choice took.
    #[pyo3(signature = (viewpoint, rule="auto"))]
    fn auto_radius(
        &self,
        py: Python<'_>,
        viewpoint: &Bound<'_, PyAny>,
        rule: &str,
    ) -> PyResult<(f64, f64, u32)> {
        let viewpoint = place(viewpoint, "viewpoint")?;
        let word = rule.into_pyobject(py)?.into_any();
        let rule = options::radius(py, "radius", &word)?;
        let chosen = self.ask(py, How::default(), |cloud| {
            cloud.auto_radius(viewpoint, rule)
        })?;
        Ok((chosen.radius, chosen.exponent, chosen.evaluations))
    }

    #[doc = asks!("seen_by($self, cameras, *, on_progress=None")]
    /// Which cameras see each point, and where.
    ///
    /// cameras: list of cameras, as for `visible_from_camera`.
    /// on_progress: is called with the share that is done. An exception in it ends the question.
    /// Options: those of `visible_from`. Not with draft and scores.
    /// Returns a `SeenBy`: `offsets`, `cameras`, `pixels` and `towards`, the rows of a sparse matrix.
    #[pyo3(signature = (cameras, *, on_progress=None, **options), text_signature = None)]
    fn seen_by<'py>(
        &self,
        py: Python<'py>,
        cameras: &Bound<'_, PyAny>,
        on_progress: Option<&Bound<'_, PyAny>>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let cameras = camera::cameras(cameras)?;
        let asked = options::read(py, options)?;
        refuse_draft_and_scores(py, &asked.options, "seen_by")?;
        let views = self.camera_views(py, &cameras, &asked, on_progress)?;
        seen_by::rows(py, self.__len__(py)?, &views)
    }

    #[doc = asks!("calibrate($self, stations, *")]
    /// For scans whose stations are known: the smallest thickness at which each station sees the points that it measured.
    ///
    /// stations: list of dicts of viewpoint (3 numbers) and of indices (list or array of int) or mask (n truth values):
    ///     where a scanner stood, and its points.
    /// Options: those of `visible_from`; looks is 3 by default. A thickness that is given is only measured.
    /// Returns a `Calibration`: `thickness`, `recall` (the share of its own points that each station sees) and `options`
    /// to ask with. Takes about ten views for each station.
    #[pyo3(signature = (stations, **options), text_signature = None)]
    fn calibrate<'py>(
        &self,
        py: Python<'py>,
        stations: &Bound<'_, PyAny>,
        options: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let stations = calibration::stations(stations, self.__len__(py)?)?;
        let given = options.map_or_else(|| Ok(PyDict::new(py)), |options| options.copy())?;
        if given.get_item("looks")?.is_none_or(|looks| looks.is_none()) {
            given.set_item("looks", 3)?;
        }
        let Asked { options, how } = options::read(py, Some(&given))?;
        let spacing = self.spacing(py)?;
        let found = self.ask(py, how, |cloud| {
            calibration::calibrated(&cloud, spacing, &stations, &options)
        })?;
        given.set_item("thickness", found.thickness)?;
        let answers = py.import("hidden_point_removal.answers")?;
        (answers.getattr("Calibration")?).call1((found.thickness, found.recall, given))
    }

    #[doc = asks!("visibility_map($self, viewpoint, *, points=32768, corners=65536, towards=None, origin=None")]
    /// A map of directions, which tells for any number of places whether they are certainly hidden.
    ///
    /// viewpoint: 3 numbers.
    /// points: int, at least 16. So many points has the map's hull at most.
    /// corners: int, from 64 to 4194304. So many directions has the map at most.
    /// towards: a camera, or a dict of direction (3 numbers) and angle (the full opening of a cone, in degrees). Only
    ///     these directions get points and corners.
    /// origin: 3 numbers that positions in a shader are relative to. Default: 0 for float32, else the middle of the
    ///     cloud's box.
    /// Options: those of `visible_from`. Not with draft, scores, vote, "search" and "opposite".
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
    /// Options: those of `visible_from`. Not with looks and draft.
    /// Returns (`Visibility`, array of uint32 of shape (m, 3)): three indices for each triangle, counter-clockwise seen
    /// from the viewpoint.
    #[pyo3(signature = (viewpoint, max_edge=None, **options), text_signature = None)]
    fn reconstruct<'py>(
        &self,
        py: Python<'py>,
        viewpoint: &Bound<'_, PyAny>,
        max_edge: Option<f64>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<(Visibility, Bound<'py, PyArray2<u32>>)> {
        let viewpoint = place(viewpoint, "viewpoint")?;
        let Asked { options, how } = options::read(py, options)?;
        let made = self.ask(py, how, |cloud| {
            cloud.reconstruct(viewpoint, &options, max_edge)
        })?;
        let count = made.triangles.len();
        let triangles = made.triangles.into_flattened().into_pyarray(py);
        Ok((
            Visibility::new(py, made.visibility),
            triangles.reshape([count, 3])?,
        ))
    }

    #[doc = asks!("illuminate($self, lights, triangles=None, smoothing=1, ambient=0.0, *")]
    /// Light and shadow: ambient + (1 - ambient) * (lights that see a point / lights), then softened.
    ///
    /// lights: list of 3 numbers each, or array of shape (m, 3).
    /// triangles: array of int of shape (t, 3), indices of a mesh to soften over. Default: the 6 nearest points.
    /// smoothing: int, rounds of softening.
    /// ambient: float, from 0 to 1.
    /// Options: those of `visible_from`. Not with looks and draft.
    /// Returns an array of float32, one brightness from 0 to 1 for each index.
    #[pyo3(signature = (lights, triangles=None, smoothing=1, ambient=0.0, **options), text_signature = None)]
    fn illuminate<'py>(
        &self,
        py: Python<'py>,
        lights: &Bound<'_, PyAny>,
        triangles: Option<&Bound<'_, PyAny>>,
        smoothing: usize,
        ambient: f64,
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

    /// Adds points, all or none. They take the next indices.
    ///
    /// positions: array of float32 or float64, shape (m, 3).
    fn append(&self, py: Python<'_>, positions: &Bound<'_, PyAny>) -> PyResult<()> {
        let positions = Positions::read(positions, "positions")?;
        let points = positions.points();
        self.cloud.change(py, |cloud| match points {
            Points::Single(points) => cloud.append(points),
            Points::Double(points) => cloud.append(points),
        })
    }

    /// Removes points. They are never visible again, and their indices are never given again.
    ///
    /// indices: list or array of int. Those that were removed before are ignored.
    #[pyo3(signature = (indices))]
    fn remove(&self, py: Python<'_>, indices: &Bound<'_, PyAny>) -> PyResult<()> {
        let removed = read_indices(indices, "indices")?;
        self.cloud.change(py, |cloud| cloud.remove(&removed))
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
        let count = rows.len();
        let positions = rows.into_flattened().into_pyarray(py).reshape([count, 3])?;
        let precision = if is_single { "float32" } else { "float64" };
        let positions = positions.call_method1("astype", (precision,))?;
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

/// All cores for clouds from 200,000 points on: a second thread gains too little for smaller ones.
fn default_threads(points: usize) -> usize {
    if points < 200_000 {
        return 1;
    }
    std::thread::available_parallelism().map_or(1, |cores| cores.get().min(256))
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
    let array = py
        .import("numpy")?
        .call_method1("ascontiguousarray", (given,))?;
    let kind: String = array.getattr("dtype")?.getattr("kind")?.extract()?;
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
