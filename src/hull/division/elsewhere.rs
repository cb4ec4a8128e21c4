//! Points that are stored elsewhere. Only boxes that hold them are known.

use alloc::vec::Vec;
use glam::DVec3;

use super::alike::Alike;
use super::cone::Cone;
use crate::base::allocation::{OutOfMemory, with_capacity};
use crate::base::real::square_root;
use crate::cloud::blocks::FANOUT;
use crate::flip::inversion::Flip;

/// A box: the corner with the least coordinates and the corner with the largest ones.
type Corners = [[f64; 3]; 2];

/// A bound of all roundings in the distance of a box, relative to its coordinates.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Boxes of points, and which of them can be above a plane.
pub(crate) struct Elsewhere {
    /// The cones of the boxes, and of the nodes above them. Empty boxes are above no plane.
    levels: Vec<Vec<Cone>>,
    /// Boxes that count as above every plane, since no plane is certain for their points.
    everywhere: Vec<u32>,
    alike: Alike,
}

impl Elsewhere {
    /// `flip` is scaled as the hull is. Its planes are certain for flipped points up to half of
    /// its reach.
    #[inline(never)]
    pub(crate) fn new(boxes: &[Corners], flip: &Flip) -> Result<Self, OutOfMemory> {
        let mut cones = with_capacity(boxes.len())?;
        let mut everywhere = with_capacity(boxes.len())?;
        let mut spread = 0.0;
        for (number, corners) in (0..).zip(boxes) {
            let mut cone = cone_of(corners, flip);
            if cone.is_everywhere() || cone.reach > 0.5 * flip.reach() {
                everywhere.push(number);
                // Among the cones it is above no plane.
                cone.reach = 0.0;
            }
            spread += cone.spread();
            cones.push(cone);
        }
        let spread = spread / boxes.len().max(1) as f64;
        let mut bounds: Vec<Corners> = with_capacity(boxes.len())?;
        bounds.extend_from_slice(boxes);
        let mut levels = Vec::new();
        while cones.len() > FANOUT {
            bounds = joined(&bounds)?;
            let mut above = with_capacity(bounds.len())?;
            for (corners, below) in bounds.iter().zip(cones.chunks(FANOUT)) {
                let mut cone = cone_of(corners, flip);
                // The node may hold boxes that are everywhere. Its cone is for the others.
                let most = |reach: f64, below: &Cone| {
                    if below.reach > reach {
                        below.reach
                    } else {
                        reach
                    }
                };
                cone.reach = below.iter().fold(0.0, most);
                above.push(cone);
            }
            levels.try_reserve(1)?;
            levels.push(core::mem::replace(&mut cones, above));
        }
        levels.try_reserve(1)?;
        levels.push(cones);
        Ok(Self {
            alike: Alike::new(spread, levels.len())?,
            levels,
            everywhere,
        })
    }

    /// How many boxes there are.
    pub(crate) fn len(&self) -> usize {
        self.levels[0].len()
    }

    /// Calls `found` with the number of each box that may hold points above a plane. A point q with
    /// m·q below the limit is not above it.
    pub(crate) fn above(
        &mut self,
        (m, limit): (DVec3, f64),
        found: &mut dyn FnMut(u32),
    ) -> Result<(), OutOfMemory> {
        if limit <= 0.0 {
            // The plane says nothing.
            (0..self.len() as u32).for_each(found);
            return Ok(());
        }
        let length = square_root(m.dot(m));
        self.alike
            .turn_to((m, limit), length, &self.levels, |_, _| false)?;
        let cones = &self.levels[0];
        let may_be_above = |leaf: &&u32| cones[**leaf as usize].bound(m, length) >= limit;
        let leaves = self.alike.leaves.iter().filter(may_be_above);
        leaves
            .chain(&self.everywhere)
            .for_each(|&number| found(number));
        Ok(())
    }
}

/// Each `FANOUT` boxes as one.
fn joined(boxes: &[Corners]) -> Result<Vec<Corners>, OutOfMemory> {
    let mut all = with_capacity(boxes.len().div_ceil(FANOUT))?;
    for run in boxes.chunks(FANOUT) {
        let mut whole = run[0];
        for [low, high] in run {
            for axis in 0..3 {
                whole[0][axis] = whole[0][axis].min(low[axis]);
                whole[1][axis] = whole[1][axis].max(high[axis]);
            }
        }
        all.push(whole);
    }
    Ok(all)
}

/// The cone of the flipped points of a box. A cone is convex. So one that holds the corners holds
/// the box.
fn cone_of([low, high]: &Corners, flip: &Flip) -> Cone {
    let viewpoint = flip.viewpoint();
    let low = DVec3::from_array(*low) - viewpoint;
    let high = DVec3::from_array(*high) - viewpoint;
    let corners: [DVec3; 8] = core::array::from_fn(|corner| {
        let of = |axis: usize| {
            if corner >> axis & 1 == 0 {
                low[axis]
            } else {
                high[axis]
            }
        };
        DVec3::new(of(0), of(1), of(2))
    });
    let mut cone = Cone::around(&corners);
    let nearest = DVec3::ZERO.clamp(low, high);
    let distance = square_root(nearest.dot(nearest));
    // Squares must not have underflowed. The comparison also refuses a NaN.
    cone.reach = if distance > 1e-100 {
        flip.most_beyond(distance * (1.0 - ROUNDING))
    } else {
        f64::INFINITY
    };
    cone
}
