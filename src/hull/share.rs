//! One sector's share of the hull: which of its own points are visible in the whole
//! cloud, by a hull of far fewer points.
//!
//! The hull is of the sector's own points, those near its seams and a sample of all
//! others, which the rest, the *far* points, can only enlarge. So
//!
//! - what it hides is hidden;
//! - a vertex of an outer face that no far point lies above is visible: the plane
//!   of that face supports all of K, with the origin strictly on its inner side.
//!
//! That no point of a block lies above a face is mostly known from a bound of m·q
//! over all of its directions. Blocks of which it is not known enter the hull, until
//! every point is hidden or has such a face; in the end that may be all of them.
//!
//! An insertion puts new faces under the numbers of those that it replaces, and a new
//! face may be a ghost face or seen edge-on, which tells nothing about what is visible:
//! its corners may be hidden, and no walk may start at it. So three statements hold
//! here, although face numbers are kept while blocks enter:
//!
//! - *Every hint is an outer face.* The first one is the face of the first tetrahedron.
//!   A walk starts at an outer face, goes by way of outer faces, and returns an outer
//!   one, as an insertion does. `settle_vertices` starts walks at faces that it kept.
//!   It asks `is_open` immediately before, which is true of outer faces only.
//! - *Every face that marks is outer*, for the same reason: `is_open` is asked about its
//!   number, and no insertion comes between the answer and the mark.
//! - *Every outer face with a vertex to be decided is in `open`*, so that none is left
//!   out. At first the list is made of all faces. From then on outer faces only arise in
//!   the fan of an insertion, and the whole fan enters the list. A number leaves the
//!   list only when its face marks or is not open. Such a face stays not open until it
//!   is replaced, because a marked vertex stays marked and a face does not turn. When the
//!   list is empty, a vertex that is not marked has no outer face: its ray stays in K
//!   beyond it.

use alloc::vec::Vec;

use super::flipped::Flipped;
use super::incremental::Hull;
use super::locate::Location;
use super::memory::Memory;
use super::topology::{FaceId, Vertex};
use crate::base::allocation::{OutOfMemory, push, reserve};
use crate::cloud::blocks::BLOCK;
use crate::hull::division::{Division, Role};

/// Of the spatial order, every point whose place is a multiple of this is in the sample of the far ones.
const SAMPLE: u32 = 512;

/// Marks those of the sector's own points that are visible. The memory's hull is the
/// first tetrahedron.
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
            }
        }
    }
    for (stride, given) in [(BLOCK, SAMPLE), (8, BLOCK as u32), (1, 8)] {
        if stride == 1 {
            // As in a whole view: by now the hull has its shape.
            let Share { hull, division, .. } = &share;
            let is_near = |index: u32| division.roles[index as usize / BLOCK] != Role::Far;
            depth.make(hull, flipped, division.near_points(), &is_near)?;
        }
        for block in 0..share.division.roles.len() {
            if share.division.roles[block] != Role::Far {
                let start = (block * BLOCK) as u32;
                for index in (start..count.min(start + BLOCK as u32)).step_by(stride) {
                    let is_told = stride == 1 && depth.hides(flipped, index);
                    if index % given != 0 && !is_told {
                        share.add(index)?;
                    }
                }
            }
        }
    }
    share.settle_vertices()?;
    share.settle_boundary()?;
    #[cfg(debug_assertions)]
    share.hull.assert_is_hull();
    Ok(())
}

struct Share<'a> {
    hull: &'a mut Hull,
    flipped: &'a Flipped<'a>,
    division: Division,
    /// Only own points are marked.
    visible: &'a mut [bool],
    /// An outer face.
    hint: FaceId,
    /// Own vertices not marked yet; empty until the hull is of all near points.
    open_vertices: Vec<bool>,
    /// Own points found exactly on the boundary when they were added.
    on_boundary: Vec<u32>,
}

impl Share<'_> {
    /// Adds a point to the hull; returns whether it became a vertex.
    #[inline(never)]
    fn add(&mut self, index: u32) -> Result<bool, OutOfMemory> {
        let own = self.division.owns(index);
        let Some(q) = self.flipped.get_out_of_line(index) else {
            self.visible[index as usize] |= own;
            return Ok(false);
        };
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

    /// Whether a number is that of an outer face with own vertices not marked yet.
    #[inline]
    fn is_open(&self, face: FaceId) -> bool {
        let is_open = |&v: &Vertex| self.open_vertices[v as usize];
        let corners = self.hull.corners(face);
        corners.is_some_and(|corners| corners.iter().any(is_open)) && self.hull.is_outer(face)
    }

    /// Own vertices of `face`, an outer one that no far point lies above, are visible.
    fn mark(&mut self, face: FaceId) {
        #[cfg(debug_assertions)]
        self.hull.assert_is_outer(face);
        for vertex in self.hull.corners(face).into_iter().flatten() {
            if core::mem::take(&mut self.open_vertices[vertex as usize]) {
                self.visible[self.hull.point(vertex) as usize] = true;
            }
        }
    }

    /// Decides about all vertices of the hull that are the sector's own.
    #[inline(never)]
    fn settle_vertices(&mut self) -> Result<(), OutOfMemory> {
        let count = self.hull.vertex_count();
        self.open_vertices.try_reserve_exact(count)?;
        // The origin is no point of the cloud.
        self.open_vertices.push(false);
        self.open_vertices
            .extend((1..count).map(|v| self.division.owns(self.hull.point(v as Vertex))));
        let mut open: Vec<FaceId> = Vec::new();
        for face in 0..self.hull.surface.slots() as FaceId {
            if self.is_open(face) {
                let (m, limit) = self.hull.support(face);
                if self.division.bound_of_all(m) < limit {
                    self.mark(face);
                } else {
                    push(&mut open, face)?;
                }
            }
        }
        // Every open face is in `open`; some numbers there may be of other faces.
        let mut failed: Vec<(FaceId, u32)> = Vec::new();
        while !open.is_empty() {
            failed.clear();
            reserve(&mut failed, open.len())?;
            for &face in &open {
                if self.is_open(face) {
                    let (m, limit) = self.hull.support(face);
                    match self.division.most_in_the_way(m, limit)? {
                        Some(block) => failed.push((face, block)),
                        None => self.mark(face),
                    }
                }
            }
            open.clear();
            for &(face, block) in &failed {
                // Not if a block that entered before has replaced it.
                if self.is_open(face) {
                    push(&mut open, face)?;
                    self.hint = face;
                    self.enter(block, &mut open)?;
                }
            }
        }
        Ok(())
    }

    /// Adds a far block to the hull, and the numbers of all new faces to `open`.
    #[cold]
    fn enter(&mut self, block: u32, open: &mut Vec<FaceId>) -> Result<(), OutOfMemory> {
        if self.division.roles[block as usize] != Role::Far {
            return Ok(());
        }
        self.division.enter(block);
        let start = block * BLOCK as u32;
        let count = self.visible.len() as u32;
        for index in start..count.min(start + BLOCK as u32) {
            if index % SAMPLE != 0 && self.add(index)? {
                push(&mut self.open_vertices, false)?;
                let fan = self.hull.surface.fan();
                reserve(open, fan.len())?;
                open.extend_from_slice(fan);
            }
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
            while let Location::Boundary(face) = self.hull.locate(q, self.hint) {
                self.hint = face;
                let (m, limit) = self.hull.support(face);
                let Some(block) = self.division.most_in_the_way(m, limit)? else {
                    self.visible[index as usize] = true;
                    break;
                };
                self.enter(block, &mut ignored)?;
                ignored.clear();
            }
        }
        Ok(())
    }
}
