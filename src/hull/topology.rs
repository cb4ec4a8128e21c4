//! A closed triangulated surface as indices. This file uses no coordinates. The caller
//! decides which data a face carries besides its indices.

use crate::base::allocation::{OutOfMemory, push, reserve};
use alloc::vec::Vec;

/// A vertex number.
pub(crate) type Vertex = u32;
/// A face number.
pub(crate) type FaceId = u32;

/// No vertex at all: marks a face that is not part of the surface.
const NONE: u32 = u32::MAX;

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
    pub(crate) fn vertices_from(&self, edge: usize) -> [Vertex; 3] {
        let [a, b, c] = self.vertices;
        [[a, b, c], [b, c, a], [c, a, b]][edge]
    }

    /// The twins, beginning with the twin of `edge`.
    pub(crate) fn twins_from(&self, edge: usize) -> [HalfEdge; 3] {
        let [a, b, c] = self.twins;
        [[a, b, c], [b, c, a], [c, a, b]][edge]
    }
}

/// An edge of a hole: its tail, its head, and the half-edge outside of the hole
/// that runs the other way.
#[derive(Clone, Copy)]
pub(crate) struct Rim {
    pub tail: Vertex,
    pub head: Vertex,
    pub outside: HalfEdge,
}

/// A closed triangulated surface whose faces can be replaced.
pub(crate) struct Surface<T> {
    pub(super) faces: Vec<Face<T>>,
    pub(super) free: Vec<FaceId>,
    cavity: Vec<FaceId>,
    horizon: Vec<Rim>,
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
    pub(crate) fn face_mut(&mut self, id: FaceId) -> &mut Face<T> {
        &mut self.faces[id as usize]
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
        self.enter(start)?;
        let [e0, e1, e2] = [0, 1, 2].map(|edge| HalfEdge::new(start, edge));
        self.crossings.extend([e2, e1, e0]);
        while let Some(crossing) = self.crossings.pop() {
            // A face of the cavity is dead as soon as it is entered. It keeps its other
            // indices, which are needed until the fan is built.
            let from = &self.faces[crossing.face() as usize];
            let twin = from.twins[crossing.edge()];
            let across = &self.faces[twin.face() as usize];
            if !across.is_alive() {
                continue;
            }
            if conflicts(across) {
                self.enter(twin.face())?;
                self.crossings.push(twin.next().next());
                self.crossings.push(twin.next());
            } else {
                // In the face across, the edge runs the other way.
                let edge = twin.edge();
                let tail = across.vertices[(edge + 1) % 3];
                let head = across.vertices[edge];
                push(
                    &mut self.horizon,
                    Rim {
                        tail,
                        head,
                        outside: twin,
                    },
                )?;
            }
        }
        Ok(())
    }

    /// Moves a face from the surface to the cavity.
    #[inline]
    fn enter(&mut self, face: FaceId) -> Result<(), OutOfMemory> {
        reserve(&mut self.cavity, 1)?;
        reserve(&mut self.crossings, 3)?;
        self.cavity.push(face);
        self.faces[face as usize].vertices[0] = NONE;
        Ok(())
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
                self.enter(twin.face())?;
            }
        }
        self.enter(id)
    }

    /// Adds edges to the horizon. They are given as seen from inside the cavity.
    fn add_to_horizon<const COUNT: usize>(
        &mut self,
        edges: [HalfEdge; COUNT],
    ) -> Result<(), OutOfMemory> {
        for edge in edges {
            let [tail, head, _] = self.face(edge.face()).vertices_from(edge.edge());
            let outside = self.face(edge.face()).twins[edge.edge()];
            push(
                &mut self.horizon,
                Rim {
                    tail,
                    head,
                    outside,
                },
            )?;
        }
        Ok(())
    }

    /// Replaces the faces of the cavity by a fan from the new vertex `apex` to the horizon.
    /// [`Surface::fan`] then lists the new faces. They take the cavity's own slots first, then
    /// free slots, then new slots.
    pub(crate) fn fill_cavity(
        &mut self,
        apex: Vertex,
        data: impl Fn([Vertex; 3]) -> T,
    ) -> Result<(), OutOfMemory> {
        let count = self.horizon.len();
        debug_assert!(count >= 3);
        while self.cavity.len() < count {
            let slot = match self.free.pop() {
                Some(slot) => slot,
                None => {
                    reserve(&mut self.faces, 1)?;
                    reserve(&mut self.cavity, 1)?;
                    // Any dead face will do; it is overwritten below.
                    self.faces.push(self.faces[self.cavity[0] as usize]);
                    (self.faces.len() - 1) as FaceId
                }
            };
            self.cavity.push(slot);
        }
        for i in 0..count {
            let Rim {
                tail,
                head,
                outside,
            } = self.horizon[i];
            let slot = self.cavity[i];
            let next = self.cavity[if i + 1 == count { 0 } else { i + 1 }];
            let previous = self.cavity[if i == 0 { count - 1 } else { i - 1 }];
            let vertices = [tail, head, apex];
            self.faces[slot as usize] = Face {
                vertices,
                twins: [outside, HalfEdge::new(next, 2), HalfEdge::new(previous, 1)],
                data: data(vertices),
            };
            self.faces[outside.face() as usize].twins[outside.edge()] = HalfEdge::new(slot, 0);
        }
        // Some vertices vanished with the cavity, so there are fewer faces than before.
        let spare = self.cavity.len() - count;
        reserve(&mut self.free, spare)?;
        self.free.extend(self.cavity.drain(count..));
        Ok(())
    }

    /// The two triangles that a flip of `edge` would make. The first one holds the edge's tail.
    pub(crate) fn flipped(&self, edge: HalfEdge) -> [[Vertex; 3]; 2] {
        let [a, b, c] = self.face(edge.face()).vertices_from(edge.edge());
        let twin = self.face(edge.face()).twins[edge.edge()];
        let [_, _, d] = self.face(twin.face()).vertices_from(twin.edge());
        [[c, a, d], [d, b, c]]
    }

    /// Replaces an edge by the other diagonal of its two triangles. The first triangle of
    /// [`Surface::flipped`] takes the slot of the edge's face, the second one the slot of the
    /// twin's face. The common edge is the last edge of both. The data of both slots stay as
    /// they were.
    pub(crate) fn flip(&mut self, edge: HalfEdge) {
        let [first, second] = self.flipped(edge);
        let slot = edge.face();
        let f = *self.face(slot);
        let twin = f.twins[edge.edge()];
        let other = twin.face();
        let g = *self.face(other);
        let [_, bc, ca] = f.twins_from(edge.edge());
        let [_, ad, db] = g.twins_from(twin.edge());
        self.put(slot, first, [ca, ad, HalfEdge::new(other, 2)]);
        self.put(other, second, [db, bc, HalfEdge::new(slot, 2)]);
    }

    /// The faces around vertex `hub`, counter-clockwise from `start`, which is one of them.
    /// Returns the number of each face, and its edge opposite to the hub as an edge of a hole.
    pub(crate) fn around(
        &self,
        hub: Vertex,
        start: FaceId,
    ) -> impl Iterator<Item = (FaceId, Rim)> + '_ {
        let mut next = Some(start);
        core::iter::from_fn(move || {
            let id = next?;
            let face = self.face(id);
            let at = face.vertices.iter().position(|&vertex| vertex == hub)?;
            let [_, tail, head] = face.vertices_from(at);
            let [_, outside, across] = face.twins_from(at);
            next = Some(across.face()).filter(|&id| id != start);
            let rim = Rim {
                tail,
                head,
                outside,
            };
            Some((id, rim))
        })
    }

    /// Whether an edge joins `hub`, a vertex of `start`, to `other`.
    pub(crate) fn are_joined(&self, hub: Vertex, other: Vertex, start: FaceId) -> bool {
        self.around(hub, start).any(|(_, rim)| rim.tail == other)
    }

    /// Cuts an ear off the hole with this `rim`. The ear is the triangle of rim edge `ear` and
    /// the next rim edge. It is put into the dead slot `slot`, and the rim closes behind it. If
    /// the hole is only that triangle, the hole is filled and the rim's last edge is left as it
    /// was. The slot's data stay as they were.
    pub(crate) fn cut_ear(&mut self, rim: &mut Vec<Rim>, ear: usize, slot: FaceId) {
        let next = (ear + 1) % rim.len();
        let (first, second) = (rim[ear], rim[next]);
        let vertices = [first.tail, first.head, second.head];
        let closing = if rim.len() == 3 {
            rim[(ear + 2) % 3].outside
        } else {
            // This edge is not linked yet. The face that takes this rim edge links it.
            HalfEdge::new(slot, 2)
        };
        self.put(slot, vertices, [first.outside, second.outside, closing]);
        rim[ear] = Rim {
            tail: first.tail,
            head: second.head,
            outside: HalfEdge::new(slot, 2),
        };
        rim.remove(next);
    }

    /// Takes a face's slot out of the surface. Later faces may use it.
    pub(crate) fn free(&mut self, slot: FaceId) -> Result<(), OutOfMemory> {
        reserve(&mut self.free, 1)?;
        self.faces[slot as usize].vertices[0] = NONE;
        self.free.push(slot);
        Ok(())
    }

    /// Writes a face and links the faces across its edges back to it.
    fn put(&mut self, slot: FaceId, vertices: [Vertex; 3], twins: [HalfEdge; 3]) {
        let face = self.face_mut(slot);
        face.vertices = vertices;
        face.twins = twins;
        for (edge, twin) in (0..).zip(twins) {
            self.faces[twin.face() as usize].twins[twin.edge()] = HalfEdge::new(slot, edge);
        }
    }
}
