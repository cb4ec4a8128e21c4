//! One sector's share of the hull. It decides which of the sector's own points are visible
//! in the whole cloud, with a hull of far fewer points.
//!
//! This hull holds the sector's own points, the points near its seams and a sample of all
//! others. The points left out are the *far* points. They can only enlarge the hull. So
//!
//! - a point that this hull hides is hidden;
//! - if no far point lies above an outer face, the vertices of this face are visible: its
//!   plane supports all of K, with the origin strictly on its inner side.
//!
//! A ring of faces along the seams shows this for nearly all faces at once (`enclosed`). For the
//! others, the far point that is most in the way of a face enters the hull. This goes on until
//! every own point is hidden or has a face that no far point lies above. In the worst case all
//! points enter.
//!
//! An insertion gives new faces the numbers of the faces that it replaces. A new face may be
//! a ghost face, or a face seen edge-on. Such a face does not show which points are
//! visible: its corners may be hidden, and no walk may start at it. Face numbers are kept
//! while points enter. Three statements hold all the same:
//!
//! - *Every hint is an outer face.* The first one is the face of the first tetrahedron.
//!   A walk starts at an outer face, goes through outer faces only, and returns an outer
//!   face. An insertion returns an outer face, too. `settle_vertices` starts walks at faces
//!   that it kept. It asks `is_open` immediately before, which is true of outer faces only.
//! - *Every face whose vertices are marked is outer*, for the same reason: `is_open` is
//!   asked about its number, and no insertion comes between the answer and the mark.
//! - *Every outer face with an undecided vertex is in `open`*, so that no face is left
//!   out. At first the list holds all faces that the ring does not enclose. After that, new outer faces come only from
//!   the fan of an insertion, and the whole fan enters the list. A number leaves the
//!   list only when the vertices of its face are marked, or when its face is not open. Such
//!   a face cannot become open before it is replaced, because a marked vertex stays marked
//!   and a face does not turn. When the list is empty, a vertex that is not marked has no
//!   outer face: its ray stays in K beyond it.

#[cfg(test)]
mod tests;

use alloc::vec::Vec;

use crate::base::allocation::{OutOfMemory, push, reserve};
use crate::base::beat;
use crate::base::real::one_by_one;
use crate::cloud::blocks::BLOCK;
use crate::hull::depth::DepthMap;
use crate::hull::division::Division;
use crate::hull::flipped::Flipped;
use crate::hull::incremental::Hull;
use crate::hull::locate::Location;
use crate::hull::memory::Memory;
use crate::hull::order::{EIGHTH, LAST_ROUND, points_at};
use crate::hull::topology::{FaceId, Vertex};

/// The step of the sample of the far points: a point is in it if its place in the spatial
/// order is a multiple of this number.
const SAMPLE: u32 = 512;

/// Marks the visible points among the sector's own points. At the start, the memory's hull
/// is the first tetrahedron.
pub(super) fn mark_visible(
    memory: &mut Memory,
    flipped: &Flipped,
    division: Division,
) -> Result<(), OutOfMemory> {
    let Memory {
        hull,
        depth,
        visible,
        ..
    } = memory;
    let count = visible.len() as u32;
    let mut share = Share {
        hull,
        flipped,
        division,
        visible,
        hint: 0,
        open_vertices: Vec::new(),
        on_boundary: Vec::new(),
    };
    for (stride, given) in [(8 * SAMPLE, 0), (SAMPLE, 8 * SAMPLE)] {
        for index in (0..count).step_by(stride as usize) {
            if given == 0 || index % given != 0 {
                share.add(index)?;
                share.division.take(index);
            }
        }
    }
    share.add_near(FIRST)?;
    share.add_near(EIGHTH & !FIRST)?;
    // As in a whole view: by now the hull has its shape.
    let wanted = |index: u32| share.division.near(index as usize / BLOCK) != 0;
    depth.make(share.hull, flipped, share.division.near_points(), &wanted)?;
    share.add_last_round(depth)?;
    share.settle_vertices()?;
    share.settle_boundary()?;
    #[cfg(debug_assertions)]
    share.hull.assert_is_hull();
    Ok(())
}

/// The first point of each block.
const FIRST: u64 = 1;

pub(super) struct Share<'a> {
    pub(super) hull: &'a mut Hull,
    pub(super) flipped: &'a Flipped<'a>,
    pub(super) division: Division,
    /// Only own points are marked.
    visible: &'a mut [bool],
    /// An outer face.
    pub(super) hint: FaceId,
    /// Whether a vertex is an own point that is not marked yet. The list is empty until all
    /// near points are in the hull.
    pub(super) open_vertices: Vec<bool>,
    /// Own points found exactly on the boundary when they were added.
    on_boundary: Vec<u32>,
}

impl Share<'_> {
    /// Adds the near points at these places of each block. Every place but the first one of a
    /// block is new: the first one may be in the sample.
    #[inline(never)]
    fn add_near(&mut self, places: u64) -> Result<(), OutOfMemory> {
        for block in 0..self.division.block_count() {
            beat::step();
            let start = (block * BLOCK) as u32;
            for index in points_at(start, self.division.near(block) & places) {
                if index % SAMPLE != 0 {
                    self.add(index)?;
                }
            }
        }
        Ok(())
    }

    /// Adds the near points of the last round that the map does not hide.
    #[inline(never)]
    fn add_last_round(&mut self, depth: &DepthMap) -> Result<(), OutOfMemory> {
        for block in 0..self.division.block_count() {
            let start = (block * BLOCK) as u32;
            beat::step();
            let mut places = self.division.near(block) & LAST_ROUND;
            if places != 0 {
                places = depth.not_hidden(self.flipped, start, places);
            }
            for index in points_at(start, places) {
                self.add(index)?;
            }
        }
        Ok(())
    }

    /// Adds a point to the hull; returns whether it became a vertex.
    #[inline(never)]
    fn add(&mut self, index: u32) -> Result<bool, OutOfMemory> {
        let own = self.division.owns(index);
        let Some(q) = self.flipped.get_out_of_line(index) else {
            self.visible[index as usize] |= own;
            return Ok(false);
        };
        let q = one_by_one(q);
        let location = self.hull.locate(q, self.hint);
        self.hint = match location {
            Location::Outside(face) => self.hull.insert(index, q, face)?,
            Location::Boundary(face) => {
                if own {
                    push(&mut self.on_boundary, index)?;
                }
                face
            }
            Location::Inside(face) => face,
        };
        Ok(matches!(location, Location::Outside(_)))
    }

    /// Whether this is the number of an outer face that has own vertices not marked yet.
    #[inline]
    fn is_open(&self, face: FaceId) -> bool {
        let is_open = |&v: &Vertex| self.open_vertices[v as usize];
        let corners = self.hull.corners(face);
        corners.is_some_and(|corners| corners.iter().any(is_open)) && self.hull.is_outer(face)
    }

    /// Marks the own vertices of `face` as visible. `face` is an outer face, and no far point
    /// lies above it.
    pub(super) fn mark(&mut self, face: FaceId) {
        #[cfg(debug_assertions)]
        self.hull.assert_is_outer(face);
        for vertex in self.hull.corners(face).into_iter().flatten() {
            if core::mem::take(&mut self.open_vertices[vertex as usize]) {
                self.visible[self.hull.point(vertex) as usize] = true;
            }
        }
    }

    /// Notes which vertices are the sector's own.
    fn open_own_vertices(&mut self) -> Result<(), OutOfMemory> {
        let count = self.hull.vertex_count();
        self.open_vertices.try_reserve_exact(count)?;
        // The origin is no point of the cloud.
        self.open_vertices.push(false);
        self.open_vertices
            .extend((1..count).map(|v| self.division.owns(self.hull.point(v as Vertex))));
        Ok(())
    }

    /// Decides about all vertices of the hull that are the sector's own.
    #[inline(never)]
    fn settle_vertices(&mut self) -> Result<(), OutOfMemory> {
        self.open_own_vertices()?;
        let mut open = self.mark_enclosed()?;
        // Every open face is in `open`. The list may also hold numbers of other faces.
        while let Some(face) = open.pop() {
            while self.is_open(face) {
                beat::step();
                let Some(index) = self.in_the_way(face)? else {
                    self.mark(face);
                    break;
                };
                self.hint = face;
                self.enter(index, &mut open)?;
            }
        }
        Ok(())
    }

    /// The far point that is most in the way of a face; `None` if the face is certainly one of K.
    pub(super) fn in_the_way(&mut self, face: FaceId) -> Result<Option<u32>, OutOfMemory> {
        let support = self.hull.support(face);
        self.division.most_in_the_way(support, self.flipped)
    }

    /// Adds a far point to the hull, and the numbers of all new faces to `open`.
    #[cold]
    fn enter(&mut self, index: u32, open: &mut Vec<FaceId>) -> Result<(), OutOfMemory> {
        self.division.take(index);
        if self.add(index)? {
            push(&mut self.open_vertices, false)?;
            let fan = self.hull.surface.fan();
            reserve(open, fan.len())?;
            open.extend_from_slice(fan);
        }
        Ok(())
    }

    /// Decides about own points that were found exactly on the boundary.
    #[inline(never)]
    fn settle_boundary(&mut self) -> Result<(), OutOfMemory> {
        let mut ignored = Vec::new();
        for index in core::mem::take(&mut self.on_boundary) {
            let Some(q) = self.flipped.get_out_of_line(index) else {
                continue;
            };
            while let Location::Boundary(face) = self.hull.locate_out_of_line(q, self.hint) {
                self.hint = face;
                let Some(other) = self.in_the_way(face)? else {
                    self.visible[index as usize] = true;
                    break;
                };
                self.enter(other, &mut ignored)?;
                ignored.clear();
            }
        }
        Ok(())
    }
}
