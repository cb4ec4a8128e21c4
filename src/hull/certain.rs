//! Which points of a hull are visible in a larger cloud, of which only boxes are known?
//!
//! A vertex is certainly visible if none of the boxes can hold a point above one of its outer faces:
//! then this face is one of the larger cloud's hull. The same holds for a point that is exactly on a
//! face. A point for which no such face is known is undecided. The boxes that may hold points above
//! one of its faces, the one with the fewest, are missing.

use alloc::vec::Vec;

use crate::base::allocation::{OutOfMemory, filled, push};
use crate::base::sort::sort_keyed;
use crate::cloud::blocks::Sphere;
use crate::cloud::points::Points;
use crate::flip::inversion::Flip;
use crate::hull::division::Elsewhere;
use crate::hull::flipped::Flipped;
use crate::hull::incremental::Hull;
use crate::hull::locate::Location;
use crate::hull::memory::Memory;
use crate::hull::outer_boundary::mark_visible;
use crate::hull::topology::FaceId;

/// What a hull of some points tells about a larger cloud.
pub(crate) struct Certain {
    /// Which of the points are visible among themselves.
    pub visible: Vec<bool>,
    /// Which of the own points are certainly visible in the larger cloud, too.
    pub certain: Vec<bool>,
    /// Which boxes may hide own points that are visible among themselves.
    pub missing: Vec<bool>,
}

/// A face with some boxes above it, and how many there are.
#[derive(Clone, Copy)]
struct Doubtful {
    boxes: u32,
    face: FaceId,
}

/// Asks about the own points among `points`: `owns` tells which they are. All other points of the
/// larger cloud are among `points` or in `boxes`.
#[inline(never)]
pub(crate) fn certain_among(
    points: &Points,
    blocks: &[Sphere],
    flip: &Flip,
    owns: &[bool],
    boxes: &[[[f64; 3]; 2]],
) -> Result<Certain, OutOfMemory> {
    let flip = flip.rescaled_for(points);
    let mut memory = Memory::new();
    mark_visible(points, blocks, &flip, &mut memory)?;
    let flipped = Flipped::of(points, blocks, &flip);
    let mut is_open: Vec<bool> = filled(points.len(), false)?;
    for (index, is_open) in (0..).zip(&mut is_open) {
        let asked = owns[index as usize] && memory.visible[index as usize];
        // A point at the viewpoint is visible in every cloud.
        *is_open = asked && !boxes.is_empty() && flipped.get_out_of_line(index).is_some();
    }
    let is_body = memory.holds_hull() && flipped.keeps_depth();
    // Without planes, every box is missing.
    let mut missing = filled(boxes.len(), !is_body && is_open.contains(&true))?;
    if is_body {
        let question = Question {
            hull: &memory.hull,
            elsewhere: Elsewhere::new(boxes, &flip)?,
            is_open: &mut is_open,
            missing: &mut missing,
        };
        question.settle(&memory.on_boundary, &flipped)?;
    }
    let mut certain = is_open;
    for (index, certain) in certain.iter_mut().enumerate() {
        *certain = owns[index] && memory.visible[index] && !*certain;
    }
    Ok(Certain {
        visible: memory.visible,
        certain,
        missing,
    })
}

struct Question<'a> {
    hull: &'a Hull,
    elsewhere: Elsewhere,
    /// The own points that are not certain.
    is_open: &'a mut [bool],
    missing: &'a mut [bool],
}

impl Question<'_> {
    fn settle(mut self, on_boundary: &[u32], flipped: &Flipped) -> Result<(), OutOfMemory> {
        let none = Doubtful {
            boxes: u32::MAX,
            face: 0,
        };
        let mut doubtful = filled(self.is_open.len(), none)?;
        for (_, face) in self.open_faces()? {
            let points = self.open_points(face);
            if points == [None; 3] {
                continue;
            }
            let boxes = self.boxes_above(face)?;
            for point in points.into_iter().flatten() {
                if boxes == 0 {
                    self.is_open[point as usize] = false;
                } else if boxes < doubtful[point as usize].boxes {
                    doubtful[point as usize] = Doubtful { boxes, face };
                }
            }
        }
        let mut hint = self.hull.outer_face();
        for &point in on_boundary {
            let (Some(q), Some(start)) = (flipped.get_out_of_line(point), hint) else {
                continue;
            };
            if !self.is_open[point as usize] {
                continue;
            }
            if let Location::Boundary(face) = self.hull.locate_out_of_line(q, start) {
                hint = Some(face);
                let boxes = self.boxes_above(face)?;
                self.is_open[point as usize] = boxes > 0;
                doubtful[point as usize] = Doubtful { boxes, face };
            }
        }
        for (point, Doubtful { boxes, face }) in doubtful.into_iter().enumerate() {
            if self.is_open[point] {
                debug_assert_ne!(boxes, u32::MAX, "a visible point has an outer face");
                let missing = &mut *self.missing;
                let note = &mut |number: u32| missing[number as usize] = true;
                self.elsewhere.above(self.hull.support(face), note)?;
            }
        }
        Ok(())
    }

    /// The outer faces with open points, in the order of these points: neighbors follow each other.
    fn open_faces(&self) -> Result<Vec<(u64, FaceId)>, OutOfMemory> {
        let mut faces = Vec::new();
        for id in 0..self.hull.surface.slots() as FaceId {
            if let Some(first) = self.open_points(id).into_iter().flatten().min() {
                if self.hull.is_outer(id) {
                    push(&mut faces, (u64::from(first), id))?;
                }
            }
        }
        sort_keyed(&mut faces);
        Ok(faces)
    }

    /// The open points among the corners of a face.
    fn open_points(&self, id: FaceId) -> [Option<u32>; 3] {
        let corners = self.hull.corners(id).unwrap_or_default();
        corners.map(|vertex| {
            let point = self.hull.point(vertex);
            // The origin is no point of the cloud.
            let is_open = self.is_open.get(point as usize);
            is_open.is_some_and(|is_open| *is_open).then_some(point)
        })
    }

    fn boxes_above(&mut self, face: FaceId) -> Result<u32, OutOfMemory> {
        let mut count = 0;
        let add = &mut |_| count += 1;
        self.elsewhere.above(self.hull.support(face), add)?;
        Ok(count)
    }
}
