//! A map of directions that a shader can test points against, while the camera moves.
//!
//! INPUT    a cloud, a viewpoint, a budget of points.
//! OUTPUT   for each corner of a grid of directions a distance; a point beyond it is hidden.
//! SUMMARY  The nearest point in each cell of the grid is its champion (`grid`), of an even sample
//!          of the cloud (`pool`). K contains all flipped points, so what the triangles of
//!          champions hide is hidden for certain (`levels`). The bounds become distances
//!          (`distances`), or those of surfaces where the map stands in for looks (`surface`).
//!          One comparison in single precision tests a point (`hides`).

mod distances;
mod gauge;
mod grid;
mod hides;
mod levels;
mod options;
pub(crate) mod pool;
mod surface;

use crate::answers::looks::{look_of_map, looked_at};
use crate::answers::memory::ViewMemory;
use crate::answers::visibility_map::gauge::Asked;
use crate::base::error::Error;
use crate::cloud::point_cloud::PointCloud;
use crate::cloud::points::Points;
use crate::cloud::spatial::Bounds;
use crate::view::options::Options;
use crate::view::refusals::QuestionKind;
use crate::view::resolved::{check_viewpoint, looks};
pub use hides::VisibilityMap;
pub use options::MapOptions;

/// A map hides nothing where its farthest point is outside of this range, in the cloud's units: squares in single precision end at
/// 10⁻³⁸ and 10³⁸.
const UNITS: core::ops::Range<f64> = 1e-15..1e15;

impl PointCloud {
    /// A map that shows which points are certainly hidden from `viewpoint`: cheap to make, and
    /// cheap to ask for any number of points.
    ///
    /// It never hides a point that [`PointCloud::visible_from`] shows with the same options, except
    /// with [`Inversion::Looks`](crate::Inversion::Looks): there it hides hardly any point that the looks
    /// show. It shows all visible points and some hidden ones, and all points if the farthest one is nearer than 10⁻¹⁵ units or
    /// farther than 10¹⁵. An [`Observer`](crate::Observer) makes further maps faster.
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
        let mut made = VisibilityMap::empty(viewpoint, origin);
        let is_in_units = |farthest: f64| {
            UNITS.contains(&farthest) && farthest + made.distance_of_origin() <= UNITS.end
        };
        let maps = &mut memory.maps;
        if looks(options)?.is_none() {
            let view = self.view(viewpoint, options)?;
            if is_in_units(view.farthest)
                && let Some((champions, levels, _)) = maps.champions(self, 0.0, viewpoint, map)?
            {
                made.fill(&champions, levels, &Asked::Hull(&view.flip))?;
            }
            return Ok(made);
        }
        check_viewpoint(viewpoint)?;
        let survey = self.survey(options.surface, options.thickness)?;
        let source = looked_at(&survey, self);
        let moved = survey.as_ref().map_or(0.0, |survey| survey.shares[0]);
        if let Some((champions, levels, apart)) = maps.champions(source, moved, viewpoint, map)? {
            let thickness = options.thickness;
            let (kernel, depth, farthest) =
                look_of_map(self, survey.as_ref(), viewpoint, thickness, apart)?;
            if is_in_units(farthest) {
                made.fill(&champions, levels, &Asked::Looks(kernel, depth))?;
            }
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
