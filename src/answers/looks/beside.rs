//! What the points beside a point say of it, after the last look.

use alloc::vec::Vec;

use crate::answers::looks::decide::BEHIND;
use crate::answers::looks::look::{Look, SCORES, Verdict, Verdicts};
use crate::answers::looks::rays::{Ray, Rays};
use crate::base::allocation::{OutOfMemory, push, with_capacity};
use crate::cloud::neighbors::{Nearest, Neighbors};
use crate::cloud::points::Points;
use crate::cloud::sheets::NEAR;
use crate::cloud::statistics::NEIGHBORS;

/// How many neighbors of a point must be decided at least.
const DECIDED: usize = 2;
/// The number of rounds. A point that was decided in one round is asked in the next.
const ROUNDS: usize = 2;

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
    for _ in 0..ROUNDS {
        shares.clear();
        shares.extend(open.iter().map(|&point| {
            neighbors.find(point as usize, &mut nearest);
            share(&nearest, &verdicts.of)
        }));
        let mut left = 0;
        for place in 0..open.len() {
            let (point, share) = (open[place], shares[place]);
            if share >= 0.0 {
                verdicts.decide(point as usize, share > 0.5, share);
            } else {
                open[left] = point;
                left += 1;
            }
        }
        open.truncate(left);
    }
    Ok(())
}

/// The share of visible points among the decided ones; −1 where too few are decided.
fn share(nearest: &Nearest, verdicts: &[Verdict]) -> f64 {
    let (mut decided, mut visible) = (0usize, 0usize);
    for neighbor in nearest.found() {
        let verdict = verdicts[neighbor.index as usize];
        decided += usize::from(verdict != Verdict::Undecided);
        visible += usize::from(verdict == Verdict::Visible);
    }
    if decided >= DECIDED {
        visible as f64 / decided as f64
    } else {
        -1.0
    }
}

impl Verdicts {
    /// Shows what would be visible if the surface moved by its thickness: points that pass close beside a
    /// visible point that is not nearer.
    #[inline(never)]
    pub(super) fn show_aside(&mut self, look: &Look, points: &Points) -> Result<(), OutOfMemory> {
        let ray = |point: usize| Ray::to(look.place(points.get(point)), look.ahead, point);
        let mut visible: Vec<Ray> = Vec::new();
        for (point, verdict) in self.of.iter().enumerate() {
            if *verdict == Verdict::Visible {
                push(&mut visible, ray(point))?;
            }
        }
        let visible = Rays::of(visible)?;
        if visible.len() < NEIGHBORS {
            return Ok(());
        }
        let thickness = look.thickness();
        for point in 0..points.len() {
            if self.of[point] == Verdict::Visible {
                continue;
            }
            let ray = ray(point);
            let reach = if look.ahead.is_some() {
                thickness
            } else {
                thickness / ray.range
            };
            if visible.show(&ray, reach, BEHIND * thickness) {
                self.decide(point, true, SCORES[1]);
            }
        }
        Ok(())
    }
}

impl Rays {
    /// Whether one of the six rays that are nearest by direction passes within `reach` of the ray of a
    /// point, and ends at most `nearer` before it. Behind a closed surface all six are nearer.
    fn show(&self, ray: &Ray, reach: f64, nearer: f64) -> bool {
        let mut nearest = f64::INFINITY;
        let range = ray.range - nearer;
        self.visit(ray.place, range, reach * reach, &mut |squared, _| {
            nearest = squared;
            Some(squared)
        });
        if nearest == f64::INFINITY {
            return false;
        }
        let mut before = 0;
        self.visit(ray.place, f64::NEG_INFINITY, nearest, &mut |squared, _| {
            before += usize::from(squared < nearest);
            (before >= NEIGHBORS).then_some(-1.0)
        });
        before < NEIGHBORS
    }
}
