//! A closed triangulated surface as indices. This file uses no coordinates. The caller
//! decides which data a face carries besides its indices.
//!
//! A face has three vertices, counter-clockwise from outside, and three *twins*: `twins[k]` is the half-edge that runs
//! the other way along edge k. A face that is removed has no first vertex, and its place is used again.
//!
//! ```text
//!          c
//!        ╱   ╲             face 7:  vertices [a, b, c], twins [12 << 2 | 1, …, …]    its edge 0 runs from a to b
//!      ╱   7   ╲           face 12: vertices [e, b, a], twins […, 7 << 2 | 0, …]     its edge 1 runs from b to a
//!    a ───────── b
//!      ╲  12   ╱           across edge k: twins[k]; around a vertex: the twin, then its next edge, and again
//!        ╲   ╱
//!          e
//! ```

use crate::base::allocation::{OutOfMemory, push, reserve};
use alloc::vec::Vec;

/// A vertex number.
pub(crate) type Vertex = u32;
/// A face number.
pub(crate) type FaceId = u32;

/// No vertex at all: marks a face that is not part of the surface.
pub(super) const NONE: u32 = u32::MAX;

/// Edge `edge` of face `face`: from `vertices[edge]` to `vertices[(edge + 1) % 3]`.
///
/// Packed as `face << 2 | edge`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct HalfEdge(u32);

impl HalfEdge {
    #[inline]
    pub(crate) fn new(face: FaceId, edge: u32) -> Self {
        debug_assert!(edge < 3);
        Self(face << 2 | edge)
    }

    #[inline]
    pub(crate) fn face(self) -> FaceId {
        self.0 >> 2
    }

    #[inline]
    pub(crate) fn edge(self) -> usize {
        (self.0 & 3) as usize
    }

    /// The next edge around the same face.
    #[inline]
    pub(crate) fn next(self) -> Self {
        Self(if self.0 & 3 == 2 {
            self.0 - 2
        } else {
            self.0 + 1
        })
    }
}

/// One triangle: its vertices, counter-clockwise seen from outside, and the twin of each
/// edge. The twin is the half-edge across the edge that runs the other way.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Face<T> {
    pub vertices: [Vertex; 3],
    pub twins: [HalfEdge; 3],
    pub data: T,
}

impl<T> Face<T> {
    #[inline]
    pub(crate) fn is_alive(&self) -> bool {
        self.vertices[0] != NONE
    }

    /// The vertices, beginning with the tail of `edge`.
    #[cfg(debug_assertions)]
    pub(crate) fn vertices_from(&self, edge: usize) -> [Vertex; 3] {
        turned(self.vertices, edge)
    }

    /// The twins, beginning with the twin of `edge`.
    #[inline]
    pub(crate) fn twins_from(&self, edge: usize) -> [HalfEdge; 3] {
        turned(self.twins, edge)
    }
}

/// The three items in their cyclic order, from number `first` on.
#[inline(always)]
fn turned<I: Copy>(items: [I; 3], first: usize) -> [I; 3] {
    // Two bits for each `first`. A branch would often be predicted wrong.
    const NEXT: usize = 1 | 2 << 2;
    const LAST: usize = 2 | 1 << 4;
    let next = NEXT >> (2 * first) & 3;
    let last = LAST >> (2 * first) & 3;
    [items[first], items[next], items[last]]
}

/// A closed triangulated surface whose faces can be replaced.
pub(crate) struct Surface<T> {
    faces: Vec<Face<T>>,
    free: Vec<FaceId>,
    cavity: Vec<FaceId>,
    /// The edges of the faces around the cavity. They run the other way.
    horizon: Vec<HalfEdge>,
    crossings: Vec<HalfEdge>,
}

impl<T> Default for Surface<T> {
    fn default() -> Self {
        Self {
            faces: Vec::new(),
            free: Vec::new(),
            cavity: Vec::new(),
            horizon: Vec::new(),
            crossings: Vec::new(),
        }
    }
}

impl<T: Copy> Surface<T> {
    /// Becomes the tetrahedron of `apex` and the face (a, b, c), which is
    /// counter-clockwise seen from outside.
    pub(crate) fn start(
        &mut self,
        apex: Vertex,
        [a, b, c]: [Vertex; 3],
        data: impl Fn([Vertex; 3]) -> T,
    ) -> Result<(), OutOfMemory> {
        let face = |vertices, twins: [(FaceId, u32); 3]| Face {
            vertices,
            twins: twins.map(|(face, edge)| HalfEdge::new(face, edge)),
            data: data(vertices),
        };
        self.free.clear();
        self.faces.clear();
        reserve(&mut self.faces, 4)?;
        self.faces.extend([
            face([a, b, c], [(1, 1), (2, 1), (3, 1)]),
            face([apex, b, a], [(2, 2), (0, 0), (3, 0)]),
            face([apex, c, b], [(3, 2), (0, 1), (1, 0)]),
            face([apex, a, c], [(1, 2), (0, 2), (2, 0)]),
        ]);
        Ok(())
    }

    /// Makes room for `faces` faces if there is enough memory. The surface can also grow later.
    pub(crate) fn reserve(&mut self, faces: usize) {
        let more = faces.saturating_sub(self.faces.len());
        let _ = self.faces.try_reserve_exact(more);
    }

    #[inline]
    pub(crate) fn face(&self, id: FaceId) -> &Face<T> {
        &self.faces[id as usize]
    }

    /// The faces that the last insertion made, around the new vertex.
    pub(crate) fn fan(&self) -> &[FaceId] {
        &self.cavity
    }

    /// How many face slots there are, dead ones included.
    pub(crate) fn slots(&self) -> usize {
        self.faces.len()
    }

    /// The faces of the surface with their numbers.
    pub(crate) fn alive(&self) -> impl Iterator<Item = (FaceId, &Face<T>)> {
        (0..).zip(&self.faces).filter(|(_, face)| face.is_alive())
    }

    /// Opens a cavity of the faces around `start` for which `conflicts` holds. The caller then
    /// fills it.
    ///
    /// These faces must form a disk that holds `start`. They are visited depth-first and
    /// counter-clockwise. So the horizon's edges come out in cyclic order: each edge starts
    /// where the last one ended.
    pub(crate) fn find_cavity(
        &mut self,
        start: FaceId,
        conflicts: impl Fn(&Face<T>) -> bool,
    ) -> Result<(), OutOfMemory> {
        self.cavity.clear();
        self.horizon.clear();
        self.crossings.clear();
        let [mut twin, second, third] = self.face(start).twins;
        self.enter(start, third)?;
        push(&mut self.crossings, second)?;
        loop {
            // A face of the cavity is dead as soon as it is entered.
            let across = &self.faces[twin.face() as usize];
            if across.is_alive() {
                if conflicts(across) {
                    let [_, next, last] = across.twins_from(twin.edge());
                    self.enter(twin.face(), last)?;
                    twin = next;
                    continue;
                }
                push(&mut self.horizon, twin)?;
            }
            match self.crossings.pop() {
                Some(next) => twin = next,
                None => return Ok(()),
            }
        }
    }

    /// Moves a face from the surface to the cavity. The search goes on across `later`, when it
    /// has found the part of the cavity before it.
    #[inline]
    fn enter(&mut self, face: FaceId, later: HalfEdge) -> Result<(), OutOfMemory> {
        push(&mut self.crossings, later)?;
        self.kill(face)
    }

    /// Takes a face out of the surface and lists it in the cavity.
    #[inline]
    fn kill(&mut self, face: FaceId) -> Result<(), OutOfMemory> {
        self.faces[face as usize].vertices[0] = NONE;
        push(&mut self.cavity, face)
    }

    /// Opens a cavity of face `id` alone. If an `edge` is given, the cavity holds the two faces
    /// at this edge.
    pub(crate) fn open_at(
        &mut self,
        id: FaceId,
        edge: Option<HalfEdge>,
    ) -> Result<(), OutOfMemory> {
        self.cavity.clear();
        self.horizon.clear();
        let first = edge.unwrap_or(HalfEdge::new(id, 0));
        let (second, third) = (first.next(), first.next().next());
        match edge {
            None => self.add_to_horizon([first, second, third])?,
            Some(_) => {
                let twin = self.face(id).twins[first.edge()];
                self.add_to_horizon([second, third, twin.next(), twin.next().next()])?;
                self.kill(twin.face())?;
            }
        }
        self.kill(id)
    }

    /// Adds edges to the horizon. They are given as seen from inside the cavity.
    fn add_to_horizon<const COUNT: usize>(
        &mut self,
        edges: [HalfEdge; COUNT],
    ) -> Result<(), OutOfMemory> {
        for edge in edges {
            let outside = self.twin(edge);
            push(&mut self.horizon, outside)?;
        }
        Ok(())
    }

    /// Replaces the faces of the cavity by a fan from the new vertex `apex` to the horizon.
    /// [`Surface::fan`] then lists the new faces. They take the cavity's own slots first, then
    /// free slots, then new slots. `spoke` computes from an end what the two faces at an edge of
    /// the apex have in common. `data` makes a face's data from its two spokes.
    pub(crate) fn fill_cavity<S: Copy>(
        &mut self,
        apex: Vertex,
        spoke: impl Fn(Vertex) -> S,
        data: impl Fn(S, S) -> T,
    ) -> Result<(), OutOfMemory> {
        let count = self.horizon.len();
        debug_assert!(count >= 3);
        let used = self.cavity.len() + self.free.len();
        reserve(&mut self.faces, count.saturating_sub(used))?;
        let mut end = self.faces.len() as FaceId;
        while self.cavity.len() < count {
            let slot = self.free.pop().unwrap_or_else(|| {
                end += 1;
                end - 1
            });
            push(&mut self.cavity, slot)?;
        }
        // Some vertices vanished with the cavity, so there are fewer faces than before.
        let spare = self.cavity.len() - count;
        if spare > 0 {
            reserve(&mut self.free, spare)?;
            self.free.extend(self.cavity.drain(count..));
        }
        // The fan is a ring: its first face comes again after the last.
        let first = self.cavity[0];
        let mut previous = self.cavity[count - 1];
        let mut slot = first;
        push(&mut self.cavity, first)?;
        // The face outside of an edge of the horizon starts its edge where this one ends.
        let last = self.horizon[count - 1];
        let mut tail = self.faces[last.face() as usize].vertices[last.edge()];
        let mut tail_spoke = spoke(tail);
        for (&outside, &next) in self.horizon.iter().zip(&self.cavity[1..]) {
            let across = &mut self.faces[outside.face() as usize];
            across.twins[outside.edge()] = HalfEdge::new(slot, 0);
            let head = across.vertices[outside.edge()];
            let head_spoke = spoke(head);
            let face = Face {
                vertices: [tail, head, apex],
                twins: [outside, HalfEdge::new(next, 2), HalfEdge::new(previous, 1)],
                data: data(tail_spoke, head_spoke),
            };
            // New slots follow one another.
            match self.faces.get_mut(slot as usize) {
                Some(dead) => *dead = face,
                None => self.faces.push(face),
            }
            (previous, slot, tail, tail_spoke) = (slot, next, head, head_spoke);
        }
        self.cavity.truncate(count);
        Ok(())
    }

    /// The half-edge across an edge.
    #[inline]
    pub(crate) fn twin(&self, edge: HalfEdge) -> HalfEdge {
        self.face(edge.face()).twins[edge.edge()]
    }
}
