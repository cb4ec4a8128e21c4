//! R by the paper's own rule. It counts visible points of hulls; it needs no ground truth.

use crate::base::error::Error;
use crate::flip::kernel::Kernel;

use crate::view::radius::{ChosenRadius, LARGEST, from_radius};

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
/// that exactly one of C and C′ sees with some radius. Returns `None` where no radius is possible.
pub(crate) fn opposite(
    least: f64,
    farthest: f64,
    look: &mut dyn FnMut(Kernel) -> Result<usize, Error>,
) -> Result<Option<ChosenRadius>, Error> {
    if !(least > 0.0 && least < LARGEST) {
        return Ok(None);
    }
    let mut evaluations = 0;
    let mut best: Option<(usize, f64)> = None;
    let mut consider = |decades: f64| -> Result<f64, Error> {
        let radius = (least * libm::pow(10.0, decades)).min(LARGEST);
        let one = look(Kernel::Spherical { radius })?;
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

    #[test]
    fn points_at_both_viewpoints_have_no_radius() {
        for least in [0.0, f64::INFINITY, f64::NAN] {
            let radius = opposite(least, 1.0, &mut |_| panic!("nothing is seen"));
            assert!(radius.is_ok_and(|radius| radius.is_none()));
        }
    }
}
