//! Clouds of four and more dimensions: the same definition and flip, with a tolerance.

mod extreme;
mod rows;

use alloc::vec::Vec;

use self::rows::{Rows, squared};
use crate::answers::visibility::{Visibility, marked_indices};
use crate::base::allocation::{filled, with_capacity};
use crate::base::error::{Error, in_range};
use crate::base::real::square_root;
use crate::cloud::point_cloud::NonFinite;
use crate::flip::kernel::Kernel;
use crate::view::choice::Sight;
use crate::view::options::{Inversion, Options, Radius};
use crate::view::radius::{self, ChosenRadius};
use crate::view::refusals::QuestionKind;
use crate::view::resolved::{check_flip, resolved_inversion, resolved_kernel};

/// The largest dimension of a [`PointCloudNd`].
pub const MAX_DIMENSION: usize = 64;

/// A point cloud of four or more dimensions.
///
/// Answers follow the same definition and the same flip as those of
/// [`PointCloud`](crate::PointCloud), but not to the bit. A small linear program in floating
/// point decides each point. A point within 10⁻¹⁰ of the hull's boundary, relative to its
/// distance, counts as visible. The order of the input and duplicates do not matter. With n
/// points, v of them visible, a query takes O(n·v·D) time: seconds for ten thousand points.
pub struct PointCloudNd {
    rows: Rows,
    non_finite: NonFinite,
    skipped: usize,
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
            rows: Rows::new(dimension),
            non_finite,
            skipped: 0,
        };
        cloud.append(coordinates)?;
        Ok(cloud)
    }

    /// Adds points, which take the next indices: all of them, or none and an error.
    ///
    /// # Errors
    /// As [`PointCloudNd::new`]; the cloud is unchanged then.
    pub fn append(&mut self, coordinates: &[f64]) -> Result<(), Error> {
        self.skipped += self.rows.append(coordinates, self.non_finite)?;
        Ok(())
    }

    /// Removes the points with these indices; see
    /// [`PointCloud::remove`](crate::PointCloud::remove).
    ///
    /// # Errors
    /// [`Error::IndexOutOfRange`], [`Error::OutOfMemory`]; the cloud is unchanged then.
    pub fn remove(&mut self, indices: &[u32]) -> Result<(), Error> {
        self.rows.remove(indices)
    }

    /// How many points were given, skipped and removed ones included.
    #[must_use]
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether no points were given.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.rows.len() == 0
    }

    /// How many points were left out because they are not finite.
    #[must_use]
    pub fn skipped(&self) -> usize {
        self.skipped
    }

    /// The mean distance of a point from its 6 nearest other points, in the cloud's units. The
    /// automatic scale of the exponential inversion is a share of it. It is measured at up to 512
    /// distinct points, and is 0 where there are fewer than two.
    #[must_use]
    pub fn spacing(&self) -> f64 {
        self.rows.measures.spacing
    }

    /// The number of coordinates of a point.
    #[must_use]
    pub fn dimension(&self) -> usize {
        self.rows.dimension
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

    /// Which points are visible from at least one of `viewpoints`? See
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
        if viewpoints.is_empty() {
            check_flip(options)?;
        }
        let mut views = filled(self.rows.distinct(), 0usize)?;
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

    /// Whether each distinct point is visible, and the resolved radius and inversion.
    fn marks(
        &self,
        viewpoint: &[f64],
        options: &Options,
    ) -> Result<(Vec<bool>, ChosenRadius, Inversion), Error> {
        self.check_viewpoint(viewpoint)?;
        let inversion = self.check_options(options)?;
        let farthest = self.farthest(viewpoint)?;
        let (kernel, chosen) = resolved_kernel(inversion, options.radius, farthest, &|choice| {
            self.resolve_radius(choice, viewpoint, farthest)
        })?;
        Ok((self.mark_visible(viewpoint, kernel)?, chosen, inversion))
    }

    fn check_viewpoint(&self, viewpoint: &[f64]) -> Result<(), Error> {
        let dimension = self.rows.dimension;
        if viewpoint.len() != dimension || viewpoint.iter().any(|x| !x.is_finite()) {
            return Err(Error::ViewpointDimension { dimension });
        }
        Ok(())
    }

    fn check_options(&self, options: &Options) -> Result<Inversion, Error> {
        options.check_dimension(self.rows.dimension)?;
        options.check(QuestionKind::View)?;
        resolved_inversion(options, self.rows.measures.spacing)
    }

    fn resolve_radius(
        &self,
        choice: Radius,
        viewpoint: &[f64],
        farthest: f64,
    ) -> Result<ChosenRadius, Error> {
        let measures = &self.rows.measures;
        let r_squared = squared(viewpoint, &measures.middle) + measures.variance;
        let count = self.rows.distinct();
        let automatic = radius::closed_form(count, r_squared, measures.gap, farthest);
        let sight = Sight {
            viewpoint,
            centroid: &measures.centroid,
            automatic,
            farthest,
            reach: &|place| self.farthest(place).unwrap_or(f64::INFINITY),
            seen: &|place, kernel| self.mark_visible(place, kernel),
        };
        sight.resolve(choice)
    }

    fn mark_visible(&self, viewpoint: &[f64], kernel: Kernel) -> Result<Vec<bool>, Error> {
        let mut visible = filled(self.rows.distinct(), true)?;
        let mut flipped: Vec<f64> = with_capacity(self.rows.distinct() * self.rows.dimension)?;
        let mut numbers: Vec<usize> = with_capacity(self.rows.distinct())?;
        for point in 0..self.rows.distinct() {
            let place = self.rows.at(point);
            let s = kernel.factor(square_root(squared(place, viewpoint)));
            let start = flipped.len();
            flipped.extend(place.iter().zip(viewpoint).map(|(p, c)| (p - c) * s));
            if flipped[start..].iter().all(|x| x.is_finite()) {
                numbers.push(point);
            } else {
                flipped.truncate(start);
            }
        }
        let marks = extreme::mark_visible(&flipped, self.rows.dimension)?;
        for (point, mark) in numbers.into_iter().zip(marks) {
            visible[point] = mark;
        }
        Ok(visible)
    }

    fn farthest(&self, viewpoint: &[f64]) -> Result<f64, Error> {
        let distances = (0..self.rows.distinct()).map(|k| squared(self.rows.at(k), viewpoint));
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
        let indices = marked_indices(self.len(), visible, &[], &|k| self.rows.indices_of(k))?;
        Ok(Visibility::new(indices, self.len(), chosen, inversion))
    }
}
