//! R by search. The search counts visible points of hulls; it needs no ground truth.

use crate::base::error::Error;
use crate::flip::kernel::Kernel;

use crate::view::radius::{ChosenRadius, LARGEST, bounded, from_radius};

/// The penalty λ of a point that is seen from both sides; a point that is seen counts 1.
const BOTH: f64 = 5.0;
/// The distance between the three radii of the antipodal search, in decades. The result stays
/// between the outer two, because a parabola through a step function exaggerates.
const BRACKET: f64 = 0.25;

/// The antipodal search. From the other end of every ray, exactly the points that are hidden
/// from here should be visible: q = (2R + d)·u reverses the depth order along the same rays.
/// The score of a radius is V + V′ − λ·B, where V counts the points seen from here, V′ those
/// seen from there, and B those seen from both. The search takes the top of the parabola
/// through the scores of three radii around the closed form.
///
/// Where the score is negative, most rays hold one point only, as inside a room. Such rays
/// say nothing about R, and the closed form stays.
///
/// The paper's own rule looks from one point on the other side instead. Perspective then
/// hides a band of points from both; see `opposite`.
///
/// `start` is the closed form. `look` counts the points that a spherical and an antipodal flip
/// of some radius show.
pub(crate) fn antipodal(
    start: f64,
    farthest: f64,
    look: &mut dyn FnMut([Kernel; 2]) -> Result<Seen, Error>,
) -> Result<ChosenRadius, Error> {
    if !(farthest > 0.0 && start > 0.0) {
        return Ok(from_radius(start, farthest));
    }
    let step = libm::pow(10.0, BRACKET);
    let middle = start.max(farthest * step).min(LARGEST / step);
    if middle < farthest {
        // At the end of the range there is no room for three radii.
        return Ok(from_radius(start, farthest));
    }
    let mut score = |radius: f64| -> Result<f64, Error> {
        let seen = look([Kernel::Spherical { radius }, Kernel::Antipodal { radius }])?;
        Ok(seen.one as f64 + (2.0 - BOTH) * seen.both as f64)
    };
    let low = score((middle / step).max(farthest))?;
    let center = score(middle)?;
    let high = score(middle * step)?;
    let radius = if center > 0.0 {
        middle * libm::pow(10.0, summit(low, center, high))
    } else {
        start
    };
    Ok(ChosenRadius {
        evaluations: 6,
        ..bounded(radius, farthest)
    })
}

/// The place of the top of the parabola through the scores at −BRACKET, 0 and BRACKET.
fn summit(low: f64, center: f64, high: f64) -> f64 {
    let bend = 2.0 * center - low - high;
    let ascent = high - low;
    if ascent == 0.0 {
        0.0
    } else if bend > 0.0 {
        // Not `clamp`, whose panic brings the formatting of numbers.
        let top = (0.5 * BRACKET * ascent / bend).max(-BRACKET);
        top.min(BRACKET)
    } else {
        BRACKET.copysign(ascent)
    }
}

/// The numbers of distinct points that two flips show.
pub(crate) struct Seen {
    /// By exactly one of them.
    one: usize,
    both: usize,
}

impl Seen {
    pub(crate) fn count(a: &[bool], b: &[bool]) -> Self {
        let pairs = || a.iter().zip(b);
        Self {
            one: pairs().filter(|(a, b)| a != b).count(),
            both: pairs().filter(|(a, b)| **a && **b).count(),
        }
    }
}

/// The steps of the paper's rule, in decades above the least radius: first every half decade,
/// then ever closer around the best one.
const COARSE: f64 = 0.5;
const COARSE_STEPS: u8 = 12;
const FINE: [f64; 3] = [0.25, 0.125, 0.0625];

/// The paper's own rule (§4). C′ is the mirror image of C in the cloud's centroid. The rule
/// takes the R for which the most points are seen by exactly one of the two. The paper
/// descends a gradient; here the optimum is bracketed, because the objective is a step
/// function.
///
/// `least` is the larger of the farthest distances from C and from C′. `look` counts the points
/// that C and C′ see with some radius. Returns `None` where no radius is possible.
pub(crate) fn opposite(
    least: f64,
    farthest: f64,
    look: &mut dyn FnMut(Kernel) -> Result<Seen, Error>,
) -> Result<Option<ChosenRadius>, Error> {
    if !(least > 0.0 && least < LARGEST) {
        return Ok(None);
    }
    let mut evaluations = 0;
    let mut best: Option<(usize, f64)> = None;
    let mut consider = |decades: f64| -> Result<f64, Error> {
        let radius = (least * libm::pow(10.0, decades)).min(LARGEST);
        let one = look(Kernel::Spherical { radius })?.one;
        evaluations += 2;
        let better = match best {
            Some((most, at)) => one > most || one == most && decades < at,
            None => true,
        };
        if better {
            best = Some((one, decades));
        }
        Ok(best.map_or(decades, |(_, at)| at))
    };
    let mut at = 0.0;
    for step in 0..=COARSE_STEPS {
        at = consider(COARSE * f64::from(step))?;
    }
    for step in FINE {
        let center = at;
        if center >= step {
            consider(center - step)?;
        }
        at = consider(center + step)?;
    }
    let radius = (least * libm::pow(10.0, at)).min(LARGEST);
    Ok(Some(ChosenRadius {
        evaluations,
        ..from_radius(radius, farthest)
    }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cloud::points::Points;
    use crate::flip::inversion::Flip;
    use crate::hull::visible_once;

    #[test]
    fn looking_back_along_the_rays_the_farthest_wins() {
        // Two shells around the viewpoint: every ray holds one point of each.
        let mut points = alloc::vec::Vec::new();
        for i in 0..26 {
            let i = if i < 13 { i } else { i + 1 };
            let direction = [i % 3, i / 3 % 3, i / 9].map(|x| f64::from(x as u8) - 1.0);
            points.extend([1.0, 4.0].map(|times| direction.map(|x| x * times)));
        }
        let points = Points::Double(points);
        let at = |kernel| visible_once(&points, &Flip::new([0.0; 3], kernel)).unwrap();
        let radius = 20.0;
        let near = at(Kernel::Spherical { radius });
        let far = at(Kernel::Antipodal { radius });
        for ray in 0..26 {
            assert_eq!(near[2 * ray..2 * ray + 2], [true, false]);
            assert_eq!(far[2 * ray..2 * ray + 2], [false, true]);
        }
    }

    #[test]
    fn summits_are_found_between_the_outer_radii() {
        assert_eq!(summit(1.0, 2.0, 1.0), 0.0);
        assert_eq!(summit(0.0, 0.75, 1.0), BRACKET);
        assert_eq!(summit(3.0, 4.0, 3.5), 0.5 * BRACKET / 3.0);
        assert_eq!(summit(3.0, 2.0, 1.0), -BRACKET);
        assert_eq!(summit(3.0, 2.0, 4.0), BRACKET);
        assert_eq!(summit(2.0, 2.0, 2.0), 0.0);
    }

    #[test]
    fn points_at_both_viewpoints_have_no_radius() {
        for least in [0.0, f64::INFINITY, f64::NAN] {
            let radius = opposite(least, 1.0, &mut |_| panic!("nothing is seen"));
            assert!(radius.is_ok_and(|radius| radius.is_none()));
        }
    }
}
