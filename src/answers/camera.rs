//! What a real camera sees: the view from its place, cut to its image.

use alloc::vec::Vec;

use crate::answers::visibility::Visibility;
use crate::base::allocation::{filled, with_capacity};
use crate::base::error::Error;
use crate::base::real::floor;
use crate::cloud::point_cloud::PointCloud;
use crate::view::camera::Camera;
use crate::view::options::Options;

/// So many points tell whether a pose was given the wrong way round.
const SAMPLE: usize = 4096;

/// What a camera sees.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraView {
    /// The visible points in the image.
    pub visibility: Visibility,
    /// Where each visible point is in the image, x and y in pixels.
    pub pixels: Vec<[f32; 2]>,
    /// The depth of each visible point along the optical axis, in the cloud's units.
    pub depths: Vec<f32>,
    /// The direction of length 1 from each visible point to the camera.
    pub towards: Vec<[f32; 3]>,
    /// Whether the pose was probably given the wrong way round: its image holds next to none of the
    /// points, and that of the inverse pose many of them.
    pub seems_inverted: bool,
}

impl PointCloud {
    /// Which points does a camera see, and where in its image? The answer is that of
    /// [`PointCloud::visible_from`] from the camera's place, without the points outside of the
    /// image. These points still hide others. A point at the camera's place is left out.
    ///
    /// ```
    /// use hidden_point_removal::{Camera, Options, PointCloud};
    ///
    /// let cloud = PointCloud::new(&[[0.0, 0.0, 4.0], [1.0, 0.0, 4.0], [0.0, 0.0, -4.0]])?;
    /// let camera = Camera::new(400.0, 400.0, 320.0, 240.0, 640.0, 480.0);
    /// let seen = cloud.visible_from_camera(&camera, &Options::default())?;
    /// assert_eq!(seen.visibility.indices(), [0, 1]);
    /// assert_eq!(seen.pixels, [[320.0, 240.0], [420.0, 240.0]]);
    /// assert_eq!(seen.depths, [4.0, 4.0]);
    /// # Ok::<(), hidden_point_removal::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Camera`]; otherwise as [`PointCloud::visible_from`].
    pub fn visible_from_camera(
        &self,
        camera: &Camera,
        options: &Options,
    ) -> Result<CameraView, Error> {
        // The camera is checked first.
        self.shown(camera, &[])?;
        let seen = self.visible_from(camera.position(), options)?;
        let shown = self.shown(camera, seen.indices())?;
        let inside = || {
            seen.indices()
                .iter()
                .zip(&shown)
                .filter(|(_, at)| at[2] > 0.0)
        };
        let count = inside().count();
        let mut indices: Vec<u32> = with_capacity(count)?;
        let mut pixels: Vec<[f32; 2]> = with_capacity(count)?;
        let mut depths: Vec<f32> = with_capacity(count)?;
        let mut towards: Vec<[f32; 3]> = with_capacity(count)?;
        for (&index, &[u, v, depth, x, y, z]) in inside() {
            indices.push(index);
            pixels.push([u, v]);
            depths.push(depth);
            towards.push([x, y, z]);
        }
        Ok(CameraView {
            visibility: seen.with_indices(indices),
            pixels,
            depths,
            towards,
            seems_inverted: self.seems_inverted(camera)?,
        })
    }

    /// The part of a view that is in the image of a camera.
    pub(crate) fn in_image(&self, camera: &Camera, seen: Visibility) -> Result<Visibility, Error> {
        let shown = self.shown(camera, seen.indices())?;
        let mut indices: Vec<u32> = with_capacity(shown.len())?;
        let all = seen.indices().iter().zip(&shown);
        indices.extend(all.filter(|(_, at)| at[2] > 0.0).map(|(index, _)| index));
        Ok(seen.with_indices(indices))
    }

    /// Whether the pose of a camera was probably given the wrong way round: its image holds at most 1 %
    /// of the points that the image of the inverse pose holds, and that one at least 2 % of all. Counted
    /// on a sample. Answers without [`CameraView::seems_inverted`], such as unions, do not say so.
    ///
    /// # Errors
    /// [`Error::Camera`] and others for a camera that is refused.
    #[inline(never)]
    pub fn seems_inverted(&self, camera: &Camera) -> Result<bool, Error> {
        let inverse = Camera {
            pose: camera.pose.inverted(),
            ..*camera
        };
        let points = &self.sequence.points;
        let step = points.len().div_ceil(SAMPLE).max(1);
        let sample = || (0..points.len()).step_by(step).map(|at| points.get(at));
        let inside = |camera: &Camera| -> Result<usize, Error> {
            let lens = camera.lens()?;
            Ok(sample().filter(|&p| lens.project(p).1 > 0.0).count())
        };
        let (own, other) = (inside(camera)?, inside(&inverse)?);
        Ok(100 * own <= other && 50 * other >= sample().count().max(1))
    }

    /// Where a camera shows the points with these indices: x, y and the depth, and the direction of
    /// length 1 to the camera. All are 0 for a point outside of the image.
    #[inline(never)]
    pub(crate) fn shown(&self, camera: &Camera, indices: &[u32]) -> Result<Vec<[f32; 6]>, Error> {
        let lens = camera.lens()?;
        let mut shown: Vec<[f32; 6]> = with_capacity(indices.len())?;
        if indices.is_empty() {
            return Ok(shown);
        }
        let places = self.places()?;
        for &index in indices {
            let place = places[index as usize] as usize;
            let point = self.sequence.points.get(place);
            let ([u, v], depth) = lens.project(point);
            shown.push(if depth > 0.0 {
                let [x, y, z] = lens.towards(point);
                let (u, v) = (below(u, camera.width), below(v, camera.height));
                // A depth that rounds to 0 is still a depth.
                [u, v, (depth as f32).max(f32::MIN_POSITIVE), x, y, z]
            } else {
                [0.0; 6]
            });
        }
        Ok(shown)
    }
}

/// `x` in single precision, still below `end`.
fn below(x: f64, end: f64) -> f32 {
    let rounded = x as f32;
    if f64::from(rounded) < end || rounded == 0.0 {
        rounded
    } else {
        // The number before it: `end` is positive.
        f32::from_bits(rounded.to_bits() - 1)
    }
}

// Images, whose values go to points.

/// An image of the size of its camera's, row by row from above, the channels of a pixel side by side. A pixel with a
/// NaN gives no value, nor one with alpha 0 in an image of 4 bytes a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Image<'a> {
    /// The numbers.
    pub pixels: Pixels<'a>,
    /// How many numbers a pixel has.
    pub channels: usize,
}

/// The numbers of an image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pixels<'a> {
    /// Bytes.
    Bytes(&'a [u8]),
    /// Single precision.
    Singles(&'a [f32]),
    /// Double precision, which also holds whole numbers up to 2⁵³.
    Doubles(&'a [f64]),
}

impl Pixels<'_> {
    pub(crate) fn len(&self) -> usize {
        match self {
            Self::Bytes(numbers) => numbers.len(),
            Self::Singles(numbers) => numbers.len(),
            Self::Doubles(numbers) => numbers.len(),
        }
    }
}

/// An image and its size.
pub(crate) struct Raster<'a> {
    pub image: &'a Image<'a>,
    pub width: usize,
    pub height: usize,
}

impl Raster<'_> {
    /// The pixel in which a place is. Returns whether it has a value.
    pub fn at(&self, u: f64, v: f64, into: &mut [f64]) -> bool {
        self.nearest(floor(u), floor(v), into)
    }

    /// The pixel at this column and row, or the nearest one of the image.
    fn nearest(&self, column: f64, row: f64, into: &mut [f64]) -> bool {
        // Conversions saturate: negative numbers become 0.
        let x = (column as usize).min(self.width - 1);
        let y = (row as usize).min(self.height - 1);
        let at = (y * self.width + x) * into.len();
        match self.image.pixels {
            Pixels::Bytes(numbers) => {
                copy(&numbers[at..], into);
                !matches!(numbers[at..at + into.len()], [_, _, _, 0])
            }
            Pixels::Singles(numbers) => copy(&numbers[at..], into),
            Pixels::Doubles(numbers) => copy(&numbers[at..], into),
        }
    }

    /// Between four pixels, whose centers have whole coordinates here.
    pub fn between(&self, x: f64, y: f64, into: &mut [f64]) -> Result<bool, Error> {
        let (left, up) = (floor(x), floor(y));
        let (right, down) = (x - left, y - up);
        let mut sums: Vec<f64> = filled(into.len(), 0.0)?;
        let mut total = 0.0;
        for (i, j) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)] {
            let across = if i > 0.0 { right } else { 1.0 - right };
            let weight = across * if j > 0.0 { down } else { 1.0 - down };
            if weight > 0.0 && self.nearest(left + i, up + j, into) {
                (sums.iter_mut().zip(&*into)).for_each(|(sum, value)| *sum += weight * value);
                total += weight;
            }
        }
        (into.iter_mut().zip(sums)).for_each(|(to, sum)| *to = sum / total);
        Ok(total > 0.0)
    }
}

/// Copies the first numbers. Returns whether none is NaN.
fn copy<T: Copy + Into<f64>>(from: &[T], into: &mut [f64]) -> bool {
    (into.iter_mut().zip(from)).for_each(|(to, &from)| *to = from.into());
    !into.iter().any(|x| x.is_nan())
}
