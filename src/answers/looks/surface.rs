//! How long the triangles of a surface are: they reach from sample to sample. On most clouds these
//! are as far apart as neighbors are. But the corners of a mesh can be rows of near points that are
//! far from each other. Then all triangles are long.

use alloc::vec::Vec;

use crate::answers::looks::corners::Corners;
use crate::answers::looks::look::{Look, Verdicts};
use crate::answers::looks::part::{Left, Part};
use crate::answers::looks::triangle::Triangle;
use crate::answers::looks::tuning::LEAST;
use crate::base::allocation::{OutOfMemory, push};
use crate::base::beat;
use crate::base::real::larger;
use crate::base::sort::percentile;
use crate::cloud::points::Points;
use crate::cloud::surface::SAMPLES;
use crate::hull::{Exit, OuterFaces};

/// A triangle of a surface may be longer than [`LEAST`] if most triangles are long: up to this many times the length that
/// [`PERCENTILE`] percent of them have at most. Errors are the same within 1.6 to 1.9, and 75 to 85.
const LONGER: f64 = 1.75;
const PERCENTILE: usize = 80;

impl Verdicts {
    /// The longest edge that a triangle of a surface has, in local spacings. It follows from the
    /// triangles before an even sample of the open points. Only triangles that face the viewer
    /// count: those at a silhouette reach from one surface to another.
    #[inline(never)]
    pub(super) fn longest_of_surface(
        &self,
        look: &Look,
        points: &Points,
        faces: &mut dyn OuterFaces,
        part: &Part,
        corners: &Corners,
        left: &Left,
    ) -> Result<f64, OutOfMemory> {
        // Only vertices have a spacing.
        let is_open =
            |own: usize| self.is_open(part.place(own)) && left.spacing[own] == f64::INFINITY;
        let all = left.spacing.len();
        let mut open = 0;
        for own in 0..all {
            beat::step_at(own);
            open += usize::from(is_open(own));
        }
        let step = open.div_ceil(SAMPLES);
        let mut lengths: Vec<f64> = Vec::new();
        let mut before = step / 2;
        for own in 0..all {
            if !is_open(own) {
                continue;
            }
            if before > 0 {
                before -= 1;
                continue;
            }
            before = step - 1;
            let Exit::Face(_, vertices) = faces.exit(own as u32) else {
                continue;
            };
            let triangle = Triangle::of(vertices, corners);
            let place = look.place(points.get(part.place(own)));
            if triangle.is_facing(place, look.ahead) {
                push(&mut lengths, triangle.longest / triangle.size)?;
            }
        }
        let longest = longest_of(&lengths)?;
        let wide = look.tuning.wide;
        Ok(if wide == 1.0 {
            longest
        } else {
            LEAST + (longest - LEAST) * wide
        })
    }
}

/// The longest edge that a triangle of a surface has, in local spacings. `lengths` are those of
/// triangles that face the viewer.
pub(crate) fn longest_of(lengths: &[f64]) -> Result<f64, OutOfMemory> {
    let usual = percentile(lengths, PERCENTILE)?;
    Ok(larger(LEAST, usual.map_or(0.0, |usual| LONGER * usual)))
}
