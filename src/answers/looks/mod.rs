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
//!          look decides follows its neighbors (`beside`). The looks may be taken in several steps
//!          (`series`).

mod beside;
mod corners;
mod decide;
mod look;
mod part;
mod rays;
mod series;
mod survey;
mod tuning;

use alloc::vec::Vec;

use crate::base::allocation::filled;
use crate::base::error::Error;
use crate::cloud::point_cloud::PointCloud;
pub(crate) use corners::{Corners, Triangle};
pub(crate) use look::Seen;
pub(crate) use rays::Projection;
pub(crate) use series::{Depth, Question, Series, even_scales, look_of_map, looked_at};

/// The scores of distinct points as those of the caller's indices; 0 where there is none.
pub(crate) fn scores_of_indices(cloud: &PointCloud, scores: &[f32]) -> Result<Vec<f32>, Error> {
    let mut all = filled(cloud.len(), 0.0)?;
    for (k, &score) in scores.iter().enumerate() {
        for &index in cloud.sequence.indices_of(k) {
            all[index as usize] = score;
        }
    }
    Ok(all)
}
