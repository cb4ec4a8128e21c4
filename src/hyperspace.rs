//! Clouds of four and more dimensions: the same definition and flip, with a tolerance.

mod hull;

use alloc::vec::Vec;
use core::cmp::Ordering;

use crate::cloud::{NonFinite, checked_len};
use crate::error::{Error, in_range};
use crate::inversion::{Kernel, square_root};
use crate::options::{Inversion, Options, Radius};
use crate::radius::search::{self, Seen};
use crate::radius::{self, ChosenRadius};
use crate::view::{resolved_inversion, resolved_kernel};
use crate::visibility::Visibility;

/// The largest dimension of a [`PointCloudNd`].
pub const MAX_DIMENSION: usize = 64;
/// Neighbors whose mean distance is a point's spacing, and points that are measured.
const NEIGHBORS: usize = 6;
const SAMPLES: usize = 512;

/// A point cloud of four or more dimensions.
///
/// Answers follow the same definition and the same flip as those of
/// [`PointCloud`](crate::PointCloud), but not to the bit: each point is decided by a
/// small linear program in floating point, and what is within 10⁻¹⁰ of the hull's
/// boundary (relative to its distance) counts as on it, visible. The order of the input
/// and duplicates do not matter. With n points, v of them visible, a query takes
/// O(n·v·D) steps of some tens of passes: seconds for ten thousand points.
pub struct PointCloudNd {
    dimension: usize,
    /// Of every index ever given, without -0.
    coordinates: Vec<f64>,
    present: Vec<bool>,
    non_finite: NonFinite,
    skipped: usize,
    /// The present indices sorted by coordinates, and where each distinct point starts.
    order: Vec<u32>,
    starts: Vec<u32>,
    centroid: Vec<f64>,
    variance: f64,
    spacing: f64,
}

impl PointCloudNd {
    /// Prepares `coordinates`, `dimension` numbers a point.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] unless 4 ≤ `dimension` ≤ [`MAX_DIMENSION`] (there are
    /// [`PointCloud2d`](crate::PointCloud2d) and [`PointCloud`](crate::PointCloud) for
    /// less); [`Error::PositionsLength`]; the others of
    /// [`PointCloud::new`](crate::PointCloud::new).
    pub fn new(dimension: usize, coordinates: &[f64]) -> Result<Self, Error> {
        Self::with_non_finite(dimension, coordinates, NonFinite::Error)
    }

    /// Like [`PointCloudNd::new`], with a choice about points that are not finite.
    ///
    /// # Errors
    /// As [`PointCloudNd::new`].
    pub fn with_non_finite(
        dimension: usize,
        coordinates: &[f64],
        non_finite: NonFinite,
    ) -> Result<Self, Error> {
        in_range("dimension", dimension as f64, 4.0, MAX_DIMENSION as f64)?;
        let mut cloud = Self {
            dimension,
            coordinates: Vec::new(),
            present: Vec::new(),
            non_finite,
            skipped: 0,
            order: Vec::new(),
            starts: Vec::new(),
            centroid: Vec::new(),
            variance: 0.0,
            spacing: 0.0,
        };
        cloud.append(coordinates)?;
        Ok(cloud)
    }

    /// Adds points, which take the next indices: all of them, or none and an error.
    ///
    /// # Errors
    /// As [`PointCloudNd::new`]; the cloud is unchanged then.
    pub fn append(&mut self, coordinates: &[f64]) -> Result<(), Error> {
        let (len, dimension) = (coordinates.len(), self.dimension);
        if len % dimension != 0 {
            return Err(Error::PositionsLength { len, dimension });
        }
        let count = len / dimension;
        checked_len(self.len().saturating_add(count))?;
        let rows = || coordinates.chunks_exact(dimension);
        let is_finite = |row: &[f64]| row.iter().all(|x| x.is_finite());
        let finite = rows().filter(|row| is_finite(row)).count();
        if finite < count && self.non_finite == NonFinite::Error {
            let first = rows().position(|row| !is_finite(row)).unwrap_or(0);
            let count = count - finite;
            return Err(Error::NonFinite { count, first });
        }
        let before = self.present.len();
        self.coordinates.try_reserve(len)?;
        self.present.try_reserve(count)?;
        // Adding 0 makes -0 the same as 0.
        self.coordinates.extend(coordinates.iter().map(|x| x + 0.0));
        self.present.extend(rows().map(is_finite));
        if let Err(error) = self.arrange() {
            self.coordinates.truncate(before * dimension);
            self.present.truncate(before);
            return Err(error);
        }
        self.skipped += count - finite;
        Ok(())
    }

    /// Removes the points with these indices; see
    /// [`PointCloud::remove`](crate::PointCloud::remove).
    ///
    /// # Errors
    /// [`Error::IndexOutOfRange`], [`Error::OutOfMemory`]; the cloud is unchanged then.
    pub fn remove(&mut self, indices: &[u32]) -> Result<(), Error> {
        let len = self.len();
        if let Some(&index) = indices.iter().find(|&&index| index as usize >= len) {
            return Err(Error::IndexOutOfRange { index, len });
        }
        let mut before = Vec::new();
        before.try_reserve_exact(len)?;
        before.extend_from_slice(&self.present);
        for &index in indices {
            self.present[index as usize] = false;
        }
        self.arrange().inspect_err(|_| self.present = before)
    }

    /// How many points were given, skipped and removed ones included.
    #[must_use]
    pub fn len(&self) -> usize {
        self.present.len()
    }

    /// Whether no points were given.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.present.is_empty()
    }

    /// How many of all points given were left out because they are not finite.
    #[must_use]
    pub fn skipped(&self) -> usize {
        self.skipped
    }

    /// The number of coordinates of a point.
    #[must_use]
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// Which points are visible from `viewpoint`? As
    /// [`PointCloud::visible_from`](crate::PointCloud::visible_from), within the
    /// tolerance of [`PointCloudNd`].
    ///
    /// # Errors
    /// [`Error::ViewpointDimension`]; [`Error::Dimension`] for [`Options::denoise`] and
    /// [`Options::vote`]; the others of `PointCloud::visible_from`.
    pub fn visible_from(&self, viewpoint: &[f64], options: &Options) -> Result<Visibility, Error> {
        let (visible, chosen, inversion) = self.marks(viewpoint, options)?;
        self.answer(&visible, chosen, inversion)
    }

    /// Which points are visible from one of `viewpoints`, or from several? See
    /// [`PointCloud::visible_from_any`](crate::PointCloud::visible_from_any).
    ///
    /// # Errors
    /// As [`PointCloudNd::visible_from`].
    pub fn visible_from_any(
        &self,
        viewpoints: &[&[f64]],
        options: &Options,
    ) -> Result<Visibility, Error> {
        self.visible_from_several(1, viewpoints, options)
    }

    /// Which points are visible from at least `k` of `viewpoints`? See
    /// [`PointCloud::visible_from_at_least`](crate::PointCloud::visible_from_at_least).
    ///
    /// # Errors
    /// [`Error::OutOfRange`] unless 1 ≤ `k` ≤ the number of viewpoints; otherwise as
    /// [`PointCloudNd::visible_from`].
    pub fn visible_from_at_least(
        &self,
        k: usize,
        viewpoints: &[&[f64]],
        options: &Options,
    ) -> Result<Visibility, Error> {
        in_range("k", k as f64, 1.0, viewpoints.len() as f64)?;
        self.visible_from_several(k, viewpoints, options)
    }

    /// The radius that `rule` chooses for `viewpoint` in spherical flipping.
    ///
    /// # Errors
    /// As [`PointCloudNd::visible_from`].
    pub fn auto_radius(&self, viewpoint: &[f64], rule: Radius) -> Result<ChosenRadius, Error> {
        self.check_viewpoint(viewpoint)?;
        self.resolve_radius(rule, viewpoint, self.farthest(viewpoint)?)
    }

    fn visible_from_several(
        &self,
        k: usize,
        viewpoints: &[&[f64]],
        options: &Options,
    ) -> Result<Visibility, Error> {
        let inversion = self.check_options(options)?;
        let mut views = filled(self.starts.len(), 0usize)?;
        let mut chosen = ChosenRadius::unit(0.0);
        for viewpoint in viewpoints {
            let (visible, view, _) = self.marks(viewpoint, options)?;
            for (views, visible) in views.iter_mut().zip(visible) {
                *views += usize::from(visible);
            }
            chosen = chosen.joined(view);
        }
        let mut visible = filled(views.len(), false)?;
        for (visible, views) in visible.iter_mut().zip(views) {
            *visible = views >= k;
        }
        self.answer(&visible, chosen, inversion)
    }

    /// For each distinct point whether it is visible, and what the view was resolved to.
    fn marks(
        &self,
        viewpoint: &[f64],
        options: &Options,
    ) -> Result<(Vec<bool>, ChosenRadius, Inversion), Error> {
        self.check_viewpoint(viewpoint)?;
        let inversion = self.check_options(options)?;
        let farthest = self.farthest(viewpoint)?;
        let (kernel, chosen) = resolved_kernel(inversion, options.radius, farthest, |choice| {
            self.resolve_radius(choice, viewpoint, farthest)
        })?;
        Ok((self.mark_visible(viewpoint, kernel)?, chosen, inversion))
    }

    fn check_viewpoint(&self, viewpoint: &[f64]) -> Result<(), Error> {
        let dimension = self.dimension;
        if viewpoint.len() != dimension || viewpoint.iter().any(|x| !x.is_finite()) {
            return Err(Error::ViewpointDimension { dimension });
        }
        Ok(())
    }

    fn check_options(&self, options: &Options) -> Result<Inversion, Error> {
        options.check_dimension(self.dimension)?;
        resolved_inversion(options, self.spacing)
    }

    fn resolve_radius(
        &self,
        choice: Radius,
        viewpoint: &[f64],
        farthest: f64,
    ) -> Result<ChosenRadius, Error> {
        let r_squared = squared(viewpoint, &self.centroid) + self.variance;
        let count = self.starts.len();
        let automatic = radius::closed_form(count, r_squared, self.spacing, farthest);
        let seen = |place: &[f64], kernel| self.mark_visible(place, kernel);
        match choice {
            Radius::Auto => Ok(radius::from_radius(automatic, farthest)),
            Radius::Search => search::antipodal(automatic, farthest, |kernels| {
                let [here, there] = kernels.map(|kernel| seen(viewpoint, kernel));
                Ok(Seen::count(&here?, &there?))
            }),
            Radius::Opposite => {
                let mut mirror = filled(self.dimension, 0.0)?;
                for (axis, x) in mirror.iter_mut().enumerate() {
                    *x = self.centroid[axis] + (self.centroid[axis] - viewpoint[axis]);
                }
                let reach = self.farthest(&mirror).unwrap_or(f64::INFINITY);
                let opposite = if mirror == viewpoint {
                    None
                } else {
                    search::opposite(reach.max(farthest), farthest, |kernel| {
                        Ok(Seen::count(
                            &seen(viewpoint, kernel)?,
                            &seen(&mirror, kernel)?,
                        ))
                    })?
                };
                Ok(opposite.unwrap_or_else(|| radius::from_radius(automatic, farthest)))
            }
            Radius::Absolute(_) | Radius::Exponent(_) => radius::given(choice, farthest),
        }
    }

    fn mark_visible(&self, viewpoint: &[f64], kernel: Kernel) -> Result<Vec<bool>, Error> {
        let mut visible = filled(self.starts.len(), true)?;
        let mut flipped: Vec<f64> = Vec::new();
        flipped.try_reserve_exact(self.starts.len() * self.dimension)?;
        let mut numbers: Vec<usize> = Vec::new();
        numbers.try_reserve_exact(self.starts.len())?;
        for point in 0..self.starts.len() {
            let place = self.distinct(point);
            let s = kernel.factor(square_root(squared(place, viewpoint)));
            let start = flipped.len();
            flipped.extend(place.iter().zip(viewpoint).map(|(p, c)| (p - c) * s));
            if flipped[start..].iter().all(|x| x.is_finite()) {
                numbers.push(point);
            } else {
                flipped.truncate(start);
            }
        }
        let marks = hull::mark_visible(&flipped, self.dimension)?;
        for (point, mark) in numbers.into_iter().zip(marks) {
            visible[point] = mark;
        }
        Ok(visible)
    }

    fn farthest(&self, viewpoint: &[f64]) -> Result<f64, Error> {
        let distances = (0..self.starts.len()).map(|k| squared(self.distinct(k), viewpoint));
        let farthest = square_root(distances.fold(0.0, f64::max));
        if farthest.is_finite() {
            return Ok(farthest);
        }
        Err(Error::RadiusOverflow {
            radius: None,
            farthest,
        })
    }

    fn answer(
        &self,
        visible: &[bool],
        chosen: ChosenRadius,
        inversion: Inversion,
    ) -> Result<Visibility, Error> {
        let mut indices = Vec::new();
        indices.try_reserve_exact(self.order.len())?;
        for point in (0..visible.len()).filter(|&point| visible[point]) {
            indices.extend_from_slice(self.indices_of(point));
        }
        indices.sort_unstable();
        Ok(Visibility::new(indices, self.len(), chosen, inversion))
    }

    fn row(&self, index: u32) -> &[f64] {
        &self.coordinates[index as usize * self.dimension..][..self.dimension]
    }

    fn indices_of(&self, point: usize) -> &[u32] {
        let end = self
            .starts
            .get(point + 1)
            .map_or(self.order.len(), |&end| end as usize);
        &self.order[self.starts[point] as usize..end]
    }

    fn distinct(&self, point: usize) -> &[f64] {
        self.row(self.order[self.starts[point] as usize])
    }

    /// Sorts what is present, and measures it in that order.
    fn arrange(&mut self) -> Result<(), Error> {
        let mut order: Vec<u32> = Vec::new();
        order.try_reserve_exact(self.present.len())?;
        order.extend((0..self.present.len() as u32).filter(|&i| self.present[i as usize]));
        order.sort_unstable_by(|&i, &j| compare(self.row(i), self.row(j)).then(i.cmp(&j)));
        let mut starts: Vec<u32> = Vec::new();
        starts.try_reserve_exact(order.len())?;
        for k in 0..order.len() {
            if k == 0 || self.row(order[k]) != self.row(order[k - 1]) {
                starts.push(k as u32);
            }
        }
        // From here on nothing fails.
        self.centroid = filled(self.dimension, 0.0)?;
        (self.order, self.starts) = (order, starts);
        self.measure();
        Ok(())
    }

    fn measure(&mut self) {
        (self.variance, self.spacing) = (0.0, 0.0);
        let count = self.starts.len();
        if count == 0 {
            return;
        }
        for axis in 0..self.dimension {
            // Relative to one point, which keeps the detail of clouds far away.
            let origin = self.distinct(0)[axis];
            let sum: f64 = (0..count).map(|k| self.distinct(k)[axis] - origin).sum();
            self.centroid[axis] = origin + sum / count as f64;
        }
        let squares: f64 = (0..count)
            .map(|k| squared(self.distinct(k), &self.centroid))
            .sum();
        self.variance = squares / count as f64;
        let samples = count.min(SAMPLES);
        if count < 2 {
            return;
        }
        let mut sum = 0.0;
        for sample in 0..samples {
            sum += self.spacing_at((2 * sample + 1) * count / (2 * samples));
        }
        self.spacing = sum / samples as f64;
    }

    /// The mean distance of a distinct point to its nearest others.
    fn spacing_at(&self, point: usize) -> f64 {
        let mut nearest = [f64::INFINITY; NEIGHBORS];
        for other in (0..self.starts.len()).filter(|&other| other != point) {
            let squared = squared(self.distinct(point), self.distinct(other));
            if squared < nearest[NEIGHBORS - 1] {
                nearest[NEIGHBORS - 1] = squared;
                nearest.sort_unstable_by(f64::total_cmp);
            }
        }
        let found = nearest.iter().filter(|squared| squared.is_finite());
        let count = found.clone().count().max(1);
        found.map(|&squared| square_root(squared)).sum::<f64>() / count as f64
    }
}

fn squared(a: &[f64], b: &[f64]) -> f64 {
    a.iter()
        .zip(b)
        .fold(0.0, |sum, (a, b)| sum + (a - b) * (a - b))
}

fn compare(a: &[f64], b: &[f64]) -> Ordering {
    let differ = a.iter().zip(b).map(|(a, b)| a.total_cmp(b));
    differ.fold(Ordering::Equal, Ordering::then)
}

fn filled<T: Clone>(len: usize, value: T) -> Result<Vec<T>, Error> {
    let mut values = Vec::new();
    values.try_reserve_exact(len)?;
    values.resize(len, value);
    Ok(values)
}
