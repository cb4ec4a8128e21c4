//! Points that are not in the cloud: labels, sensors, targets. Would a point there be visible?

use alloc::vec::Vec;
use glam::DVec3;

use crate::answers::visibility::Visibility;
use crate::base::allocation::with_capacity;
use crate::base::beat;
use crate::base::error::Error;
use crate::base::real::square_root;
use crate::cloud::point_cloud::{NonFinite, PointCloud};
use crate::cloud::points::{Given, Position, is_finite};
use crate::flip::inversion::Flip;
use crate::hull::{self, KeptHull};
use crate::view::options::{Inversion, Options, Radius};
use crate::view::radius::ChosenRadius;
use crate::view::refusals::QuestionKind;
use crate::view::resolved::{View, check_viewpoint};

impl PointCloud {
    /// For each position: would a point there be visible from `viewpoint`, if it was added to the
    /// cloud, alone? The cloud stays as it is, and the positions do not hide each other.
    ///
    /// The answer is that of a cloud with this one point more, with the radius and the inversion of
    /// the view without it. A position farther than the radius is not visible, nor one outside of
    /// [`Options::within`].
    ///
    /// One hull serves all positions, and a position takes one walk on it. Looks make new hulls
    /// for each position.
    ///
    /// ```
    /// use hidden_point_removal::{Options, PointCloud};
    ///
    /// let wall: Vec<_> = (0..400).map(|i| [f64::from(i % 20), f64::from(i / 20), 0.0]).collect();
    /// let cloud = PointCloud::new(&wall)?;
    /// let labels = [[9.5, 9.5, 3.0], [9.5, 9.5, -3.0]];
    /// let seen = cloud.sees([10.0, 10.0, 40.0], &labels, &Options::default())?;
    /// assert_eq!(seen, [true, false]);
    /// # Ok::<(), hidden_point_removal::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NonFinite`] for the positions, unless the cloud skips such points: then they are
    /// not visible; [`Error::Excludes`] for scores; otherwise as
    /// [`PointCloud::visible_from`].
    pub fn sees<P: Position>(
        &self,
        viewpoint: [f64; 3],
        positions: &[P],
        options: &Options,
    ) -> Result<Vec<bool>, Error> {
        let seen = self.sees_given(viewpoint, P::given(positions), options)?;
        Ok(seen.iter().map(|&seen| seen != 0).collect())
    }

    /// The same, as 1 or 0.
    #[inline(never)]
    pub(crate) fn sees_given(
        &self,
        viewpoint: [f64; 3],
        positions: Given,
        options: &Options,
    ) -> Result<Vec<u8>, Error> {
        options.check(QuestionKind::Sees)?;
        check_viewpoint(viewpoint)?;
        let bad = || positions.iter().enumerate().filter(|&(_, p)| !is_finite(p));
        if let (Some((first, _)), NonFinite::Error) = (bad().next(), self.non_finite()) {
            let count = bad().count();
            return Err(Error::NonFinite { count, first });
        }
        let Options { within, .. } = *options;
        let region = within.unwrap_or_default().region(Some(viewpoint))?;
        let part = self.part(Some(viewpoint), options)?;
        let mut view = OpenView::new(&part, viewpoint, options)?;
        let mut seen: Vec<u8> = with_capacity(positions.len())?;
        for place in positions.iter() {
            beat::step();
            let takes_part = is_finite(place) && region.is_none_or(|region| region.holds(place));
            seen.push(u8::from(takes_part && view.sees(place)?));
        }
        Ok(seen)
    }
}

/// A view of a cloud that is asked for one more point at a time.
struct OpenView<'a> {
    cloud: &'a PointCloud,
    viewpoint: [f64; 3],
    /// The options, with numbers only.
    options: Options,
    /// The largest distance at which a point may be seen.
    reach: f64,
    /// `None` where each point needs a hull of its own.
    hull: Option<OneHull>,
}

struct OneHull {
    flip: Flip,
    hull: KeptHull,
    hint: u32,
}

impl<'a> OpenView<'a> {
    fn new(cloud: &'a PointCloud, viewpoint: [f64; 3], options: &Options) -> Result<Self, Error> {
        cloud.check_options(options)?;
        let mut open = Self {
            cloud,
            viewpoint,
            options: options.of_all(),
            reach: f64::MAX,
            hull: None,
        };
        if options.asks_for_looks() {
            return Ok(open);
        }
        let View {
            flip,
            chosen,
            inversion,
            ..
        } = cloud.view(viewpoint, options)?;
        open.options.inversion = inversion;
        if inversion == Inversion::Spherical {
            open.options.radius = Radius::Absolute(chosen.radius);
            open.reach = chosen.radius;
        }
        let points = &cloud.sequence.points;
        let hull = KeptHull::of(points, &cloud.blocks.levels[0], &flip)?;
        let hint = hull.first_hint();
        open.hull = Some(OneHull { flip, hull, hint });
        Ok(open)
    }

    fn sees(&mut self, place: [f64; 3]) -> Result<bool, Error> {
        let v = DVec3::from_array(place) - DVec3::from_array(self.viewpoint);
        let distance = square_root(v.dot(v));
        if distance > self.reach {
            return Ok(false);
        }
        if self.reach == 0.0 {
            // All points are at the viewpoint.
            return Ok(true);
        }
        let Some(OneHull { flip, hull, hint }) = &mut self.hull else {
            let cloud = self.cloud.with_point(place)?;
            let seen = cloud.visible_from(self.viewpoint, &self.options)?;
            return Ok(self.holds_new(&seen));
        };
        if let Some(hides) = hull.hides(place, hint) {
            return Ok(!hides);
        }
        let flip = *flip;
        let cloud = self.cloud.with_point(place)?;
        let visible = hull::visible_once(&cloud.sequence.points, &flip)?;
        let chosen = ChosenRadius::unit(0.0);
        let seen = cloud.answer(&visible, chosen, self.options.inversion)?;
        Ok(self.holds_new(&seen))
    }

    /// Whether the point that was added last is visible.
    fn holds_new(&self, seen: &Visibility) -> bool {
        seen.indices().last() == Some(&(self.cloud.len() as u32))
    }
}
