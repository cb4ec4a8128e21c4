//! What the points beside a point say of it, after the last look.

use alloc::vec::Vec;

use crate::answers::looks::decide::BEHIND;
use crate::answers::looks::look::{Look, SCORES, Verdict, Verdicts};
use crate::answers::looks::rays::{Ray, Rays};
use crate::base::allocation::{OutOfMemory, push, with_capacity};
use crate::base::beat;
use crate::base::real::{larger, smaller};
use crate::base::sort::sort_packed;
use crate::cloud::blocks::FANOUT;
use crate::cloud::hilbert::Pairs;
use crate::cloud::neighbors::{Nearest, Neighbors};
use crate::cloud::points::Points;
use crate::cloud::sheets::NEAR;
use crate::cloud::spatial::{Bounds, HilbertCurve};
use crate::cloud::statistics::NEIGHBORS;

/// A point that no look decided follows the majority of its decided neighbors.
pub(super) fn follow(verdicts: &mut Verdicts, points: &Points) -> Result<(), OutOfMemory> {
    let mut open: Vec<u32> = Vec::new();
    for point in 0..points.len() {
        if verdicts.is_open(point) {
            push(&mut open, point as u32)?;
        }
    }
    if open.is_empty() {
        return Ok(());
    }
    let mut shares: Vec<f64> = with_capacity(open.len())?;
    let neighbors = Neighbors::new(points)?;
    let [voters, _] = NEAR;
    let mut nearest = Nearest::with_capacity(voters)?;
    shares.extend(open.iter().map(|&point| {
        neighbors.find(point as usize, &mut nearest);
        share(&nearest, &verdicts.of)
    }));
    for (&point, &share) in open.iter().zip(&shares) {
        // NaN where no neighbor is decided.
        if share >= 0.0 {
            verdicts.decide(point as usize, share > 0.5, share);
        }
    }
    Ok(())
}

/// The share of visible points among the decided ones; NaN where none is decided.
fn share(nearest: &Nearest, verdicts: &[Verdict]) -> f64 {
    let (mut decided, mut visible) = (0usize, 0usize);
    for neighbor in nearest.found() {
        let verdict = verdicts[neighbor.index as usize];
        decided += usize::from(verdict != Verdict::Undecided);
        visible += usize::from(verdict == Verdict::Visible);
    }
    visible as f64 / decided as f64
}

impl Verdicts {
    /// Shows what would be visible if the surface moved by its thickness: points that pass close beside a
    /// visible point that is not nearer.
    #[inline(never)]
    pub(super) fn show_aside(&mut self, look: &Look, points: &Points) -> Result<(), OutOfMemory> {
        let (mut visible, mut hidden): (Vec<Ray>, Vec<Ray>) = (Vec::new(), Vec::new());
        let mut bounds = Bounds::EMPTY;
        for (point, verdict) in self.of.iter().enumerate() {
            let ray = Ray::to(look.place(points.get(point)), look.ahead, point);
            bounds.include(ray.place.to_array());
            let is_visible = *verdict == Verdict::Visible;
            push(
                if is_visible {
                    &mut visible
                } else {
                    &mut hidden
                },
                ray,
            )?;
        }
        if visible.len() < NEIGHBORS {
            return Ok(());
        }
        let thickness = look.thickness();
        let reach = |ray: &Ray| match look.ahead {
            Some(_) => thickness,
            None => thickness / ray.range,
        };
        let nearer = BEHIND * thickness;
        beside(visible, hidden, bounds, reach, nearer, |point| {
            self.decide(point, true, SCORES[1]);
        })
    }
}

/// Passes the points of hidden rays beside which one of the six nearest visible rays is within `reach`, and ends at most
/// `nearer` before them. Behind a closed surface all six are nearer. Along a curve through all directions, runs of hidden rays
/// are beside the same visible ones.
fn beside(
    visible: Vec<Ray>,
    hidden: Vec<Ray>,
    bounds: Bounds,
    reach: impl Fn(&Ray) -> f64,
    nearer: f64,
    mut pass: impl FnMut(usize),
) -> Result<(), OutOfMemory> {
    let curve = HilbertCurve::new(&bounds);
    let (keys, visible) = sorted(visible, &curve)?;
    let (places, hidden) = sorted(hidden, &curve)?;
    let mut near = Vec::new();
    let mut middle = 0;
    for run in 0..hidden.runs() {
        beat::step();
        let (rays, bounds) = hidden.run(run);
        let mut reaches = [0.0; FANOUT];
        let mut widest = 0.0;
        for ((ray, within), key) in rays.iter().zip(&mut reaches).zip(&places[run * FANOUT..]) {
            while keys.get(middle).is_some_and(|other| other < key) {
                middle += 1;
            }
            let reach = reach(ray);
            *within = smaller(reach * reach, visible.near(ray, middle));
            widest = larger(widest, *within);
        }
        visible.list(bounds, widest, &mut near)?;
        for (ray, reach) in rays.iter().zip(reaches) {
            if visible.show(ray, &near, reach, ray.range - nearer) {
                pass(ray.point as usize);
            }
        }
    }
    Ok(())
}

/// Rays along a curve through their places, and the place of each one on the curve.
fn sorted(rays: Vec<Ray>, curve: &HilbertCurve) -> Result<(Vec<u32>, Rays), OutOfMemory> {
    let pairs = Pairs::new();
    let mut packed: Vec<u64> = with_capacity(2 * rays.len())?;
    packed.extend((0..).zip(&rays).map(|(index, ray): (u64, _)| {
        // A key has a bit for each axis and level.
        curve.coarse_key(ray.place.to_array(), u32::BITS / 3, &pairs) << 32 | index
    }));
    packed.resize(2 * rays.len(), 0);
    let (packed, room) = packed.split_at_mut(rays.len());
    sort_packed(packed, 32, room);
    let mut keys = with_capacity(rays.len())?;
    keys.extend(packed.iter().map(|&packed| (packed >> 32) as u32));
    let mut along = with_capacity(rays.len())?;
    along.extend(packed.iter().map(|&packed| rays[packed as u32 as usize]));
    Ok((keys, Rays::of(along)?))
}

impl Rays {
    /// The square of a distance within which there are six rays beside a ray, by those around `middle`.
    fn near(&self, ray: &Ray, middle: usize) -> f64 {
        let around = middle.saturating_sub(FANOUT)..self.all.len().min(middle + FANOUT);
        let mut nearest = [f64::INFINITY; NEIGHBORS];
        for other in &self.all[around] {
            let mut squared = (other.place - ray.place).length_squared();
            for kept in &mut nearest {
                (*kept, squared) = (smaller(*kept, squared), larger(*kept, squared));
            }
        }
        nearest[NEIGHBORS - 1]
    }

    /// Whether one of the six nearest rays is at most the root of `reach` beside a ray, and at least `least` long.
    /// `near` lists the runs beside it.
    fn show(&self, ray: &Ray, near: &[u32], mut reach: f64, least: f64) -> bool {
        let place = ray.place.to_array();
        let mut is_found = false;
        for &run in near {
            let (rays, bounds) = self.run(run as usize);
            if self.farthest[run as usize] < least || bounds.distance_squared(place) > reach {
                continue;
            }
            for other in rays {
                let squared = (other.place - ray.place).length_squared();
                if other.range >= least && squared <= reach {
                    (is_found, reach) = (true, squared);
                }
            }
        }
        let mut before = 0;
        for &run in near {
            if !is_found || before >= NEIGHBORS {
                return false;
            }
            let (rays, bounds) = self.run(run as usize);
            if bounds.distance_squared(place) <= reach {
                let squared = |other: &Ray| (other.place - ray.place).length_squared();
                before += rays.iter().filter(|other| squared(other) < reach).count();
            }
        }
        is_found && before < NEIGHBORS
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::random::Random;

    #[test]
    fn the_six_nearest_rays_of_all_decide() {
        let mut random = Random::new(5);
        for round in 0..60 {
            let ahead = (round % 3 == 0).then_some(glam::DVec3::Z);
            let mut ray = |point: usize| {
                // Some rays are equal, some are as near as others.
                let steps = [1e3, 8.0][round % 2];
                let v = (random.direction() * steps).round() / steps * (1.0 + point as f64 / 200.0);
                Ray::to(v, ahead, point)
            };
            let visible: Vec<Ray> = (0..200).map(&mut ray).collect();
            let hidden: Vec<Ray> = (0..200).map(&mut ray).collect();
            let (reach, nearer) = (0.3 / (1 + round % 4) as f64, 0.2);
            let defined = hidden.iter().filter(|ray| {
                let squared = |other: &Ray| (other.place - ray.place).length_squared();
                let far = visible
                    .iter()
                    .filter(|other| other.range >= ray.range - nearer);
                let nearest = far.map(squared).fold(f64::INFINITY, f64::min);
                let before = visible
                    .iter()
                    .filter(|other| squared(other) < nearest)
                    .count();
                nearest <= reach * reach && before < NEIGHBORS
            });
            let defined: Vec<usize> = defined.map(|ray| ray.point as usize).collect();
            let places = visible
                .iter()
                .chain(&hidden)
                .map(|ray| ray.place.to_array());
            let (mut found, bounds) = (Vec::new(), Bounds::around(places));
            let pass = |point| found.push(point);
            beside(visible, hidden.clone(), bounds, |_| reach, nearer, pass).unwrap();
            found.sort_unstable();
            assert_eq!(found, defined, "{round}");
        }
    }
}
