//! A map of directions that a shader can test points against, while the camera moves.
//!
//! INPUT    a cloud, a viewpoint, a budget of points and of corners.
//! OUTPUT   for each corner of a grid of directions a distance; a point beyond it is hidden.
//! SUMMARY  K of a sample lies inside K of all points. So what the sample's hull hides is hidden
//!          for certain. The sample is taken from a pool: points that the last map hid hide
//!          nothing (`pool`). The reaches of the hull become distances (`depths`), and one
//!          comparison in single precision tests a point (`hides`).

mod depths;
mod hides;
pub(crate) mod kept;
mod options;
mod pool;
mod tuned;

use crate::answers::looks::loosest_look;
use crate::answers::memory::ViewMemory;
use crate::base::error::Error;
use crate::base::real::square_root;
use crate::cloud::neighbors::distance_squared;
use crate::cloud::point_cloud::PointCloud;
use crate::cloud::points::Points;
use crate::cloud::spatial::Bounds;
use crate::hull;
use crate::view::options::Options;
use crate::view::refusals::QuestionKind;
use crate::view::resolved::looks;
pub use hides::VisibilityMap;
use kept::MapMemory;
pub use options::MapOptions;
use pool::{FEW, Pool};

/// Distances in a map are between the first number and the last one, in the cloud's units.
const UNITS: core::ops::Range<f64> = 1e-15..1e15;

/// The most corners for each point of a map, of which there are at least `FEW`.
const CORNERS: usize = 4;

/// What a map is asked about. Points may have been `moved` so far.
struct Asked<'a> {
    viewpoint: [f64; 3],
    options: &'a Options,
    map: &'a MapOptions,
    origin: [f64; 3],
    moved: f64,
}

impl PointCloud {
    /// A map that shows which points are certainly hidden from `viewpoint`: cheap to make, and
    /// cheap to ask for any number of points.
    ///
    /// It never hides a point that [`PointCloud::visible_from`] shows with the same options, except
    /// with [`Inversion::Looks`](crate::Inversion::Looks): there it is tuned so that it hides hardly
    /// any point that the looks show. It shows all visible points and some hidden ones. An
    /// [`Observer`](crate::Observer) makes better maps from the last one.
    ///
    /// # Errors
    /// As [`PointCloud::visible_from`]; [`Error::Excludes`] for `draft`, `scores`, `vote` and a
    /// radius that is searched; [`Error::OutOfRange`] and [`Error::Direction`] for `map`.
    pub fn visibility_map(
        &self,
        viewpoint: [f64; 3],
        options: &Options,
        map: &MapOptions,
    ) -> Result<VisibilityMap, Error> {
        self.visibility_map_with(&mut ViewMemory::default(), viewpoint, options, map)
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
        memory.see(options.steps(Some(viewpoint))?);
        let origin = map.origin.unwrap_or(match part.sequence.points {
            Points::Single(_) => [0.0; 3],
            Points::Double(_) => self.middle(),
        });
        let mut moved = 0.0;
        if options.denoise.is_some() {
            moved = displacement(&*self.chosen(Some(viewpoint), options)?, &part)?;
        }
        let asked = Asked {
            viewpoint,
            options,
            map,
            origin,
            moved,
        };
        let larger = match looks(options)? {
            Some(count) => part.tuned(memory, &asked, count)?,
            None => 1.0,
        };
        part.mapped(memory, &asked, larger)
    }

    /// One map. With looks, the scale of the last one is `larger` by this factor.
    fn mapped(
        &self,
        memory: &mut ViewMemory,
        asked: &Asked,
        larger: f64,
    ) -> Result<VisibilityMap, Error> {
        let &Asked {
            viewpoint,
            options,
            map,
            origin,
            moved,
        } = asked;
        let (flip, thickness, farthest) = match looks(options)? {
            None => {
                let view = self.view(viewpoint, options)?;
                (view.flip, 0.0, view.farthest)
            }
            Some(count) => {
                let thickness = options.thickness;
                let survey = memory.survey(self, thickness)?;
                loosest_look(self, survey.as_deref(), viewpoint, count, thickness, larger)?
            }
        };
        let mut made = VisibilityMap::empty(viewpoint, origin, moved);
        let reach = farthest + made.distance_of_origin();
        if !UNITS.contains(&farthest) || reach > UNITS.end {
            return Ok(made);
        }
        let MapMemory {
            hull, pool, last, ..
        } = &mut memory.maps;
        let pool = Pool::of(pool, &self.sequence.points, map)?;
        let chosen = pool.choose(viewpoint, map, options.asks_for_looks(), last.as_ref())?;
        let flip = flip.rescaled_for(&chosen);
        hull::mark_all(&chosen, &flip, hull)?;
        pool.mark(hull.visible());
        let corners = map.corners.min(CORNERS * chosen.len().max(FEW as usize));
        if let Some(reaches) = hull.reaches(corners)? {
            made.fill(&reaches, &flip, thickness)?;
        }
        *last = Some(made.clone());
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

/// How far a point of `part` is at most from its place in `chosen`.
fn displacement(chosen: &PointCloud, part: &PointCloud) -> Result<f64, Error> {
    let places = chosen.places()?;
    let mut most = 0.0f64;
    for (place, point) in part.sequence.points.iter().enumerate() {
        for &index in part.sequence.indices_of(place) {
            let before = chosen.sequence.points.get(places[index as usize] as usize);
            most = most.max(distance_squared(before, point));
        }
    }
    Ok(square_root(most) * (1.0 + 1e-12))
}
