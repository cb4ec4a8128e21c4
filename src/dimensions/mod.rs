//! Clouds of four and more dimensions: the same definition and flip.

mod extreme;
mod flat;
mod residues;
mod rows;

use alloc::vec::Vec;

use self::flat::Frame;
use self::rows::{Rows, in_space, squared};
use crate::answers::visibility::{Visibility, marked_indices};
use crate::base::allocation::{filled, with_capacity};
use crate::base::error::{Error, in_range};
use crate::base::real::square_root;
use crate::cloud::point_cloud::NonFinite;
use crate::flip::kernel::Kernel;
use crate::view::options::{Inversion, Options, Radius};
use crate::view::radius::{self, ChosenRadius};
use crate::view::refusals::QuestionKind;
use crate::view::resolved::{RadiusInput, check_flip, resolved_inversion, resolved_kernel};

/// The largest dimension of a [`PointCloudNd`].
pub const MAX_DIMENSION: usize = 64;

/// A point cloud of four or more dimensions.
///
/// Answers follow the same definition and the same flip as those of
/// [`PointCloud`](crate::PointCloud), and are exact as well. A small linear program decides each
/// point. The order of the input and duplicates do not matter. With n points, v of them visible, a
/// query takes O(n·v·D) time: seconds for ten thousand points.
///
/// There is one tolerance. If all points and the viewpoint lie in one flat (a plane, a
/// space, …) except for rounding, up to 32 times the rounding of their coordinates, then they are
/// answered in this flat. Where they lie beside it, [`Visibility::exact`] is false. If they differ
/// in three coordinates only, the answer has the bits of `PointCloud`.
pub struct PointCloudNd {
    rows: Rows,
    non_finite: NonFinite,
    skipped: usize,
}

/// Whether each distinct point is visible, and whether all signs were certain.
struct Marks {
    visible: Vec<bool>,
    exact: bool,
}

impl PointCloudNd {
    /// Prepares `coordinates`, `dimension` numbers a point.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] unless 4 ≤ `dimension` ≤ [`MAX_DIMENSION`] (there is
    /// [`PointCloud`](crate::PointCloud) for less); [`Error::PositionsLength`]; the others of
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
    /// [`PointCloud::visible_from`](crate::PointCloud::visible_from), with the
    /// tolerance of [`PointCloudNd`].
    ///
    /// # Errors
    /// [`Error::ViewpointDimension`]; [`Error::Dimension`] for [`Options::within`]; the others of `PointCloud::visible_from`.
    pub fn visible_from(&self, viewpoint: &[f64], options: &Options) -> Result<Visibility, Error> {
        self.visible_from_any(&[viewpoint], options)
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
        if let Some((cloud, places)) = in_space(&self.rows, &[viewpoint])? {
            return cloud.auto_radius(places[0], rule);
        }
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
        for viewpoint in viewpoints {
            self.check_viewpoint(viewpoint)?;
        }
        if let Some((cloud, places)) = in_space(&self.rows, viewpoints)? {
            return cloud.visible_from_at_least(k, &places, options);
        }
        let mut views = filled(self.rows.distinct(), 0usize)?;
        let mut chosen = ChosenRadius::unit(0.0);
        let mut exact = true;
        for viewpoint in viewpoints {
            let (marks, view) = self.marks(viewpoint, inversion, options.radius)?;
            for (views, visible) in views.iter_mut().zip(marks.visible) {
                *views += usize::from(visible);
            }
            exact &= marks.exact;
            chosen = chosen.joined(view);
        }
        let mut visible = filled(views.len(), false)?;
        for (visible, views) in visible.iter_mut().zip(views) {
            *visible = views >= k;
        }
        self.answer(&Marks { visible, exact }, chosen, inversion)
    }

    /// The answer for distinct points, and the resolved radius.
    fn marks(
        &self,
        viewpoint: &[f64],
        inversion: Inversion,
        radius: Radius,
    ) -> Result<(Marks, ChosenRadius), Error> {
        let farthest = self.farthest(viewpoint)?;
        let (kernel, chosen) = resolved_kernel(inversion, radius, farthest, &|choice| {
            self.resolve_radius(choice, viewpoint, farthest)
        })?;
        Ok((self.mark_visible(viewpoint, kernel)?, chosen))
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
        let input = RadiusInput {
            viewpoint,
            centroid: &measures.centroid,
            automatic,
            farthest,
            reach: &|place| self.farthest(place).unwrap_or(f64::INFINITY),
            seen: &|place, kernel| Ok(self.mark_visible(place, kernel)?.visible),
        };
        input.resolve(choice)
    }

    fn mark_visible(&self, viewpoint: &[f64], kernel: Kernel) -> Result<Marks, Error> {
        let dimension = self.rows.dimension;
        let mut visible = filled(self.rows.distinct(), true)?;
        let mut flipped: Vec<f64> = with_capacity(self.rows.distinct() * dimension)?;
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
        let mut frame = Frame::new(&flipped, dimension)?;
        let mut exact = true;
        if let Some(axes) = self.rows.flat.axes(viewpoint)? {
            // Rounding has lifted points off the flat.
            if frame.corners.len() > axes.iter().filter(|kept| **kept).count() {
                frame = Frame::of_columns(&flipped, &axes)?;
                exact = false;
            }
        }
        let marks = extreme::mark_visible(frame, numbers.len())?;
        for (point, mark) in numbers.into_iter().zip(marks) {
            visible[point] = mark;
        }
        Ok(Marks { visible, exact })
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
        marks: &Marks,
        chosen: ChosenRadius,
        inversion: Inversion,
    ) -> Result<Visibility, Error> {
        let indices = marked_indices(self.len(), &marks.visible, &[], &|k| {
            self.rows.indices_of(k)
        })?;
        let answer = Visibility::new(indices, self.len(), chosen, inversion);
        Ok(answer.if_exact(marks.exact))
    }
}
