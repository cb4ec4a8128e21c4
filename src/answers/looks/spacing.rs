//! The distance between neighboring samples of a surface, measured by the edges of a hull. It
//! needs no search for neighbors, and the points behind the surface do not count.

use alloc::vec::Vec;

use crate::base::allocation::{OutOfMemory, filled, with_capacity};
use crate::base::real::square_root;
use crate::base::sort::sort_keyed;
use crate::cloud::neighbors::distance_squared;
use crate::cloud::points::Points;
use crate::hull::OuterFaces;

/// The number of edges of a vertex that count: its shortest ones.
const EDGES: usize = 3;
/// Their mean times this factor is the mean distance to the nearest points, on scanned surfaces.
const SHARE: f64 = 0.9;

/// The local spacing of every point. For a point on the hull, it is [`SHARE`] × the mean of its
/// three shortest edges in the hull. For other points, it is the median of these spacings.
/// Where there is no hull, it is the cloud's own spacing.
pub(super) fn local(
    points: &Points,
    faces: Option<&OuterFaces>,
    of_cloud: f64,
) -> Result<Vec<f64>, OutOfMemory> {
    let Some(faces) = faces else {
        return filled(points.len(), of_cloud);
    };
    // Squared, ascending.
    let mut shortest = filled(points.len(), [f64::INFINITY; EDGES])?;
    for [a, b] in faces.edges() {
        let [from, to] = [a, b].map(|point| points.get(point as usize));
        let squared = distance_squared(from, to);
        keep(&mut shortest[a as usize], squared);
        keep(&mut shortest[b as usize], squared);
    }
    let mut spacing = with_capacity(points.len())?;
    spacing.extend(shortest.iter().map(mean));
    let median = SHARE * median(&spacing)?;
    for spacing in &mut spacing {
        *spacing = if *spacing >= 0.0 {
            SHARE * *spacing
        } else {
            median
        };
    }
    Ok(spacing)
}

fn keep(shortest: &mut [f64; EDGES], squared: f64) {
    let mut squared = squared;
    for kept in shortest {
        if squared < *kept {
            core::mem::swap(kept, &mut squared);
        }
    }
}

/// The mean length, or −1 where there is no edge.
fn mean(shortest: &[f64; EDGES]) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for &squared in shortest {
        if squared < f64::INFINITY {
            sum += square_root(squared);
            count += 1.0;
        }
    }
    if count > 0.0 { sum / count } else { -1.0 }
}

/// The median of the numbers that are not negative.
fn median(values: &[f64]) -> Result<f64, OutOfMemory> {
    let mut sorted = with_capacity(values.len())?;
    // The bits of numbers that are not negative are in their order.
    let known = values.iter().filter(|&&value| value >= 0.0);
    sorted.extend(known.map(|value| (value.to_bits(), 0)));
    sort_keyed(&mut sorted);
    let middle = sorted.len() / 2;
    let at = |place: usize| {
        sorted
            .get(place)
            .map_or(0.0, |&(bits, _)| f64::from_bits(bits))
    };
    Ok(if sorted.len() % 2 == 1 {
        at(middle)
    } else {
        0.5 * (at(middle.wrapping_sub(1)) + at(middle))
    })
}
