//! From images to points: colors, labels or features.

use hidden_point_removal::{Camera, CameraView};
use numpy::{IntoPyArray, PyArray1, PyReadonlyArrayDyn, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString};

use crate::arrays::{each, kind_of};
use crate::camera;
use crate::cloud::PointCloud;
use crate::failure::{option, problem};
use crate::merge_values::{Merge, merged};
use crate::options::{self, refuse_draft_and_scores, shown};

/// How much a camera counts.
#[derive(Clone, Copy, PartialEq)]
enum Weights {
    Same,
    Distance,
    Angle,
    Score,
}

#[derive(FromPyObject)]
enum Pixels<'py> {
    Bytes(PyReadonlyArrayDyn<'py, u8>),
    Single(PyReadonlyArrayDyn<'py, f32>),
    Double(PyReadonlyArrayDyn<'py, f64>),
}

/// An image, row by row from above.
#[derive(Clone, Copy)]
struct Image<'a> {
    data: Numbers<'a>,
    width: usize,
    height: usize,
    channels: usize,
}

#[derive(Clone, Copy)]
enum Numbers<'a> {
    Bytes(&'a [u8]),
    Single(&'a [f32]),
    Double(&'a [f64]),
}

/// What one camera says: the points, where they are in the image, and how much they count.
struct Entries {
    view: CameraView,
    weights: Vec<f32>,
    /// The first entry that is left.
    next: usize,
}

#[doc = asks!("transfer(cloud, cameras, images, *, merge='mean', weights=None, sampling='nearest', on_progress=None")]
/// Takes values from images to the points of a cloud: colors, labels or features.
///
/// A point has a value from each camera that sees it. Three looks decide what it sees, unless looks, radius, exponent or
/// inversion is given.
///
/// cloud: `PointCloud`.
/// cameras: list of cameras, as for `visible_from_camera`.
/// images: list of arrays of shape (height, width) or (height, width, channels), one for each camera and of its size; also
///     images of Pillow, or paths, which Pillow opens. A pixel with a NaN gives no value, nor one with alpha 0 in an image of 4 uint8 a pixel.
/// merge: "mean" (default) or "median" of each channel, weighted; "vote": the pixel with the most weight among equal
///     ones, for labels; "best": that of the camera with the highest weight.
/// weights: None (all the same; for "best", "distance"), "distance" (1 / depth**2), "angle" (the cosine between the ray
///     and the optical axis) or "score" (the view's, with looks).
/// sampling: "nearest" (default) or "bilinear", between four pixels; not with "vote".
/// on_progress: is called with the share of the cameras that is done. An exception in it ends the question.
/// Options: those of `PointCloud.visible_from`. Not with draft and scores.
///
/// Returns (values, seen): float32 of shape (n,) or (n, channels) in the images' own scale, NaN where nothing is seen;
/// and uint32, how many cameras gave a value to each index.
#[pyfunction]
#[pyo3(
    signature = (cloud, cameras, images, *, merge=None, weights=None, sampling=None, on_progress=None, **options),
    text_signature = None
)]
#[expect(clippy::too_many_arguments, reason = "they are keywords in Python")]
pub fn transfer<'py>(
    py: Python<'py>,
    #[pyo3(from_py_with = options::given)] cloud: Bound<'py, PointCloud>,
    cameras: &Bound<'py, PyAny>,
    images: &Bound<'py, PyAny>,
    merge: Option<&Bound<'py, PyAny>>,
    weights: Option<&Bound<'py, PyAny>>,
    sampling: Option<&Bound<'py, PyAny>>,
    on_progress: Option<&Bound<'py, PyAny>>,
    options: Option<&Bound<'py, PyDict>>,
) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyArray1<u32>>)> {
    let merge = word(py, "merge", merge, &Merge::WORDS)?.unwrap_or(Merge::Mean);
    let usual = if merge == Merge::Best {
        Weights::Distance
    } else {
        Weights::Same
    };
    let names = [
        ("distance", Weights::Distance),
        ("angle", Weights::Angle),
        ("score", Weights::Score),
    ];
    let weigh = word(py, "weights", weights, &names)?.unwrap_or(usual);
    let samplings = [("nearest", false), ("bilinear", true)];
    let is_smooth = word(py, "sampling", sampling, &samplings)?.unwrap_or(false);
    if is_smooth && merge == Merge::Vote {
        let message = "sampling bilinear cannot be combined with merge vote";
        return Err(option(py, message.into()));
    }
    let given = options.map_or_else(|| Ok(PyDict::new(py)), |options| options.copy())?;
    let mut is_chosen = false;
    for name in ["looks", "radius", "exponent", "inversion"] {
        is_chosen |= given.get_item(name)?.is_some_and(|value| !value.is_none());
    }
    if !is_chosen {
        given.set_item("looks", 3)?;
    }
    let mut asked = options::read(py, Some(&given))?;
    refuse_draft_and_scores(py, &asked.options, "transfer")?;
    asked.options.scores = weigh == Weights::Score;
    let cameras = camera::cameras(cameras)?;
    let own = each(images, "images", pixels).map_err(|error| {
        let code = error.value(py).getattr("code");
        if code.is_ok_and(|code| code.eq("load").unwrap_or(false)) {
            return error;
        }
        option(py, error.value(py).to_string())
    })?;
    let (images, shape) = read_images(py, &own, &cameras)?;

    let cloud = cloud.get();
    let length = cloud.__len__(py)?;
    let views = cloud.camera_views(py, &cameras, &asked, on_progress)?;
    let channels = images.first().map_or(1, |image| image.channels);
    let (values, seen) = py
        .detach(|| {
            let entries = views.into_iter().zip(&cameras);
            let entries = entries
                .map(|(view, camera)| Entries::new(view, camera, weigh))
                .collect();
            joined(length, channels, entries, &images, is_smooth, merge)
        })
        .ok_or_else(|| {
            let message = format!("there is no memory for {length} values of {channels} channels");
            problem(py, "too-large", message)
        })?;
    let values = values.into_pyarray(py);
    let values = values.call_method1("reshape", ([&[length], &shape[..]].concat(),))?;
    Ok((values, seen.into_pyarray(py)))
}

impl Entries {
    fn new(view: CameraView, camera: &Camera, weigh: Weights) -> Self {
        let weight = |k: usize| {
            let depth = f64::from(view.depths[k]);
            let [x, y] = view.pixels[k].map(f64::from);
            let [x, y] = [(x - camera.cx) / camera.fx, (y - camera.cy) / camera.fy];
            match weigh {
                Weights::Same => 1.0,
                Weights::Distance => (1.0 / (depth * depth)) as f32,
                Weights::Angle => (1.0 / (1.0 + x * x + y * y).sqrt()) as f32,
                Weights::Score => view.visibility.scores()[view.visibility.indices()[k] as usize],
            }
        };
        Self {
            weights: (0..view.pixels.len()).map(weight).collect(),
            view,
            next: 0,
        }
    }

    /// The entry of a point, if there is one. Points are asked in ascending order.
    fn of(&mut self, index: u32) -> Option<usize> {
        let k = self.next;
        let is_own = self.view.visibility.indices().get(k) == Some(&index);
        self.next += usize::from(is_own);
        is_own.then_some(k)
    }
}

/// Merges the values of each point. `None` where there is no memory.
fn joined(
    length: usize,
    channels: usize,
    mut views: Vec<Entries>,
    images: &[Image<'_>],
    is_smooth: bool,
    merge: Merge,
) -> Option<(Vec<f32>, Vec<u32>)> {
    let mut values = Vec::new();
    values
        .try_reserve_exact(length.checked_mul(channels)?)
        .ok()?;
    values.resize(length * channels, f32::NAN);
    let mut seen = vec![0; length];
    let mut rows = vec![0.0; views.len() * channels];
    let mut weights = vec![0.0; views.len()];
    for (index, (target, count)) in (0..).zip(values.chunks_exact_mut(channels).zip(&mut seen)) {
        let mut found = 0;
        for (view, image) in views.iter_mut().zip(images) {
            let Some(k) = view.of(index) else {
                continue;
            };
            let row = &mut rows[found * channels..][..channels];
            let at = view.view.pixels[k].map(f64::from);
            if if is_smooth {
                image.bilinear(at, row)
            } else {
                image.nearest(at, row)
            } {
                weights[found] = f64::from(view.weights[k]);
                found += 1;
            }
        }
        *count = found as u32;
        if found > 0 {
            merged(merge, &rows[..found * channels], &weights[..found], target);
        }
    }
    Some((values, seen))
}

impl Image<'_> {
    fn number(&self, at: usize) -> f64 {
        match self.data {
            Numbers::Bytes(data) => data[at].into(),
            Numbers::Single(data) => data[at].into(),
            Numbers::Double(data) => data[at],
        }
    }

    /// A pixel, or the nearest one of the image. Returns whether it has a value.
    fn pixel(&self, [column, row]: [f64; 2], into: &mut [f64]) -> bool {
        // Conversions saturate.
        let x = (column as usize).min(self.width - 1);
        let y = (row as usize).min(self.height - 1);
        let from = (y * self.width + x) * self.channels;
        // In images of 4 bytes a pixel, alpha 0 gives no value.
        if let (Numbers::Bytes(data), 4) = (self.data, self.channels) {
            if data[from + 3] == 0 {
                return false;
            }
        }
        for (channel, to) in into.iter_mut().enumerate() {
            *to = self.number(from + channel);
        }
        !into.iter().any(|value| value.is_nan())
    }

    fn nearest(&self, at: [f64; 2], into: &mut [f64]) -> bool {
        self.pixel(at.map(f64::floor), into)
    }

    /// Between the centers of four pixels. Those without a value do not count.
    fn bilinear(&self, at: [f64; 2], into: &mut [f64]) -> bool {
        let [x, y] = at.map(|u| (u - 0.5).floor());
        let [right, down] = [at[0] - 0.5 - x, at[1] - 0.5 - y];
        let mut sum = vec![0.0; into.len()];
        let mut total = 0.0;
        for (i, j) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)] {
            let across = if i == 0.0 { 1.0 - right } else { right };
            let weight = across * if j == 0.0 { 1.0 - down } else { down };
            if weight > 0.0 && self.pixel([x + i, y + j], into) {
                for (sum, value) in sum.iter_mut().zip(&*into) {
                    *sum += weight * value;
                }
                total += weight;
            }
        }
        for (to, sum) in into.iter_mut().zip(sum) {
            *to = sum / total;
        }
        total > 0.0
    }
}

/// The numbers of an image: bytes, or in single or double precision, whichever holds them all.
fn pixels<'py>(given: &Bound<'py, PyAny>, name: &str) -> PyResult<Pixels<'py>> {
    let py = given.py();
    let wrong = || {
        let message = format!(
            "{name} must be an array of numbers, (height, width) or (height, width, channels)"
        );
        option(py, message)
    };
    let numpy = py.import("numpy")?;
    let is_path = given.is_instance_of::<PyString>() || given.hasattr("__fspath__")?;
    let array = if is_path {
        let opened = (py.import("PIL.Image")?.call_method1("open", (given,)))
            .and_then(|image| numpy.call_method1("asarray", (image,)));
        opened.map_err(|error| problem(py, "load", format!("{name} cannot be read: {error}")))?
    } else {
        let array = numpy.call_method1("asarray", (given,));
        array.map_err(|_| wrong())?
    };
    let size: usize = array.getattr("dtype")?.getattr("itemsize")?.extract()?;
    let precision = match (&*kind_of(&array)?, size) {
        ("u", 1) => "uint8",
        ("b", _) | ("i" | "u", 1 | 2) | ("f", 2 | 4) => "float32",
        ("i" | "u" | "f", _) => "float64",
        _ => return Err(wrong()),
    };
    if ![2, 3].contains(&array.getattr("ndim")?.extract::<usize>()?) {
        return Err(wrong());
    }
    let array = numpy.call_method1("require", (array, precision, ["C", "ALIGNED"]))?;
    array.extract()
}

/// The images, and the shape of a pixel of each.
fn read_images<'a>(
    py: Python<'_>,
    given: &'a [Pixels<'_>],
    cameras: &[Camera],
) -> PyResult<(Vec<Image<'a>>, Vec<usize>)> {
    let wrong = |number: usize, problem: String| option(py, format!("images[{number}] {problem}"));
    if given.len() != cameras.len() {
        let (own, wanted) = (given.len(), cameras.len());
        let message = format!("images must hold one image for each of {wanted} cameras, got {own}");
        return Err(option(py, message));
    }
    let mut images: Vec<Image<'a>> = Vec::new();
    let mut pixel = Vec::new();
    for (number, (given, camera)) in given.iter().zip(cameras).enumerate() {
        let (data, shape) = match given {
            Pixels::Bytes(array) => (array.as_slice().map(Numbers::Bytes), array.shape()),
            Pixels::Single(array) => (array.as_slice().map(Numbers::Single), array.shape()),
            Pixels::Double(array) => (array.as_slice().map(Numbers::Double), array.shape()),
        };
        let (height, width) = (shape[0], shape[1]);
        if (width as f64, height as f64) != (camera.width, camera.height) {
            let (wide, high) = (camera.width, camera.height);
            let problem = format!(
                "must have the size of its camera's image, {wide} x {high}, got {width} x {height}"
            );
            return Err(wrong(number, problem));
        }
        let channels = shape[2..].iter().product();
        let first = images.first().map_or(channels, |image| image.channels);
        if channels != first || channels == 0 {
            let problem = format!("must have {} channels, got {channels}", first.max(1));
            return Err(wrong(number, problem));
        }
        if number == 0 {
            pixel = shape[2..].to_vec();
        }
        images.push(Image {
            data: data?,
            width,
            height,
            channels,
        });
    }
    Ok((images, pixel))
}

/// One of some words.
fn word<T: Copy>(
    py: Python<'_>,
    name: &str,
    given: Option<&Bound<'_, PyAny>>,
    words: &[(&str, T)],
) -> PyResult<Option<T>> {
    let Some(given) = given else {
        return Ok(None);
    };
    let own: Option<String> = given.extract().ok();
    let known = words.iter().find(|(word, _)| own.as_deref() == Some(word));
    known.map(|(_, value)| Some(*value)).ok_or_else(|| {
        let words: Vec<&str> = words.iter().map(|(word, _)| *word).collect();
        let message = format!(
            "{name} must be one of {}, got {}",
            words.join(", "),
            shown(given)
        );
        option(py, message)
    })
}
