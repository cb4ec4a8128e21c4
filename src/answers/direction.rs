//! Orthographic views: the viewpoint recedes to infinity against a direction.
//!
//! Let the viewpoint C be at distance r, with R = a·r², and let z be the depth along the
//! direction. Every sphere around C then tends to a paraboloid. To first order, and except for
//! a common motion, the flipped points lie at depth −(z + a·(x² + y²)). So in the limit the
//! visible points are the lower boundary of conv{(x, y, z + a·(x² + y²))}. The inversion
//! exp(c/d) has the same limit, with a = 1/(2c).

use alloc::vec::Vec;
use glam::DVec3;

use crate::answers::looks::Projection;
use crate::answers::memory::ViewMemory;
use crate::answers::visibility::Visibility;
use crate::base::error::Error;
use crate::cloud::point_cloud::PointCloud;
use crate::flip::inversion::Lift;
use crate::hull;
use crate::view::options::{Exponential, Inversion, Options, Radius};
use crate::view::radius::{self, ChosenRadius};
use crate::view::refusals::QuestionKind;
use crate::view::resolved::{SEVERAL_HULLS, looks, normalized};

impl PointCloud {
    /// Which points are visible along `direction`, the direction in which an orthographic camera
    /// looks? The answer is the limit for viewpoints farther and farther back. The length of
    /// `direction` has no meaning.
    ///
    /// R grows as a·r² with the distance r. For [`Radius::Auto`] a is 0.4·n^¼/g, with n and g as
    /// there. For [`Inversion::Exponential`] a is 1/(2c). For a given radius or exponent a is R/r²,
    /// measured from the viewpoint that lies one diagonal of the bounding box before the centroid.
    /// The radius and exponent of the answer belong to this viewpoint. [`Inversion::Looks`] has a
    /// limit, too: every look has the limit of its exponential flip.
    ///
    /// Exact for (x, y, z + a·(x² + y²)) as rounded to `f64`. Coordinates are relative to a center
    /// near the middle of the bounding box, in units of a power of two near its size, along the
    /// direction and two axes across. Where `direction` is along an axis, equal coordinates stay
    /// equal.
    ///
    /// ```
    /// use hidden_point_removal::{Options, PointCloud};
    ///
    /// let cloud = PointCloud::new(&[[0.0, 0.0, 1.0], [0.0, 0.0, 2.0], [1.0, 0.0, 0.0]])?;
    /// let visible = cloud.visible_from_direction([0.0, 0.0, -1.0], &Options::default())?;
    /// assert_eq!(visible.indices(), [1, 2]);
    /// # Ok::<(), hidden_point_removal::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Direction`] for a direction that is zero or not finite;
    /// [`Error::Excludes`] for [`Inversion::Power`], [`Radius::Opposite`] and
    /// a distance in [`Options::within`]; the others of [`PointCloud::visible_from`].
    pub fn visible_from_direction(
        &self,
        direction: [f64; 3],
        options: &Options,
    ) -> Result<Visibility, Error> {
        options.check(QuestionKind::Direction)?;
        let ahead = normalized(direction).ok_or(Error::Direction { direction })?;
        let cloud = self.part(None, options)?;
        if let Some(count) = looks(options)? {
            let mut memory = ViewMemory::new();
            let projection = Projection::Parallel(ahead);
            return cloud.seen_by_looks(&mut memory, projection, count, options);
        }
        let (visible, chosen, inversion) = cloud.direction_marks(ahead, options)?;
        cloud.answer(&visible, chosen, inversion)
    }

    fn direction_marks(
        &self,
        ahead: DVec3,
        options: &Options,
    ) -> Result<(Vec<bool>, ChosenRadius, Inversion), Error> {
        let inversion = self.resolved_inversion(options)?;
        let (bend, chosen) = self.bend(ahead, options.radius, inversion)?;
        let lift = Lift::new(&self.bounds, ahead, bend);
        let points = &self.sequence.points;
        let lifted = |index: u32| lift.apply(points.get(index as usize));
        let (visible, _) = hull::lower_boundary(points.len() as u32, &lifted)?;
        Ok((visible, chosen, inversion))
    }

    /// Returns a, and its radius for the viewpoint one diagonal of the box before the centroid.
    fn bend(
        &self,
        ahead: DVec3,
        choice: Radius,
        inversion: Inversion,
    ) -> Result<(f64, ChosenRadius), Error> {
        let scale = match inversion {
            Inversion::Spherical => None,
            Inversion::Exponential(Exponential::Scale(scale)) => Some(scale),
            Inversion::Exponential(Exponential::Auto)
            | Inversion::Power(_)
            | Inversion::Looks(_) => return Err(SEVERAL_HULLS),
        };
        if let Some(scale) = scale {
            return Ok((0.5 / scale, ChosenRadius::unit(0.0)));
        }
        let statistics = &self.statistics()?;
        let diagonal = self.bounds.diagonal();
        if statistics.count == 0 {
            // There is nothing to measure. Options that other clouds refuse are refused here, too.
            let chosen = match choice {
                Radius::Auto => ChosenRadius::unit(0.0),
                _ => radius::given(choice, 0.0)?,
            };
            return Ok((1.0, chosen));
        }
        let viewpoint = DVec3::from_array(statistics.centroid) - ahead * diagonal;
        let viewpoint = viewpoint.to_array();
        let farthest = self
            .blocks
            .farthest_distance(&self.sequence.points, viewpoint)?;
        if let Radius::Auto = choice {
            let gap = radius::effective_gap(statistics, &*self.known_noise()?);
            // Without a gap any bend gives the same answer.
            let bend = if gap > 0.0 {
                radius::bend(statistics.count, gap)
            } else {
                1.0
            };
            let radius = bend * diagonal * diagonal;
            return Ok((bend, radius::bounded(radius, farthest)));
        }
        let chosen = self.chosen_radius(choice, viewpoint, farthest)?;
        Ok((chosen.radius / diagonal / diagonal, chosen))
    }
}
