//! A view divided among several threads or workers, each of which answers for its own
//! points without knowing of the others.

use glam::DVec3;

use crate::cloud::PointCloud;
use crate::division::Division;
use crate::error::Error;
use crate::hull;
use crate::inversion::{Flip, checked_distance};
use crate::options::Options;
use crate::radius;
use crate::visibility::Visibility;

/// One of several sectors that a view is divided into.
///
/// Each can be asked in a thread of its own, and none needs to know of the others:
/// see [`PointCloud::visible_in_sector`](crate::PointCloud::visible_in_sector).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sector {
    pub(crate) number: u32,
    pub(crate) count: u32,
}

impl Sector {
    /// Sector `number` of `count`; `None` unless `number` is below `count`.
    #[must_use]
    pub fn new(number: u32, count: u32) -> Option<Self> {
        (number < count).then_some(Self { number, count })
    }
}

impl PointCloud {
    /// The share of [`PointCloud::visible_from`] that falls to one sector of the view:
    /// every visible point is in the answer of exactly one of the sectors, so that all
    /// of them together are the answer, exactly.
    ///
    /// For several threads, one sector each, or several processes with the same points.
    /// Sectors take about equal time, and each a little more than its part of the
    /// whole. Clouds below some 50,000 points are faster asked at once.
    ///
    /// ```
    /// use hidden_point_removal::{Options, PointCloud, Sector};
    ///
    /// let cloud = PointCloud::new(&[[0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [1.0, 0.0, 0.0]])?;
    /// let (viewpoint, options) = ([0.0, 0.0, 5.0], Options::default());
    /// let mut indices = std::thread::scope(|scope| {
    ///     let ask = |sector| cloud.visible_in_sector(viewpoint, &options, sector);
    ///     let sectors = (0..2).filter_map(|number| Sector::new(number, 2));
    ///     let threads: Vec<_> = sectors.map(|sector| scope.spawn(move || ask(sector))).collect();
    ///     threads
    ///         .into_iter()
    ///         .map(|thread| Ok(thread.join().unwrap()?.into_indices()))
    ///         .collect::<Result<Vec<_>, _>>()
    /// })?
    /// .concat();
    /// indices.sort_unstable();
    /// assert_eq!(indices, [0, 2]);
    /// # Ok::<(), hidden_point_removal::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`PointCloud::visible_from`].
    pub fn visible_in_sector(
        &self,
        viewpoint: [f64; 3],
        options: &Options,
        sector: Sector,
    ) -> Result<Visibility, Error> {
        if viewpoint.iter().any(|x| !x.is_finite()) {
            return Err(Error::Viewpoint { viewpoint });
        }
        let points = &self.sequence.points;
        let center = DVec3::from_array(viewpoint);
        let farthest = checked_distance(self.blocks.farthest_squared(points, center))?;
        let resolved = radius::resolve(options.radius, &self.statistics, viewpoint, farthest)?;
        let flip = Flip::new(viewpoint, resolved.radius);
        let visible = if sector.count == 1 || !is_divisible(resolved.radius, farthest) {
            if sector.number > 0 {
                return self.answer(&[], resolved);
            }
            hull::mark_visible(points, &flip)?
        } else {
            let ahead = DVec3::from_array(self.statistics.centroid);
            let division = Division::new(&self.blocks, center, ahead, resolved.radius, sector)?;
            hull::mark_visible_in_sector(points, &flip, division)?
        };
        self.answer(&visible, resolved)
    }
}

/// Whether bounds of flipped points tell anything: not where squares over- or underflow,
/// nor where 2R − d keeps too few digits of d.
fn is_divisible(radius: f64, farthest: f64) -> bool {
    (1e-30..1e30).contains(&radius) && radius < 1e8 * farthest
}
