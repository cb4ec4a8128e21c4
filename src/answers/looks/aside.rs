//! What would be visible if the surface moved by its thickness: points that pass close beside a
//! visible point that is not nearer.

use alloc::vec::Vec;

use crate::answers::looks::decide::BEHIND;
use crate::answers::looks::look::{Look, SCORES, Verdict, Verdicts};
use crate::answers::looks::rays::{Ray, Rays};
use crate::base::allocation::{OutOfMemory, push};
use crate::cloud::points::Points;
use crate::cloud::statistics::NEIGHBORS;

impl Verdicts {
    /// Shows hidden points beside visible ones.
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
