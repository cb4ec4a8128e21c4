//! From images to points: colors, labels or features.
//!
//! INPUT    what some cameras see, and an image of each, one after another.
//! OUTPUT   for each index the merged values of the cameras that see it.
//! SUMMARY  A mean needs sums only, and the best value only the best so far. A median and a vote need every value: they
//!          are kept as compactly as the image has them.

use alloc::vec::Vec;

use glam::DVec3;

use crate::answers::camera::{CameraView, Image, Pixels, Raster};
use crate::base::allocation::{OutOfMemory, copied, filled, push, reserve, with_capacity};
use crate::base::error::{Error, in_range};
use crate::base::sort::{Keyed, ordered, sort_keyed};
use crate::cloud::point_cloud::PointCloud;
use crate::view::camera::Camera;
use crate::view::options::Options;

/// How the values of several cameras become one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Merge {
    /// The weighted mean of each channel.
    #[default]
    Mean,
    /// The weighted median of each channel.
    Median,
    /// The pixel with the most weight among equal ones, for labels; of equal weights, that of the first camera.
    Vote,
    /// The pixel of the camera with the highest weight; of equal weights, that of the first camera.
    Best,
}

/// How much a camera counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Weights {
    /// All the same.
    #[default]
    Equal,
    /// 1 ÷ the square of the depth.
    Distance,
    /// The cosine of the angle between the ray and the optical axis.
    Angle,
    /// The score of the view, which needs [`Options::scores`].
    Score,
}

/// Where in an image a value is taken.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Sampling {
    /// The pixel in which the point is.
    #[default]
    Nearest,
    /// Between the centers of four pixels. Those without a value do not count.
    Bilinear,
}

/// How values are taken from images.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TransferOptions {
    /// How the values of several cameras become one.
    pub merge: Merge,
    /// How much a camera counts.
    pub weights: Weights,
    /// Where in an image a value is taken. [`Merge::Vote`] needs the nearest pixel.
    pub sampling: Sampling,
}

impl TransferOptions {
    /// The choices by their numbers in the lists of `src/options.json`; weights count from 1. For bindings.
    #[doc(hidden)]
    #[must_use]
    pub fn of(merge: usize, weights: usize, sampling: usize) -> Self {
        use Weights::{Angle, Distance, Equal, Score};
        let merges = [Merge::Mean, Merge::Median, Merge::Vote, Merge::Best];
        let samplings = [Sampling::Nearest, Sampling::Bilinear];
        Self {
            merge: merges.get(merge).copied().unwrap_or_default(),
            weights: *[Equal, Distance, Angle, Score]
                .get(weights)
                .unwrap_or(&Equal),
            sampling: samplings.get(sampling).copied().unwrap_or_default(),
        }
    }
}

/// What images say about the points of a cloud.
#[derive(Clone, Debug, PartialEq)]
pub struct Transferred {
    /// Numbers for each index, channel by channel; NaN where no camera gave a value.
    pub values: Values,
    /// How many numbers each index has.
    pub channels: usize,
    /// How many cameras gave a value, for each index.
    pub seen: Vec<u32>,
}

/// Values in single precision, or in double precision where an image had it.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Single precision.
    Singles(Vec<f32>),
    /// Double precision.
    Doubles(Vec<f64>),
}

impl PointCloud {
    /// Takes values from images to the points that their cameras see. `images` is asked for one image after another, and
    /// none is kept.
    ///
    /// ```
    /// use hidden_point_removal::{Camera, Image, Options, Pixels, PointCloud, TransferOptions, Values};
    ///
    /// let cloud = PointCloud::new(&[[0.0, 0.0, 4.0], [0.0, 0.0, 8.0]])?;
    /// let camera = Camera::new(1.0, 1.0, 0.5, 0.5, 1.0, 1.0);
    /// let image = Image { pixels: Pixels::Bytes(&[10, 20, 30]), channels: 3 };
    /// let how = TransferOptions::default();
    /// let colors = cloud.transfer(&[camera], [image], &Options::default(), &how)?;
    /// assert_eq!(colors.seen, [1, 0]);
    /// let Values::Singles(values) = colors.values else { unreachable!() };
    /// assert_eq!(values[..3], [10.0, 20.0, 30.0]);
    /// assert!(values[3].is_nan());
    /// # Ok::<(), hidden_point_removal::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for images of another size or number; [`Error::Excludes`]; otherwise as
    /// [`PointCloud::visible_from_camera`].
    pub fn transfer<'a>(
        &self,
        cameras: &[Camera],
        images: impl IntoIterator<Item = Image<'a>>,
        options: &Options,
        how: &TransferOptions,
    ) -> Result<Transferred, Error> {
        let mut transfer = Transfer::new(self.len(), how)?;
        let options = options.with_scores(how.weights == Weights::Score);
        let mut images = images.into_iter();
        let count = cameras.len() as f64;
        let of_number = |number: f64| in_range("the number of images", number, count, count);
        for (number, camera) in cameras.iter().enumerate() {
            let view = self.visible_from_camera(camera, &options)?;
            match images.next() {
                Some(image) => transfer.add(camera, &view, &image)?,
                None => drop(of_number(number as f64)?),
            }
        }
        if images.next().is_some() {
            of_number(count + 1.0)?;
        }
        transfer.finish()
    }
}

/// Values that are taken from one image after another.
pub struct Transfer {
    how: TransferOptions,
    /// 0 before the first image.
    channels: usize,
    /// Whether the values need double precision.
    is_double: bool,
    seen: Vec<u32>,
    /// The total or the highest weight of each index.
    weights: Vec<f64>,
    /// The sum, or the best pixel, of each index, in blocks of [`BLOCK`] indices.
    rows: Vec<Vec<f64>>,
    /// What each camera saw, where every value is needed.
    observed: Vec<Observed>,
}

/// What a camera sees: the points, where they are in the image, how deep, and the directions from them to the camera.
pub(crate) struct Shown<'a> {
    pub indices: &'a [u32],
    pub pixels: &'a [[f32; 2]],
    pub depths: &'a [f32],
    /// For weights by angle.
    pub towards: &'a [[f32; 3]],
    /// For weights by score, one for each index.
    pub scores: &'a [f32],
}

/// One pass over the values frees a block after another, so that they are not in memory twice.
const BLOCK: usize = 1024;

/// The values of one camera.
struct Observed {
    indices: Vec<u32>,
    weights: Vec<f64>,
    rows: Kept,
}

/// Numbers of images, as they are.
enum Kept {
    Bytes(Vec<u8>),
    Singles(Vec<f32>),
    Doubles(Vec<f64>),
}

impl Transfer {
    /// Nothing yet, for a cloud of so many indices.
    ///
    /// # Errors
    /// [`Error::Excludes`] for a vote between pixels; [`Error::OutOfMemory`].
    pub fn new(len: usize, how: &TransferOptions) -> Result<Self, Error> {
        if (how.merge, how.sampling) == (Merge::Vote, Sampling::Bilinear) {
            return Err(Error::Excludes {
                option: "sampling bilinear",
                other: "merge vote",
            });
        }
        Ok(Self {
            how: *how,
            channels: 0,
            is_double: false,
            seen: filled(len, 0)?,
            weights: filled(len, 0.0)?,
            rows: Vec::new(),
            observed: Vec::new(),
        })
    }

    /// Takes the values of what a camera sees: an answer of [`PointCloud::visible_from_camera`].
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for an image of another size, or of another number of channels than the one before;
    /// [`Error::OutOfMemory`].
    pub fn add(&mut self, camera: &Camera, view: &CameraView, image: &Image) -> Result<(), Error> {
        let shown = Shown {
            indices: view.visibility.indices(),
            pixels: &view.pixels,
            depths: &view.depths,
            towards: &view.towards,
            scores: view.visibility.scores(),
        };
        self.take(camera, &shown, image)
    }

    /// The same for the parts of an answer.
    pub(crate) fn take(
        &mut self,
        camera: &Camera,
        view: &Shown,
        image: &Image,
    ) -> Result<(), Error> {
        let size = camera.width * camera.height * image.channels as f64;
        in_range(
            "the size of an image",
            image.pixels.len() as f64,
            size,
            size,
        )?;
        in_range("channels", image.channels as f64, 1.0, u32::MAX.into())?;
        if self.channels == 0 {
            self.channels = image.channels;
            if !self.needs_all() {
                let blocks = self.seen.len().div_ceil(BLOCK);
                reserve(&mut self.rows, blocks)?;
                self.rows.resize_with(blocks, Vec::new);
            }
        }
        let channels = self.channels as f64;
        in_range("channels", image.channels as f64, channels, channels)?;
        self.is_double |= matches!(image.pixels, Pixels::Doubles(_));
        let ahead = camera.lens()?.ahead();
        let raster = Raster {
            image,
            width: camera.width as usize,
            height: camera.height as usize,
        };
        let mut observed = Observed::like(&image.pixels, self.how.sampling);
        let mut row: Vec<f64> = filled(self.channels, 0.0)?;
        for (k, &index) in view.indices.iter().enumerate() {
            let [u, v] = view.pixels[k].map(f64::from);
            let is_given = match self.how.sampling {
                Sampling::Nearest => raster.at(u, v, &mut row),
                Sampling::Bilinear => raster.between(u - 0.5, v - 0.5, &mut row)?,
            };
            if !is_given {
                continue;
            }
            let weight = match self.how.weights {
                Weights::Equal => 1.0,
                Weights::Distance => {
                    let depth = f64::from(view.depths[k]);
                    1.0 / (depth * depth)
                }
                Weights::Angle => {
                    let towards = view.towards[k].map(f64::from);
                    -ahead.dot(DVec3::from_array(towards))
                }
                Weights::Score => {
                    let score = view.scores.get(index as usize);
                    score.copied().unwrap_or(0.0).into()
                }
            };
            if self.needs_all() {
                observed.push(index, weight, &row)?;
            } else {
                self.merge(index as usize, weight, &row)?;
            }
            self.seen[index as usize] += 1;
        }
        if self.needs_all() {
            push(&mut self.observed, observed)?;
        }
        Ok(())
    }

    /// Whether the merge needs every value.
    fn needs_all(&self) -> bool {
        matches!(self.how.merge, Merge::Median | Merge::Vote)
    }

    fn merge(&mut self, index: usize, weight: f64, row: &[f64]) -> Result<(), Error> {
        let block = &mut self.rows[index / BLOCK];
        if block.is_empty() {
            let indices = BLOCK.min(self.seen.len() - index / BLOCK * BLOCK);
            *block = filled(indices * self.channels, 0.0)?;
        }
        let own = &mut block[index % BLOCK * self.channels..][..self.channels];
        let before = &mut self.weights[index];
        if self.how.merge == Merge::Best {
            if self.seen[index] == 0 || weight > *before {
                own.copy_from_slice(row);
                *before = weight;
            }
        } else if *before > 0.0 || self.seen[index] == 0 || weight > 0.0 {
            // Where all weights so far are 0, the first row stands as it is.
            let times = if weight > 0.0 { weight } else { 1.0 };
            let is_first = *before == 0.0;
            for (sum, value) in own.iter_mut().zip(row) {
                *sum = if is_first {
                    times * value
                } else {
                    *sum + weight * value
                };
            }
            *before += weight;
        }
        Ok(())
    }

    /// The merged values.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn finish(mut self) -> Result<Transferred, Error> {
        let channels = self.channels.max(1);
        let count = self.seen.len() * channels;
        let mut values = if self.is_double {
            Values::Doubles(with_capacity(count)?)
        } else {
            Values::Singles(with_capacity(count)?)
        };
        self.rows(&mut |block| match &mut values {
            Values::Singles(values) => values.extend(block.iter().map(|&value| value as f32)),
            Values::Doubles(values) => values.extend(block),
        })?;
        Ok(Transferred {
            values,
            channels,
            seen: self.seen,
        })
    }

    /// Gives the merged values of one block of indices after another away. Returns how many cameras gave each.
    pub(crate) fn rows(&mut self, give: &mut dyn FnMut(&[f64])) -> Result<&[u32], Error> {
        let channels = self.channels.max(1);
        let entries = self.entries()?;
        let mut order: Vec<Keyed> = Vec::new();
        for (number, seen) in self.seen.chunks(BLOCK).enumerate() {
            let start = number * BLOCK;
            let mut block = match self.rows.get_mut(number) {
                Some(rows) if !rows.is_empty() => core::mem::take(rows),
                _ => filled(seen.len() * channels, f64::NAN)?,
            };
            for (k, row) in block.chunks_mut(channels).enumerate() {
                if seen[k] == 0 {
                    row.fill(f64::NAN);
                } else if self.needs_all() {
                    self.merge_observed(entries.of(start + k), &mut order, row)?;
                } else if self.how.merge == Merge::Mean && self.weights[start + k] > 0.0 {
                    let total = self.weights[start + k];
                    row.iter_mut().for_each(|sum| *sum /= total);
                }
            }
            give(&block);
        }
        Ok(&self.seen)
    }

    /// The kept values of each index.
    fn entries(&self) -> Result<Entries, Error> {
        if !self.needs_all() {
            return Ok(Entries::default());
        }
        let mut starts: Vec<usize> = with_capacity(self.seen.len() + 1)?;
        let mut total = 0;
        for &count in &self.seen {
            starts.push(total);
            total += count as usize;
        }
        let mut next = copied(&starts)?;
        starts.push(total);
        let mut entries: Vec<(u32, u32)> = filled(total, (0, 0))?;
        for (number, observed) in self.observed.iter().enumerate() {
            for (k, &index) in observed.indices.iter().enumerate() {
                entries[next[index as usize]] = (number as u32, k as u32);
                next[index as usize] += 1;
            }
        }
        Ok(Entries { starts, entries })
    }

    /// Merges the values of one index, which are in the order of the cameras.
    fn merge_observed(
        &self,
        own: &[(u32, u32)],
        order: &mut Vec<Keyed>,
        row: &mut [f64],
    ) -> Result<(), Error> {
        let channels = row.len();
        let weight = |&(camera, k): &(u32, u32)| self.observed[camera as usize].weights[k as usize];
        let at = |&(camera, k): &(u32, u32), channel: usize| {
            let rows = &self.observed[camera as usize].rows;
            rows.get(k as usize * channels + channel)
        };
        if self.how.merge == Merge::Median {
            order.clear();
            reserve(order, own.len())?;
            for (channel, value) in row.iter_mut().enumerate() {
                order.clear();
                // Adding 0 turns -0 into 0.
                let key = |entry| ordered(at(entry, channel) + 0.0);
                order.extend((0..).zip(own).map(|(number, entry)| (key(entry), number)));
                sort_keyed(order);
                *value = median(order, &|number| {
                    let entry = &own[number as usize];
                    (at(entry, channel), weight(entry))
                });
            }
            return Ok(());
        }
        let equal = |a, b| (0..channels).all(|channel| at(a, channel) == at(b, channel));
        let votes = |entry| {
            let same = own.iter().filter(|other| equal(entry, other));
            same.fold(0.0, |sum, other| sum + weight(other))
        };
        let mut best = (&own[0], votes(&own[0]));
        for entry in &own[1..] {
            let votes = votes(entry);
            if votes > best.1 {
                best = (entry, votes);
            }
        }
        (row.iter_mut().enumerate()).for_each(|(channel, value)| *value = at(best.0, channel));
        Ok(())
    }
}

/// The kept values of each index: the number of the camera, and the place among its values.
#[derive(Default)]
struct Entries {
    starts: Vec<usize>,
    entries: Vec<(u32, u32)>,
}

impl Entries {
    fn of(&self, index: usize) -> &[(u32, u32)] {
        &self.entries[self.starts[index]..self.starts[index + 1]]
    }
}

/// The value, of sorted ones with their weights, at which half of the weight is reached; between two values if it is
/// reached exactly there.
fn median(sorted: &[Keyed], of: &dyn Fn(u32) -> (f64, f64)) -> f64 {
    let total = sorted.iter().fold(0.0, |sum, item| sum + of(item.1).1);
    let half = total / 2.0;
    let mut sum = 0.0;
    for (k, &(_, number)) in sorted.iter().enumerate() {
        let (value, weight) = of(number);
        sum += weight;
        match sorted.get(k + 1) {
            Some(_) if sum < half => {}
            Some(&(_, next)) if sum == half => return 0.5 * value + 0.5 * of(next).0,
            _ => return value,
        }
    }
    f64::NAN
}

impl Observed {
    fn like(pixels: &Pixels, sampling: Sampling) -> Self {
        Self {
            indices: Vec::new(),
            weights: Vec::new(),
            rows: match pixels {
                Pixels::Bytes(_) if sampling == Sampling::Nearest => Kept::Bytes(Vec::new()),
                Pixels::Bytes(_) | Pixels::Singles(_) => Kept::Singles(Vec::new()),
                Pixels::Doubles(_) => Kept::Doubles(Vec::new()),
            },
        }
    }

    fn push(&mut self, index: u32, weight: f64, row: &[f64]) -> Result<(), Error> {
        push(&mut self.indices, index)?;
        push(&mut self.weights, weight)?;
        match &mut self.rows {
            Kept::Bytes(rows) => extend(rows, row, |value| value as u8)?,
            Kept::Singles(rows) => extend(rows, row, |value| value as f32)?,
            Kept::Doubles(rows) => extend(rows, row, |value| value)?,
        }
        Ok(())
    }
}

fn extend<T>(rows: &mut Vec<T>, row: &[f64], to: impl Fn(f64) -> T) -> Result<(), OutOfMemory> {
    reserve(rows, row.len())?;
    rows.extend(row.iter().map(|&value| to(value)));
    Ok(())
}

impl Kept {
    fn get(&self, at: usize) -> f64 {
        match self {
            Self::Bytes(numbers) => numbers[at].into(),
            Self::Singles(numbers) => numbers[at].into(),
            Self::Doubles(numbers) => numbers[at],
        }
    }
}
