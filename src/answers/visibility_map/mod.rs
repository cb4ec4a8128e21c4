//! A map of directions that a shader can test points against, while the camera moves.
//!
//! INPUT    a cloud, a viewpoint, a budget of points and of corners.
//! OUTPUT   for each corner of a grid of directions a distance; a point beyond it is hidden.
//! SUMMARY  K of a sample lies inside K of all points. So what the sample's hull hides is hidden
//!          for certain: of an even sample, the nearest points in each direction
//!          (`pool`). The reaches of the hull become distances (`depths`), or those of its triangles
//!          where the map stands in for looks (`surface`). One comparison in single precision
//!          tests a point (`hides`).

mod depths;
mod hides;
mod options;
pub(crate) mod pool;
mod surface;

use crate::answers::looks::{Depth, look_of_map, looked_at};
use crate::answers::memory::ViewMemory;
use crate::base::error::Error;
use crate::base::real::square_root;
use crate::cloud::point_cloud::PointCloud;
use crate::cloud::points::Points;
use crate::cloud::spatial::Bounds;
use crate::hull;
use crate::view::options::Options;
use crate::view::refusals::QuestionKind;
use crate::view::resolved::looks;
pub use hides::VisibilityMap;
pub use options::MapOptions;
use pool::{FEW, MapMemory, Need, Pool};
use surface::Look;

/// Distances in a map are between the first number and the last one, in the cloud's units.
const UNITS: core::ops::Range<f64> = 1e-15..1e15;

/// Without a radius a map takes one in so many of the points that are probably visible in the whole cloud: more would cost
/// much of what the exact answer costs. Looks cost more.
const ONE_IN: f64 = 12.0;
const ONE_IN_LOOKS: f64 = 2.0;
/// The most corners for each point of a map, of which there are at least `FEW`.
const CORNERS: usize = 5;

impl PointCloud {
    /// A map that shows which points are certainly hidden from `viewpoint`: cheap to make, and
    /// cheap to ask for any number of points.
    ///
    /// It never hides a point that [`PointCloud::visible_from`] shows with the same options, except
    /// with [`Inversion::Looks`](crate::Inversion::Looks): there it hides hardly any point that the looks
    /// show. It shows all visible points and some hidden ones. An
    /// [`Observer`](crate::Observer) makes further maps faster.
    ///
    /// # Errors
    /// As [`PointCloud::visible_from`]; [`Error::Excludes`] for `scores` and
    /// [`Radius::Opposite`](crate::Radius::Opposite); [`Error::OutOfRange`] and [`Error::Direction`] for `map`.
    pub fn visibility_map(
        &self,
        viewpoint: [f64; 3],
        options: &Options,
        map: &MapOptions,
    ) -> Result<VisibilityMap, Error> {
        self.visibility_map_with(&mut ViewMemory::new(), viewpoint, options, map)
    }

    #[inline(never)]
    pub(crate) fn visibility_map_with(
        &self,
        memory: &mut ViewMemory,
        viewpoint: [f64; 3],
        options: &Options,
        map: &MapOptions,
    ) -> Result<VisibilityMap, Error> {
        options.check(QuestionKind::Map)?;
        map.check()?;
        let part = self.part(Some(viewpoint), options)?;
        memory.see(options.region(Some(viewpoint))?);
        let origin = map.origin.unwrap_or(match part.sequence.points {
            Points::Single(_) => [0.0; 3],
            Points::Double(_) => self.middle(),
        });
        part.mapped(memory, viewpoint, options, map, origin)
    }

    fn mapped(
        &self,
        memory: &mut ViewMemory,
        viewpoint: [f64; 3],
        options: &Options,
        map: &MapOptions,
        origin: [f64; 3],
    ) -> Result<VisibilityMap, Error> {
        let is_look = looks(options)?.is_some();
        let mut survey = None;
        if is_look {
            survey = self.survey(options.surface, options.thickness)?;
        }
        let source = looked_at(&survey, self);
        let MapMemory { hull, pool } = &mut memory.maps;
        let is_smooth = !core::ptr::eq(source, self);
        let points = &source.sequence.points;
        let view = match is_look {
            true => None,
            false => Some(self.view(viewpoint, options)?),
        };
        let need = match &view {
            // All of them, as far as there is room.
            _ if map.towards.is_some() => Need::OneIn(1.0),
            None => Need::OneIn(ONE_IN_LOOKS),
            Some(view) if view.chosen.radius > 0.0 => Need::ForRadius(view.chosen.radius),
            Some(_) => Need::OneIn(ONE_IN),
        };
        let pool = Pool::of(pool, points, is_smooth, map, &need)?;
        let (chosen, stands_for) = pool.choose(viewpoint, map, need)?;
        let (flip, depth, farthest) = match view {
            None => {
                let apart = square_root(stands_for);
                look_of_map(self, survey.as_ref(), viewpoint, options.thickness, apart)?
            }
            Some(view) => (view.flip, Depth::default(), view.farthest),
        };
        let mut made = VisibilityMap::empty(viewpoint, origin);
        let reach = farthest + made.distance_of_origin();
        if !UNITS.contains(&farthest) || reach > UNITS.end {
            return Ok(made);
        }
        let flip = flip.rescaled_for(&chosen);
        hull::complete(&chosen, &flip, hull)?;
        let corners = map.corners.min(CORNERS * chosen.len().max(FEW));
        if is_look {
            let look = Look {
                hull,
                points: &chosen,
                flip: &flip,
                farthest,
                depth,
            };
            made.fill_by_surface(look, corners)?;
        } else if let Some(mut reaches) = hull.reaches(corners)? {
            made.fill(&mut reaches, &flip)?;
        }
        Ok(made)
    }

    /// The middle of the box; 0 for a cloud without points.
    pub(crate) fn middle(&self) -> [f64; 3] {
        let Bounds { min, max } = self.bounds;
        core::array::from_fn(|axis| {
            let middle = 0.5 * min[axis] + 0.5 * max[axis];
            if middle.is_finite() { middle } else { 0.0 }
        })
    }
}
