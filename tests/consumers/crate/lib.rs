//! Asks one question.
#![no_std]

extern crate alloc;

use alloc::vec::Vec;
use hidden_point_removal::{Error, Options, PointCloud};

/// The indices of the visible points.
pub fn visible(positions: &[[f32; 3]], viewpoint: [f64; 3]) -> Result<Vec<u32>, Error> {
    let cloud = PointCloud::new(positions)?;
    let seen = cloud.visible_from(viewpoint, &Options::default())?;
    Ok(seen.indices().to_vec())
}
