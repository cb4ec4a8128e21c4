//! Points and viewpoints that differ in at most three coordinates: in the subspace of these
//! coordinates, they are a cloud in space.

use alloc::vec::Vec;

use crate::base::allocation::{OutOfMemory, filled, with_capacity};
use crate::base::error::Error;
use crate::cloud::point_cloud::{NonFinite, PointCloud};
use crate::dimensions::flat::columns;
use crate::dimensions::rows::Rows;

/// The cloud and the viewpoints in the subspace.
type InSpace = (PointCloud, Vec<[f64; 3]>);

/// `None` if the points and the viewpoints differ in more coordinates.
#[inline(never)]
pub(super) fn in_space(rows: &Rows, viewpoints: &[&[f64]]) -> Result<Option<InSpace>, Error> {
    let Some(first) = viewpoints.first() else {
        return Ok(None);
    };
    let differs = |axis: usize| {
        let x = first[axis];
        (0..rows.distinct()).any(|point| rows.at(point)[axis] != x)
            || viewpoints.iter().any(|viewpoint| viewpoint[axis] != x)
    };
    let mut kept = filled(rows.dimension, false)?;
    let mut count = 0;
    // Where they differ in fewer than three coordinates, any others follow.
    for own in [true, false] {
        for (axis, kept) in kept.iter_mut().enumerate() {
            if differs(axis) == own && (own || count < 3) {
                *kept = true;
                count += 1;
            }
        }
    }
    if count > 3 {
        return Ok(None);
    }
    let mut positions = columns(&rows.coordinates, &kept)?;
    for (place, present) in positions.chunks_exact_mut(3).zip(&rows.present) {
        if !present {
            place.fill(f64::NAN);
        }
    }
    let cloud = PointCloud::with_non_finite(&in_threes(&positions)?, NonFinite::Skip)?;
    let mut places: Vec<f64> = with_capacity(3 * viewpoints.len())?;
    for viewpoint in viewpoints {
        places.extend_from_slice(&columns(viewpoint, &kept)?);
    }
    Ok(Some((cloud, in_threes(&places)?)))
}

#[inline(never)]
fn in_threes(numbers: &[f64]) -> Result<Vec<[f64; 3]>, OutOfMemory> {
    let mut places = filled(numbers.len() / 3, [0.0; 3])?;
    places.as_flattened_mut().copy_from_slice(numbers);
    Ok(places)
}
