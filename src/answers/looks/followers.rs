//! A point that no look decided follows the majority of its decided neighbors.

use alloc::vec::Vec;

use crate::answers::looks::look::{Verdict, Verdicts};
use crate::base::allocation::{OutOfMemory, push, with_capacity};
use crate::cloud::neighbors::{Nearest, Neighbors};
use crate::cloud::points::Points;
use crate::cloud::sheets::NEAR;

/// How many of them must be decided at least.
const DECIDED: usize = 2;
/// The number of rounds. A point that was decided in one round is asked in the next.
const ROUNDS: usize = 2;

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
