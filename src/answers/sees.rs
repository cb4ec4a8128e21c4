//! Points that are not in the cloud: labels, sensors, targets. Would a point there be visible?

use alloc::vec::Vec;
use glam::DVec3;

use crate::base::allocation::with_capacity;
use crate::base::error::Error;
use crate::base::real::square_root;
use crate::cloud::growth::Growth;
use crate::cloud::point_cloud::{NonFinite, PointCloud};
use crate::cloud::points::{Given, Position, is_finite};
use crate::cloud::selection::Selection;
use crate::flip::inversion::Flip;
use crate::hull::KeptHull;
use crate::view::options::{Exponential, Inversion, Options, Radius};
use crate::view::radius::{automatic, from_radius, given};
use crate::view::resolved::{check_viewpoint, resolved_inversion, resolved_kernel};

impl PointCloud {
    /// For each position: would a point there be visible from `viewpoint`, if it was added to the
    /// cloud, alone? The cloud stays as it is, and the positions do not hide each other.
    ///
    /// The answer is exactly that of a cloud with this one point more. So an automatic radius
    /// is chosen for the cloud with the point: its spacing and its farthest distance count.
    ///
    /// One hull serves all positions. With a radius, an exponent or an inversion in numbers, a
    /// position takes one walk on the hull. Where the point changes the radius, its answer is proved
    /// from the same hull, with a look at some of the points. A new hull is made only in the rare cases
    /// where this proves nothing. Looks, noise handling and searches for a radius make new hulls for each position.
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
    /// not visible; [`Error::NoDraft`], [`Error::SampleWith`], [`Error::ScoresWith`]; otherwise as
    /// [`PointCloud::visible_from`] of the cloud with the point, such as
    /// [`Error::RadiusTooSmall`] for a position beyond the radius.
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
        options.refuse_draft("sees")?;
        if options.sample.is_some() {
            return Err(Error::SampleWith { other: "sees" });
        }
        if options.scores {
            return Err(Error::ScoresWith { other: "sees" });
        }
        check_viewpoint(viewpoint)?;
        let bad = || positions.iter().enumerate().filter(|&(_, p)| !is_finite(p));
        if let (Some((first, _)), NonFinite::Error) = (bad().next(), self.non_finite()) {
            let count = bad().count();
            return Err(Error::NonFinite { count, first });
        }
        // A position outside of the choice takes no part.
        let selection = options.selection(viewpoint);
        if !options.chooses() {
            return self.sees_some(viewpoint, positions, &selection, options);
        }
        self.on_chosen(Some(viewpoint), options, &mut |cloud, options| {
            cloud.sees_some(viewpoint, positions, &selection, options)
        })
    }

    /// The same for positions of which those in the selection take part.
    fn sees_some(
        &self,
        viewpoint: [f64; 3],
        positions: Given,
        selection: &Selection,
        options: &Options,
    ) -> Result<Vec<u8>, Error> {
        let mut seen: Vec<u8> = with_capacity(positions.len())?;
        let mut sight = Sight::new(self, viewpoint, options)?;
        for place in positions.iter() {
            let takes_part = is_finite(place) && selection.holds(place);
            if !takes_part {
                sight.check()?;
            }
            seen.push(u8::from(takes_part && sight.sees(place)?));
        }
        Ok(seen)
    }
}

/// A view of a cloud that is asked for one more point at a time.
struct Sight<'a> {
    cloud: &'a PointCloud,
    viewpoint: [f64; 3],
    options: &'a Options,
    /// The view of the cloud itself; `None` where each point needs a cloud of its own.
    own: Option<Own>,
    /// Whether a view of the cloud itself is known to be refused or not.
    is_checked: bool,
    /// Is made when a point needs it.
    growth: Option<Growth<'a>>,
}

struct Own {
    flip: Flip,
    farthest: f64,
    hull: KeptHull,
    hint: u32,
}

impl<'a> Sight<'a> {
    fn new(
        cloud: &'a PointCloud,
        viewpoint: [f64; 3],
        options: &'a Options,
    ) -> Result<Self, Error> {
        cloud.check_options(options)?;
        let needs_others = options.asks_for_looks()
            || options.denoise.or(options.vote).is_some()
            || matches!(options.radius, Radius::Search | Radius::Opposite);
        let own = if needs_others {
            None
        } else {
            let flip = cloud.view(viewpoint, options)?.flip;
            let points = &cloud.sequence.points;
            let hull = KeptHull::of(points, &cloud.blocks.levels[0], &flip)?;
            Some(Own {
                flip,
                farthest: cloud.blocks.farthest_distance(points, viewpoint)?,
                hint: hull.first_hint(),
                hull,
            })
        };
        Ok(Self {
            cloud,
            viewpoint,
            options,
            is_checked: own.is_some(),
            own,
            growth: None,
        })
    }

    /// Refuses what a view of the cloud itself refuses. For positions that take no part.
    #[cold]
    fn check(&mut self) -> Result<(), Error> {
        if !self.is_checked {
            self.cloud.visible_from(self.viewpoint, self.options)?;
            self.is_checked = true;
        }
        Ok(())
    }

    fn sees(&mut self, place: [f64; 3]) -> Result<bool, Error> {
        let flip = self.flip_with(place)?;
        let (Some(own), Some(flip)) = (&mut self.own, flip) else {
            return self.sees_added(place);
        };
        let points = &self.cloud.sequence.points;
        let blocks = &self.cloud.blocks.levels[0];
        let hides = if flip == own.flip {
            own.hull.hides(place, &mut own.hint)
        } else {
            let proved = own
                .hull
                .hides_otherwise(&flip, points, blocks, place, &mut own.hint);
            match proved {
                Some(hides) => Some(hides),
                None => {
                    let hull = KeptHull::of(points, blocks, &flip)?;
                    hull.hides(place, &mut hull.first_hint())
                }
            }
        };
        match hides {
            Some(hides) => Ok(!hides),
            None => self.sees_added(place),
        }
    }

    /// The answer of a cloud that holds the point.
    #[cold]
    fn sees_added(&self, place: [f64; 3]) -> Result<bool, Error> {
        let cloud = self.cloud.with_point(place)?;
        let seen = cloud.visible_from(self.viewpoint, self.options)?;
        Ok(seen.indices().last() == Some(&(self.cloud.len() as u32)))
    }

    /// The flip of the cloud with a point more; `None` if there is no view of the cloud itself.
    fn flip_with(&mut self, place: [f64; 3]) -> Result<Option<Flip>, Error> {
        let Some(own) = &self.own else {
            return Ok(None);
        };
        let v = DVec3::from_array(place) - DVec3::from_array(self.viewpoint);
        let farthest = own.farthest.max(square_root(v.dot(v)));
        if !farthest.is_finite() {
            let radius = None;
            return Err(Error::RadiusOverflow { radius, farthest });
        }
        let is_automatic = match self.options.inversion {
            Inversion::Spherical => self.options.radius == Radius::Auto,
            Inversion::Exponential(scale) => scale == Exponential::Auto,
            Inversion::Power(_) | Inversion::Looks(_) => false,
        };
        let statistics = if is_automatic {
            let growth = match &mut self.growth {
                Some(growth) => growth,
                empty => empty.insert(Growth::of(self.cloud)?),
            };
            growth.with(place)?
        } else {
            self.cloud.statistics
        };
        let inversion = resolved_inversion(self.options, statistics.spacing)?;
        let radius = |choice| match choice {
            Radius::Auto => {
                let radius = automatic(&statistics, self.viewpoint, farthest);
                Ok(from_radius(radius, farthest))
            }
            _ => given(choice, farthest),
        };
        let (kernel, _) = resolved_kernel(inversion, self.options.radius, farthest, &radius)?;
        Ok(Some(Flip::new(self.viewpoint, kernel)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A bumpy sphere, sampled evenly.
    fn surface() -> Vec<[f64; 3]> {
        let point = |i: u32| {
            let z = 1.0 - (2.0 * f64::from(i) + 1.0) / 3000.0;
            let turn = 2.399_963 * f64::from(i);
            let radius = 1.0 + 0.1 * libm::sin(9.0 * z + 3.0 * turn);
            let ring = square_root(1.0 - z * z);
            [ring * libm::cos(turn), ring * libm::sin(turn), z].map(|x| x * radius)
        };
        (0..3000).map(point).collect()
    }

    #[test]
    fn one_hull_answers_under_other_radii_and_agrees_with_the_hulls_of_these() {
        let cloud = PointCloud::new(&surface()).unwrap();
        let viewpoint = [0.3, 0.4, 2.5];
        let (points, blocks) = (&cloud.sequence.points, &cloud.blocks.levels[0]);
        let flip = |radius| {
            let options = Options::with_radius(radius);
            cloud.view(viewpoint, &options).unwrap().flip
        };
        let kept = KeptHull::of(points, blocks, &flip(200.0)).unwrap();
        for radius in [198.0, 201.0, 230.0] {
            let flip = flip(radius);
            let own = KeptHull::of(points, blocks, &flip).unwrap();
            let (mut hint, mut own_hint) = (kept.first_hint(), own.first_hint());
            let mut counts = [0; 3];
            for i in 0..400 {
                let turn = 7.3 * f64::from(i);
                let size = 0.2 + 0.003 * f64::from(i);
                // Many rays pass beside the surface.
                let place = [
                    libm::cos(turn),
                    libm::sin(1.7 * turn),
                    libm::cos(0.3 * turn),
                ];
                let place = place.map(|x| x * size);
                let proved = kept.hides_otherwise(&flip, points, blocks, place, &mut hint);
                let hides = own.hides(place, &mut own_hint);
                if proved.is_some() {
                    assert_eq!(proved, hides, "{place:?} with radius {radius}");
                }
                counts[proved.map_or(2, usize::from)] += 1;
            }
            let [seen, hidden, unproved] = counts;
            assert!(seen > 60 && hidden > 100 && unproved <= 2, "{counts:?}");
        }
    }
}
