//! How a look decides: by its hull's vertices and triangles, back in their places.

use alloc::vec::Vec;

use crate::answers::looks::corners::{Corner, Corners, Triangle};
use crate::answers::looks::look::{Look, Verdicts};
use crate::answers::looks::part::{Left, Part};
use crate::answers::looks::tuning::{LEAST, SHARES};
use crate::base::allocation::{OutOfMemory, filled, push};
use crate::base::beat;
use crate::base::real::larger;
use crate::base::sort::percentile;
use crate::cloud::points::Points;
use crate::cloud::surface::SAMPLES;
use crate::hull::{Exit, FaceId, OuterFaces, Vertex};

/// Surface hides a point that lies farther behind it, along the ray, than this share of the
/// triangle's longest edge, or than half the distance to the next sheet. At that depth the score is ½: 1 / (1 + depth²).
pub(super) const BEHIND: f64 = 0.45;
/// The triangles of a surface reach from sample to sample. On most clouds these are as far apart as neighbors are. But
/// the corners of a mesh can be rows of near points that are far from each other. Then all triangles are long.
/// A triangle of a surface may be longer than [`LEAST`] if most triangles are long: up to this many times the length that
/// [`PERCENTILE`] percent of them have at most. Errors are the same within 1.6 to 1.9, and 75 to 85.
const LONGER: f64 = 1.75;
const PERCENTILE: usize = 80;

impl Verdicts {
    /// Lets a look decide the points that it is sure of. Returns the points that take part in the
    /// next look: those that are undecided, and the corners of the triangles before them.
    #[inline(never)]
    pub(super) fn take(
        &mut self,
        look: &Look,
        points: &Points,
        faces: &mut dyn OuterFaces,
        part: &Part,
    ) -> Result<Left, OutOfMemory> {
        let place = |own: u32| look.place(points.get(part.place(own as usize)));
        let widest = look.tuning.widest * look.unit;
        let known = |own: u32| part.spacing(own as usize).min(widest);
        let corners = Corners::of(faces, &place, &known)?;
        let mut left = self.take_vertices(look, faces, part, &corners)?;
        let longest = match self.longest {
            Some(longest) => longest,
            None => self.longest_of_surface(look, points, faces, part, &corners, &left)?,
        };
        self.longest = Some(longest);
        let mut last: Option<(FaceId, Triangle)> = None;
        for own in 0..left.spacing.len() {
            beat::step_at(own);
            let point = part.place(own);
            if !self.is_open(point) {
                continue;
            }
            // Only vertices have a spacing.
            if left.spacing[own] < f64::INFINITY {
                left.takes_part[own] = true;
                continue;
            }
            let Exit::Face(face, vertices) = faces.exit(own as u32) else {
                self.decide(point, true, 1.0);
                continue;
            };
            let (_, triangle) = match &mut last {
                Some(known) if known.0 == face => known,
                other => other.insert((face, Triangle::of(vertices, &corners))),
            };
            let place = look.place(points.get(point));
            let behind = triangle.behind(place, look.ahead);
            // A surface with a thickness hides what is behind all of it.
            let most = (BEHIND * triangle.longest).min(look.tuning.behind * look.unit);
            let depth = behind / (most + look.thickness());
            let is_surface = triangle.longest <= longest * triangle.size;
            if is_surface || look.is_last && behind > triangle.longest {
                // A triangle that is seen edge-on hides the point: its depth is infinite or NaN.
                self.decide(point, depth <= 1.0, score_at(depth));
            } else {
                left.takes_part[own] = true;
                let numbered = faces.points_of_vertices();
                for corner in vertices {
                    left.takes_part[numbered[corner as usize] as usize] = true;
                }
            }
        }
        Ok(left)
    }

    /// Decides for the vertices, and notes the local spacing of each one.
    #[inline(never)]
    fn take_vertices(
        &mut self,
        look: &Look,
        faces: &dyn OuterFaces,
        part: &Part,
        corners: &Corners,
    ) -> Result<Left, OutOfMemory> {
        let numbered = faces.points_of_vertices();
        // A hull that is too loose for the samples beside a vertex has vertices behind the surface.
        let [.., loosest] = SHARES;
        let ring = loosest * look.tuning.ring;
        let is_even = look.tuning.growth == 0.0;
        let is_wide = look.scale * look.unit >= ring * corners.widest;
        let rings = if is_even && is_wide {
            // The ring of every vertex is narrow enough.
            Vec::new()
        } else {
            corners.rings()?
        };
        let count = part.len(self.of.len());
        let mut left = Left {
            takes_part: filled(count, false)?,
            spacing: filled(count, f64::INFINITY)?,
        };
        for (vertex, &own) in numbered.iter().enumerate().skip(1) {
            let Corner { spacing, place } = corners.at(vertex as Vertex);
            if spacing == f64::INFINITY {
                continue;
            }
            left.spacing[own as usize] = spacing;
            let point = part.place(own as usize);
            let width = rings
                .get(vertex)
                .map_or(0.0, |mean| ring * mean / look.scale_at(place));
            if self.is_open(point) && width <= 1.0 {
                self.decide(point, true, look.score);
            }
        }
        Ok(left)
    }

    /// The longest edge that a triangle of a surface has, in local spacings. It follows from the
    /// triangles before the open points: an even sample of many, along the curve, so that up to 16,384 do not change
    /// with the axes. Only triangles that face the viewer count: those at a silhouette reach from one surface to another.
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
        let step = open.div_ceil(8 * SAMPLES);
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
fn longest_of(lengths: &[f64]) -> Result<f64, OutOfMemory> {
    let usual = percentile(lengths, PERCENTILE)?;
    Ok(larger(LEAST, usual.map_or(0.0, |usual| LONGER * usual)))
}

/// From 1 before a surface to ½ at the depth that it hides; 0 where the depth is NaN.
fn score_at(depth: f64) -> f64 {
    let depth = larger(depth, 0.0);
    larger(0.0, 1.0 / (1.0 + depth * depth))
}
