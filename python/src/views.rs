//! Questions to a cloud: what a viewpoint, a direction, or a camera sees.

use hidden_point_removal::Lighting;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::answers::{answer, camera_answer};
use crate::arguments::{self, Points, Positions, place};
use crate::cloud::PointCloud;
use crate::options::{self, Asked};

#[pymethods]
impl PointCloud {
    #[doc = asks!("visible_from($self, viewpoint, *")]
    /// The points that can be seen from a viewpoint.
    ///
    /// The operator flips all points on a sphere around the viewpoint. Those on the convex hull of the flipped points and
    /// the viewpoint are visible (Katz, Tal and Basri 2007, section 3). The answer is exact for the flipped points.
    ///
    /// viewpoint: 3 numbers, in the cloud's units.
    #[doc = about_options!()]
    /// threads: int, from 1 to 256. So many threads compute; they change no answer. Default: all cores from 200,000 points
    ///     on, else 1.
    ///
    /// An option that is None counts as left out. Returns a `Visibility`. Raises `HprError` with the code "viewpoint",
    /// "radius", "option" or "too-large".
    #[pyo3(signature = (viewpoint, **options), text_signature = None)]
    fn visible_from<'py>(
        slf: &Bound<'py, Self>,
        viewpoint: &Bound<'_, PyAny>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let viewpoint = place(viewpoint, "viewpoint")?;
        Self::view(slf, 0, options, |cloud, options| {
            cloud.visible_from(viewpoint, options)
        })
    }

    #[doc = asks!("visible_from_direction($self, direction, *")]
    /// The points that can be seen along a direction, from infinitely far away: an orthographic view.
    ///
    /// direction: 3 numbers, the way the viewer looks. Their length does not matter.
    /// Options: those of `visible_from`. Not with "opposite", {"power": float} and a distance in within.
    /// Returns a `Visibility`.
    #[pyo3(signature = (direction, **options), text_signature = None)]
    fn visible_from_direction<'py>(
        slf: &Bound<'py, Self>,
        direction: &Bound<'_, PyAny>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let direction = place(direction, "direction")?;
        Self::view(slf, 0, options, |cloud, options| {
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
    fn visible_from_any<'py>(
        slf: &Bound<'py, Self>,
        viewpoints: &Bound<'_, PyAny>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let viewpoints = arguments::seats(viewpoints, "viewpoints")?;
        let count = viewpoints.len();
        let seen = Self::view(slf, count, options, |cloud, options| {
            cloud.visible_from_any(&viewpoints, options)
        })?;
        slf.get().warn_of_inverted(slf.py(), &viewpoints)?;
        Ok(seen)
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
    fn visible_from_at_least<'py>(
        slf: &Bound<'py, Self>,
        k: &Bound<'_, PyAny>,
        viewpoints: &Bound<'_, PyAny>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let k = options::count(slf.py(), "k", k)?;
        let viewpoints = arguments::seats(viewpoints, "viewpoints")?;
        let count = viewpoints.len();
        let seen = Self::view(slf, count, options, |cloud, options| {
            cloud.visible_from_at_least(k, &viewpoints, options)
        })?;
        slf.get().warn_of_inverted(slf.py(), &viewpoints)?;
        Ok(seen)
    }

    #[doc = asks!("visible_from_camera($self, camera, *")]
    /// The points that a camera sees: `visible_from` its place, cut to its image.
    ///
    /// camera: dict of
    ///     camera_to_world or world_to_camera: array of shape (4, 4) or (3, 4), rigid;
    ///     fx, fy, cx, cy, width, height: float, in pixels. u = fx*x/z + cx, with x to the right, y down, z forward, and
    ///         u = 0 at the left edge of the first pixel;
    ///     K: array of shape (3, 3), in place of fx, fy, cx and cy;
    ///     convention: "opencv" (default) or "opengl", where y is up and z backward;
    ///     model: COLMAP's name of the lens (default "OPENCV"), and distortion: its coefficients as COLMAP lists them;
    ///     near, far: float, limits of the depth along the optical axis, in the cloud's units.
    /// Options: those of `visible_from`.
    ///     Also what `read_cameras` gives, or an image of pycolmap.
    /// Returns a `CameraView`: a `Visibility` with `pixels` and `depths`. A camera that is no such dict raises the code "viewpoint".
    #[pyo3(signature = (camera, **options), text_signature = None)]
    fn visible_from_camera<'py>(
        slf: &Bound<'py, Self>,
        camera: &Bound<'_, PyAny>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let camera = arguments::camera(camera, "camera")?;
        let Asked { options, how } = slf.get().read(slf.py(), options)?;
        let view = slf.get().ask(slf.py(), how, |cloud| {
            cloud.visible_from_camera(&camera, &options)
        })?;
        Ok(camera_answer(slf, view)?.0)
    }

    #[doc = asks!("sees($self, viewpoint, positions, *")]
    /// Which places could be seen that are not in the cloud: labels, sensors, targets.
    ///
    /// viewpoint: 3 numbers.
    /// positions: array of shape (m, 3). Each place is asked alone, with the radius of the view without it. One that is
    ///     farther than the radius is not visible.
    /// Options: those of `visible_from`. Not with scores.
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
        let Asked { options, mut how } = self.read(py, options)?;
        let positions = Positions::read(positions, "positions")?;
        let points = positions.points();
        how.more = points.len();
        let seen = self.ask(py, how, |cloud| match points {
            Points::Single(points) => cloud.sees(viewpoint, points, &options),
            Points::Double(points) => cloud.sees(viewpoint, points, &options),
        })?;
        Ok(seen.into_pyarray(py))
    }

    #[doc = asks!("reconstruct($self, viewpoint, max_edge=None, *")]
    /// The visible points, and the triangles between them.
    ///
    /// viewpoint: 3 numbers.
    /// max_edge: float. Triangles with a longer edge are left out. Default 5 spacings.
    /// Options: those of `visible_from`. Not with looks.
    /// Returns (`Visibility`, array of uint32 of shape (m, 3)): three indices for each triangle, counter-clockwise seen
    /// from the viewpoint.
    #[pyo3(signature = (viewpoint, max_edge=None, **options), text_signature = None)]
    fn reconstruct<'py>(
        slf: &Bound<'py, Self>,
        viewpoint: &Bound<'_, PyAny>,
        max_edge: Option<&Bound<'_, PyAny>>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyArray2<u32>>)> {
        let py = slf.py();
        let viewpoint = place(viewpoint, "viewpoint")?;
        let max_edge = max_edge
            .map(|edge| options::named(Some(edge), ("max_edge", "a number"), 0.0))
            .transpose()?;
        let Asked { options, how } = slf.get().read(py, options)?;
        let made = slf.get().ask(py, how, |cloud| {
            cloud.reconstruct(viewpoint, &options, max_edge)
        })?;
        let count = made.triangles.len();
        let triangles = made.triangles.into_flattened().into_pyarray(py);
        Ok((
            answer(slf, made.visibility)?,
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
    /// Options: those of `visible_from`. Not with looks.
    /// Returns an array of float32, one brightness from 0 to 1 for each index.
    #[pyo3(signature = (lights, triangles=None, smoothing=None, ambient=None, **options), text_signature = None)]
    fn illuminate<'py>(
        &self,
        py: Python<'py>,
        lights: &Bound<'_, PyAny>,
        triangles: Option<&Bound<'_, PyAny>>,
        smoothing: Option<&Bound<'_, PyAny>>,
        ambient: Option<&Bound<'_, PyAny>>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Bound<'py, PyArray1<f32>>> {
        let lights = arguments::places(lights, "lights")?;
        let Asked { options, mut how } = self.read(py, options)?;
        how.more = lights.len();
        let length = self.__len__(py)?;
        let corners = triangles
            .map(|given| arguments::triangles(given, "triangles", length))
            .transpose()?;
        let lighting = Lighting {
            triangles: corners.as_deref(),
            smoothing: options::named(smoothing, ("smoothing", "an integer of at least 0"), 1)?,
            ambient: options::named(ambient, ("ambient", "a number"), 0.0)?,
        };
        let brightness = self.ask(py, how, |cloud| {
            cloud.illuminate(&lights, &options, &lighting)
        })?;
        Ok(brightness.into_pyarray(py))
    }
}
