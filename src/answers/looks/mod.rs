//! Two or three looks at one cloud. Looks are exact hulls of exp(c/d), from tight to loose.
//! Each look decides only the points that it is sure of.
//!
//! INPUT    distinct points, a viewpoint, the number of looks.
//! OUTPUT   for each point whether it is visible, and a score if asked for.
//! SUMMARY  A tight hull (a large c) closes the gaps between samples of a surface, but
//!          also bridges gaps that are no surface. A loose hull (a small c) follows the
//!          samples. So a triangle of a hull may hide points only if its corners, back in
//!          their places, are as near to each other as samples are (`decide`). The hull's
//!          edges show how near samples are (`corners`). A later look has only the points
//!          that are undecided, and the triangles before them (`part`). A point that no
//!          look decides follows its neighbors (`followers`).

mod corners;
mod decide;
mod followers;
mod look;
mod part;

use alloc::vec::Vec;

use crate::base::allocation::filled;
use crate::base::error::Error;
use crate::cloud::point_cloud::PointCloud;
use crate::flip::inversion::Flip;
use crate::flip::kernel::Kernel;
use crate::hull::{self, Memory};
use followers::follow;
use look::{Look, Seen, Verdicts};
use part::Part;

/// The scale c of each look as a share of the cloud's spacing, from tight to loose. Two looks
/// leave out the middle one. Twice or half of any of these values changes the error little.
const SHARES: [f64; 3] = [0.28, 0.07, 0.02];
/// The highest score of a hull vertex, by look.
const SCORES: [f64; 3] = [1.0, 1.0, 0.9];

/// The c of each of `count` looks at a cloud of this spacing. The remaining numbers are 0.
pub(crate) fn scales(count: usize, spacing: f64) -> [f64; 3] {
    // Without a spacing there is one point at most, and any scale gives the same answer.
    let spacing = if spacing > 0.0 { spacing } else { 1.0 };
    let mut scales = [0.0; 3];
    for (number, scale) in scales.iter_mut().take(count).enumerate() {
        let share = SHARES[place(count, number)];
        *scale = (share * spacing).clamp(f64::MIN_POSITIVE, f64::MAX);
    }
    scales
}

/// The place, among the three looks, of look `number` of `count`.
fn place(count: usize, number: usize) -> usize {
    if count == 2 { 2 * number } else { number }
}

impl PointCloud {
    /// Looks `count` times from `viewpoint`. The viewpoint is checked here. The hulls are built in
    /// the room of `memory`.
    pub(crate) fn look_again(
        &self,
        memory: &mut Memory,
        viewpoint: [f64; 3],
        count: usize,
        with_scores: bool,
    ) -> Result<Seen, Error> {
        if viewpoint.iter().any(|x| !x.is_finite()) {
            return Err(Error::Viewpoint { viewpoint });
        }
        let points = &self.sequence.points;
        let farthest = self.blocks.farthest_distance(points, viewpoint)?;
        let scales = scales(count, self.statistics.spacing);
        let mut verdicts = Verdicts::new(points, with_scores)?;
        let mut part = Part::All;
        let mut is_flat = false;
        for number in 0..count {
            let (own, blocks) = match &part {
                Part::All => (points, &self.blocks),
                Part::Some { points, blocks, .. } => (points, blocks),
            };
            let scale = scales[number];
            let look = Look {
                flip: Flip::new(viewpoint, Kernel::Exponential { scale }).rescaled_for(own),
                scale,
                score: SCORES[place(count, number)],
                is_last: number + 1 == count,
            };
            // Each hull is a new one. Where points are on one sphere, several choices of triangles
            // are right. The choice must not depend on earlier questions.
            memory.forget();
            hull::mark_visible(own, &blocks.levels[0], &look.flip, None, memory)?;
            let Some(mut faces) = memory.outer_faces(own, &look.flip, farthest)? else {
                verdicts.take_flat(&look, &part, memory.visible());
                is_flat |= number == 0;
                continue;
            };
            let left = verdicts.take(&look, &mut faces, &part)?;
            if look.is_last || !verdicts.are_open() {
                break;
            }
            part = left.part(points, &part)?;
        }
        memory.forget();
        // In one plane with the viewpoint, neighbors on a ray see different things.
        if !is_flat {
            follow(&mut verdicts)?;
        }
        Ok(verdicts.finish()?)
    }
}

/// The scores of distinct points as those of the caller's indices; 0 where there is none.
pub(crate) fn scores_of_indices(cloud: &PointCloud, scores: &[f32]) -> Result<Vec<f32>, Error> {
    if scores.is_empty() {
        return Ok(Vec::new());
    }
    let mut all = filled(cloud.len(), 0.0)?;
    for (k, &score) in scores.iter().enumerate() {
        for &index in cloud.sequence.indices_of(k) {
            all[index as usize] = score;
        }
    }
    Ok(all)
}
