//! Questions to a cloud about many viewpoints, and what is seen all around one.

use std::slice;

use hidden_point_removal::{
    Camera, Choice, Given, Inversion, Options, PanoramaOptions, Placing, Station,
};
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods};
use pyo3::exceptions::PyUserWarning;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::answers::{option, python, refused};
use crate::arguments::{self, numbers, place};
use crate::cloud::{PointCloud, each};
use crate::map::{self, VisibilityMap};
use crate::options::{self, Asked, How, refuse_scores};

const LOW: &std::ffi::CStr = c"the stations see less than 0.9 of their own points, since a larger thickness would show more hidden points than own ones";

#[pymethods]
impl PointCloud {
    #[doc = asks!("coverage($self, viewpoints, *, on_progress=None")]
    /// How many of the viewpoints see each point.
    ///
    /// viewpoints: list of 3 numbers each, or array of shape (m, 3). A camera may stand in the place of a viewpoint; it
    ///     sees only what is in its image.
    /// on_progress: is called with the share that is done. It must not change the cloud. An exception in it
    ///     ends the question.
    /// Options: those of `visible_from`. Not with scores.
    /// Returns an array of uint32, one number for each index.
    #[pyo3(signature = (viewpoints, *, on_progress=None, **options), text_signature = None)]
    fn coverage<'py>(
        &self,
        py: Python<'py>,
        viewpoints: &Bound<'_, PyAny>,
        on_progress: Option<&Bound<'_, PyAny>>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Bound<'py, PyArray1<u32>>> {
        let viewpoints = arguments::seats(viewpoints, "viewpoints")?;
        let asked = self.read(py, options)?;
        let mut counts = Vec::new();
        self.in_groups(py, &viewpoints, &asked, on_progress, |cloud, group| {
            let more = cloud.coverage(group, &asked.options)?;
            counts.resize(more.len(), 0);
            (counts.iter_mut().zip(more)).for_each(|(count, more): (&mut u32, u32)| *count += more);
            Ok(())
        })?;
        self.warn_of_inverted(py, &viewpoints)?;
        Ok(counts.into_pyarray(py))
    }

    #[doc = asks!("visible_from_each($self, viewpoints, *, on_progress=None")]
    /// What each of several viewpoints sees, in one array.
    ///
    /// viewpoints: list of 3 numbers each, or array of shape (m, 3). A camera may stand in the place of a viewpoint; it
    ///     sees only what is in its image. Each view chooses its own radius.
    /// on_progress: is called with the share that is done. It must not change the cloud. An exception in it
    ///     ends the question.
    /// Options: those of `visible_from`. Not with scores.
    /// Returns an array of bool of shape (m, n): a row for each viewpoint, a column for each index.
    #[pyo3(signature = (viewpoints, *, on_progress=None, **options), text_signature = None)]
    fn visible_from_each<'py>(
        &self,
        py: Python<'py>,
        viewpoints: &Bound<'_, PyAny>,
        on_progress: Option<&Bound<'_, PyAny>>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Bound<'py, PyArray2<bool>>> {
        let viewpoints = arguments::seats(viewpoints, "viewpoints")?;
        let asked = self.read(py, options)?;
        let shape = [viewpoints.len(), self.__len__(py)?];
        let mut seen = Vec::with_capacity(shape[0] * shape[1]);
        self.in_groups(py, &viewpoints, &asked, on_progress, |cloud, group| {
            let rows = each(group, &asked.options, |seat, options| {
                cloud.coverage(slice::from_ref(seat), options)
            })?;
            seen.extend(rows.iter().flatten().map(|&count| count > 0));
            Ok(())
        })?;
        self.warn_of_inverted(py, &viewpoints)?;
        seen.into_pyarray(py).reshape(shape)
    }

    #[doc = asks!("place_viewpoints($self, candidates, count=None, share=None, weights=None, *, on_progress=None")]
    /// Chooses viewpoints that together see much: always the one that adds most weight, ties to the lowest number.
    ///
    /// candidates: list of 3 numbers each, or array of shape (m, 3). Cameras may stand in their places.
    /// count: int. At most so many are chosen.
    /// share: float, above 0 and at most 1. No more are chosen than see this share of the weight that some candidate sees.
    /// weights: n numbers of at least 0, one for each index. Default 1 each.
    /// on_progress: is called with the share of the candidates that is done. It must not change the cloud. An exception
    ///     in it ends the question.
    /// Options: those of `visible_from`. Not with scores.
    /// Returns a `Placement`.
    #[pyo3(
        signature = (candidates, count=None, share=None, weights=None, *, on_progress=None, **options),
        text_signature = None
    )]
    #[expect(clippy::too_many_arguments, reason = "they are keywords in Python")]
    fn place_viewpoints<'py>(
        &self,
        py: Python<'py>,
        candidates: &Bound<'_, PyAny>,
        count: Option<&Bound<'_, PyAny>>,
        share: Option<&Bound<'_, PyAny>>,
        weights: Option<&Bound<'_, PyAny>>,
        on_progress: Option<&Bound<'_, PyAny>>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let candidates = arguments::seats(candidates, "candidates")?;
        let asked = self.read(py, options)?;
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
        let mut choice = Choice::new(&placing).map_err(|error| refused(py, error))?;
        self.in_groups(py, &candidates, &asked, on_progress, |cloud, group| {
            choice.look(cloud, group, &asked.options)
        })?;
        let placed = self.ask(py, asked.how, |cloud| {
            choice.choose(cloud, &candidates, &asked.options)
        })?;
        self.warn_of_inverted(py, &candidates)?;
        let (seen, unseen) = (placed.seen.into_pyarray(py), placed.unseen.into_pyarray(py));
        python(py, "Placement")?.call1((placed.chosen, placed.gains, seen, unseen))
    }

    #[doc = asks!("panorama($self, viewpoint, width, height, up=(0, 0, 1), *")]
    /// The surface of the visible points as an equirectangular image of ranges, and how much sky is left.
    ///
    /// viewpoint: 3 numbers.
    /// width: int, 1 to 16384. Column 0 looks along +x, the column at a quarter of the width along +y.
    /// height: int, 1 to 16384. Row 0 is up.
    /// up: 3 numbers, the direction above row 0. Column 0 then looks along the part of +x that is perpendicular to it.
    /// Options: those of `visible_from`. Not with scores.
    /// Returns a `Panorama`.
    #[pyo3(signature = (viewpoint, width, height, up=None, **options), text_signature = None)]
    fn panorama<'py>(
        &self,
        py: Python<'py>,
        viewpoint: &Bound<'_, PyAny>,
        width: &Bound<'_, PyAny>,
        height: &Bound<'_, PyAny>,
        up: Option<&Bound<'_, PyAny>>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let viewpoint = place(viewpoint, "viewpoint")?;
        let width = options::count(py, "width", width)?;
        let size = PanoramaOptions {
            width,
            height: options::count(py, "height", height)?,
            up: up.map_or(Ok([0.0, 0.0, 1.0]), |up| place(up, "direction"))?,
        };
        let Asked { options, how } = self.read(py, options)?;
        let made = self.ask(py, how, |cloud| cloud.panorama(viewpoint, &options, &size))?;
        let shape = [size.height, width];
        python(py, "Panorama")?.call1((
            made.ranges.into_pyarray(py).reshape(shape)?,
            made.indices.into_pyarray(py).reshape(shape)?,
            made.sky_view_factor,
            made.solid_angle,
        ))
    }

    /// The radius that a rule chooses for a viewpoint.
    ///
    /// viewpoint: 3 numbers.
    /// rule: "auto" (default) or "opposite".
    ///
    /// Returns (radius, exponent, evaluations): two float, and how many hulls the choice took.
    #[pyo3(
        signature = (viewpoint, rule=None),
        text_signature = "($self, viewpoint, rule='auto')"
    )]
    fn auto_radius(
        &self,
        py: Python<'_>,
        viewpoint: &Bound<'_, PyAny>,
        rule: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<(f64, f64, u32)> {
        let viewpoint = place(viewpoint, "viewpoint")?;
        let rule: String =
            options::named(rule, ("rule", r#""auto" or "opposite""#), "auto".into())?;
        let mut options = Options::default();
        if !options.set("radius", Given::Word(&rule)) {
            let message = format!(r#"rule must be "auto" or "opposite", got {rule:?}"#);
            return Err(option(py, message));
        }
        let chosen = self.ask(py, How::default(), |cloud| {
            cloud.auto_radius(viewpoint, options.radius)
        })?;
        Ok((chosen.radius, chosen.exponent, chosen.evaluations))
    }

    #[doc = asks!("seen_by($self, cameras, *, on_progress=None")]
    /// Which cameras see each point, and where.
    ///
    /// cameras: list of cameras, as for `visible_from_camera`.
    /// on_progress: is called with the share that is done. It must not change the cloud. An exception in it
    ///     ends the question.
    /// Options: those of `visible_from`. Not with scores.
    /// Returns a `SeenBy`: `offsets`, `cameras`, `pixels`, `towards`, and `matrix()`.
    #[pyo3(signature = (cameras, *, on_progress=None, **options), text_signature = None)]
    fn seen_by<'py>(
        slf: &Bound<'py, Self>,
        cameras: &Bound<'_, PyAny>,
        on_progress: Option<&Bound<'_, PyAny>>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (py, cameras) = (slf.py(), arguments::cameras(cameras)?);
        let asked = slf.get().read(py, options)?;
        refuse_scores(py, &asked.options, "seen_by")?;
        let views = Self::camera_views(slf, &cameras, &asked, on_progress)?;
        python(py, "seen_by")?.call1((slf.get().__len__(py)?, views))
    }

    #[doc = asks!("calibrate($self, stations, *")]
    /// For scans whose stations are known: the thickness at which each station sees most of the points that it measured, and
    /// few hidden ones.
    ///
    /// stations: list of dicts of viewpoint (3 numbers) and of indices (list or array of int) or mask (n truth values):
    ///     where a scanner stood, and its points.
    /// Options: those of `visible_from`; looks is 3 by default. A thickness that is given is only measured.
    /// Returns a `Calibration`: `thickness`, `recall` (the share of its own points that each station sees), `shown` (the share
    /// of otherwise hidden points that the thickness shows) and `options` to ask with. Takes up to twenty views for each station.
    #[pyo3(signature = (stations, **options), text_signature = None)]
    fn calibrate<'py>(
        &self,
        py: Python<'py>,
        stations: &Bound<'py, PyAny>,
        options: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let given = options;
        let own = arguments::stations(stations, self.__len__(py)?)?;
        let Asked { mut options, how } = self.read(py, given)?;
        refuse_scores(py, &options, "calibrate")?;
        let asked = given.map_or_else(|| Ok(PyDict::new(py)), |given| given.copy())?;
        let chosen =
            |name: &&str| matches!(asked.get_item(name), Ok(Some(value)) if !value.is_none());
        if !["radius", "exponent", "inversion", "looks"]
            .iter()
            .any(chosen)
        {
            options.inversion = Inversion::Looks(3);
            asked.set_item("looks", 3)?;
        }
        let stations: Vec<_> = (own.iter())
            .map(|(viewpoint, indices)| Station {
                viewpoint: *viewpoint,
                indices,
            })
            .collect();
        let how = How {
            more: 10 * stations.len(),
            ..how
        };
        let found = self.ask(py, how, |cloud| cloud.calibrate(&stations, &options))?;
        if found.is_low() && options.thickness.is_none() {
            let category = py.get_type::<PyUserWarning>();
            PyErr::warn(py, &category, LOW, 1)?;
        }
        asked.set_item("thickness", found.thickness)?;
        python(py, "Calibration")?.call1((found.thickness, found.recall, found.shown, asked))
    }

    #[doc = asks!("visibility_map($self, viewpoint, *, points=750000, towards=None, origin=None")]
    /// A map of directions, which tells for any number of places whether they are certainly hidden. It hides nothing if the
    /// farthest point is nearer than 1e-15 units or farther than 1e15.
    ///
    /// viewpoint: 3 numbers.
    /// points: int, at least 16. So many points of the cloud are looked through at most, with `towards` three times as
    ///     many.
    /// towards: a camera, or a dict of direction (3 numbers) and angle (the full opening of a cone, in degrees). Only
    ///     of these directions is the map.
    /// origin: 3 numbers that positions in a shader are relative to. Default: 0 for float32, else the middle of the
    ///     cloud's box.
    /// Options: those of `visible_from`. Not with scores and "opposite".
    /// Returns a `VisibilityMap`.
    #[pyo3(
        signature = (viewpoint, *, points=None, towards=None, origin=None, **options),
        text_signature = None
    )]
    fn visibility_map(
        &self,
        py: Python<'_>,
        viewpoint: &Bound<'_, PyAny>,
        points: Option<&Bound<'_, PyAny>>,
        towards: Option<&Bound<'_, PyAny>>,
        origin: Option<&Bound<'_, PyAny>>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<VisibilityMap> {
        let viewpoint = place(viewpoint, "viewpoint")?;
        let choices = map::choices(py, points, towards, origin)?;
        let Asked { options, how } = self.read(py, options)?;
        let made = self.ask(py, how, |cloud| {
            cloud.visibility_map(viewpoint, &options, &choices)
        })?;
        Ok(VisibilityMap::new(made))
    }
}

/// Each camera, with its fx, fy, cx, cy, width and height.
#[pyfunction]
#[pyo3(name = "_lenses")]
pub fn lenses(given: &Bound<'_, PyAny>) -> PyResult<Vec<[f64; 6]>> {
    let lens = |own: &Camera| [own.fx, own.fy, own.cx, own.cy, own.width, own.height];
    Ok(arguments::cameras(given)?.iter().map(lens).collect())
}
