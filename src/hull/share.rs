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
//! A ring of faces along the seams shows this for nearly all faces at once (see below). For the
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
//!
//! # The ring
//!
//! The faces of a hull that a point sees are connected across edges, as the cavity of an
//! insertion is. If the point's ray pierces an outer face, the point sees this face, or it sees
//! none. Otherwise it sees a face that is not outer. So the faces that far points can see are
//! reached, across edges, from faces in the directions of far points and from faces that are not
//! outer. A *ring* of faces that no far point sees stops this. What lies behind the ring is not
//! seen either.
//!
//! A ring face has own vertices only. It is *clear*: no far point is seen in its directions. So all
//! faces in the directions of far points are reached: a line of such directions leads to them, from
//! the middle of each cap that lies beyond a side of the sector's cell.

#[cfg(test)]
mod tests;

use crate::base::allocation::{OutOfMemory, filled, push, reserve};
use crate::base::beat;
use crate::base::real::one_by_one;
use crate::base::sort::sort_keyed;
use crate::cloud::blocks::BLOCK;
use crate::hull::depth::DepthMap;
use crate::hull::division::Division;
use crate::hull::flipped::Flipped;
use crate::hull::incremental::{Hull, ORIGIN};
use crate::hull::locate::Location;
use crate::hull::memory::Memory;
use crate::hull::order::{EIGHTH, LAST_ROUND, points_at};
#[cfg(debug_assertions)]
use crate::hull::predicates::Sign;
use crate::hull::topology::{FaceId, Vertex};
use alloc::vec::Vec;

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
    let mut sector = SectorHull {
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
                sector.add(index)?;
                sector.division.take(index);
            }
        }
    }
    sector.add_near(FIRST)?;
    sector.add_near(EIGHTH & !FIRST)?;
    // As in a whole view: by now the hull has its shape.
    let wanted = |index: u32| sector.division.near(index as usize / BLOCK) != 0;
    depth.make(sector.hull, flipped, sector.division.near_points(), &wanted)?;
    sector.add_last_round(depth)?;
    sector.settle_vertices()?;
    sector.settle_boundary()?;
    #[cfg(debug_assertions)]
    sector.hull.assert_is_hull();
    Ok(())
}

/// The first point of each block.
const FIRST: u64 = 1;

pub(super) struct SectorHull<'a> {
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

impl SectorHull<'_> {
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

impl SectorHull<'_> {
    /// Marks the own vertices of faces that no far point can see, because a closed ring of faces
    /// around them is proved not to be seen. Returns all other faces with own vertices.
    #[inline(never)]
    pub(super) fn mark_enclosed(&mut self) -> Result<Vec<FaceId>, OutOfMemory> {
        let slots = self.hull.surface.slots();
        let mut is_reached: Vec<bool> = filled(slots, false)?;
        let mut reached = self.outside()?;
        if reached.is_empty() {
            // In doubt, all faces are asked about, one by one.
            is_reached.fill(true);
        }
        for &id in &reached {
            is_reached[id as usize] = true;
        }
        let mut ring: Vec<FaceId> = Vec::new();
        let mut met: Vec<(u64, FaceId)> = Vec::new();
        while !reached.is_empty() {
            met.clear();
            while let Some(id) = reached.pop() {
                for twin in self.hull.surface.face(id).twins {
                    let next = twin.face();
                    if !core::mem::replace(&mut is_reached[next as usize], true) {
                        if self.is_clear(next) {
                            let [first, ..] = self.hull.surface.face(next).vertices;
                            push(&mut met, (u64::from(self.hull.point(first)), next))?;
                        } else {
                            push(&mut reached, next)?;
                        }
                    }
                }
            }
            // Neighbors are asked about one after another, see `Far`.
            sort_keyed(&mut met);
            for &(_, id) in &met {
                let list = match self.in_the_way(id)? {
                    Some(_) => &mut reached,
                    None => &mut ring,
                };
                push(list, id)?;
            }
        }
        for id in ring {
            is_reached[id as usize] = false;
        }
        let mut open: Vec<FaceId> = Vec::new();
        for id in 0..slots as FaceId {
            let Some(corners) = self.hull.corners(id) else {
                continue;
            };
            if !corners.iter().any(|&v| self.open_vertices[v as usize]) {
                continue;
            }
            if is_reached[id as usize] || !self.hull.is_outer(id) {
                push(&mut open, id)?;
            } else {
                #[cfg(debug_assertions)]
                self.assert_unseen(id);
                self.mark(id);
            }
        }
        Ok(open)
    }

    /// Whether a face is one of own vertices, an outer face, and no far point is seen in its
    /// directions.
    pub(super) fn is_clear(&self, id: FaceId) -> bool {
        let face = self.hull.surface.face(id);
        let is_own = face
            .vertices
            .iter()
            .all(|&v| self.open_vertices[v as usize]);
        is_own && self.hull.is_sound(id) && {
            let points = face.vertices.map(|v| self.hull.point(v));
            let corners = face.vertices.map(|v| self.hull.vertices.at(v));
            self.division.is_clear(points, corners)
        }
    }

    /// The ghost faces, and a face in each part of the directions where far points may be seen.
    /// Empty if such a face is in doubt.
    pub(super) fn outside(&self) -> Result<Vec<FaceId>, OutOfMemory> {
        let mut faces = Vec::new();
        let is_ghost = |id: &FaceId| {
            let corners = self.hull.corners(*id);
            corners.is_some_and(|corners| corners.contains(&ORIGIN))
        };
        for id in (0..self.hull.surface.slots() as FaceId).filter(is_ghost) {
            push(&mut faces, id)?;
        }
        for q in self.division.outside() {
            match self.hull.locate(q, self.hint) {
                Location::Inside(id) if self.hull.pierces(id, q) => push(&mut faces, id)?,
                Location::Outside(id) if !self.hull.is_outer(id) => {}
                _ => return Ok(Vec::new()),
            }
        }
        Ok(faces)
    }

    /// Panics if a far point sees the face. Only an even sample of faces is checked.
    #[cfg(debug_assertions)]
    fn assert_unseen(&self, id: FaceId) {
        const FACES: usize = 32;
        if id as usize % self.hull.surface.slots().div_ceil(FACES) != 0 {
            return;
        }
        let face = self.hull.surface.face(id);
        for index in 0..self.flipped.len() as u32 {
            let is_above = self.flipped.get(index).is_some_and(|q| {
                self.division.is_far(index) && self.hull.vertices.side(face, q) == Sign::Positive
            });
            assert!(!is_above, "far point {index} sees face {id}");
        }
    }
}
