//! How a hull keeps the list of its corners up to date (`compact`).

use super::compact::Corners;
use super::dual_plane::Plane;
use super::incremental::Hull;
use super::topology::{FaceId, HalfEdge, NONE, Vertex};
use crate::base::allocation::{OutOfMemory, push, reserve};

/// A hull of fewer faces fits into the caches. Then stored planes save more time than the list does.
pub(super) const MANY: usize = 120_000;
/// In debug builds smaller hulls than this use the list, too: most tests are about small clouds.
const TESTED: usize = 20_000;

impl Hull {
    /// Prepares for a pass over all faces in a new view. Decides whether the list is used.
    #[inline(never)]
    pub(super) fn use_corners(&mut self) -> Result<(), OutOfMemory> {
        if self.compact.is_used {
            self.list_new()?;
            for &id in &self.compact.new {
                self.surface.face_mut(id).data = Plane::EXACT_ONLY;
            }
            self.compact.new.clear();
            self.compact.listed = 0;
            return Ok(());
        }
        let Self {
            compact, surface, ..
        } = self;
        let slots = surface.slots();
        let is_tested = cfg!(debug_assertions) && slots < TESTED;
        if slots < MANY && !is_tested {
            return Ok(());
        }
        compact.faces.clear();
        reserve(&mut compact.faces, slots)?;
        let faces = (0..slots as FaceId).map(|id| surface.face(id));
        compact.faces.extend(faces.map(|face| Corners {
            own: face.vertices,
            across: face.twins.map(|twin| {
                let [_, _, apex] = surface.face(twin.face()).vertices_from(twin.edge());
                apex
            }),
        }));
        compact.outward.clear();
        reserve(&mut compact.outward, slots)?;
        compact.outward.resize(slots, false);
        for id in 0..slots as FaceId {
            surface.face_mut(id).data = Plane::EXACT_ONLY;
        }
        compact.new.clear();
        compact.listed = 0;
        compact.is_used = true;
        Ok(())
    }

    /// Notes that a face is new or has other corners.
    pub(super) fn note_new(&mut self, id: FaceId) -> Result<(), OutOfMemory> {
        if self.compact.is_used {
            push(&mut self.compact.new, id)?;
        }
        Ok(())
    }

    /// Notes the faces of the last insertion.
    #[inline(never)]
    pub(super) fn note_fan(&mut self) -> Result<(), OutOfMemory> {
        let fan = self.surface.fan();
        reserve(&mut self.compact.new, fan.len())?;
        self.compact.new.extend_from_slice(fan);
        Ok(())
    }

    /// Brings the list of corners up to date.
    #[inline(never)]
    pub(super) fn list_new(&mut self) -> Result<(), OutOfMemory> {
        let Self {
            compact, surface, ..
        } = self;
        if !compact.is_used {
            return Ok(());
        }
        let slots = surface.slots();
        let none = Corners {
            own: [NONE; 3],
            across: [NONE; 3],
        };
        let more = slots - compact.faces.len();
        reserve(&mut compact.faces, more)?;
        reserve(&mut compact.outward, more)?;
        compact.faces.resize(slots, none);
        compact.outward.resize(slots, false);
        for &id in &surface.free {
            compact.faces[id as usize] = none;
        }
        for &id in &compact.new[compact.listed..] {
            let face = surface.face(id);
            if !face.is_alive() {
                continue;
            }
            compact.outward[id as usize] = !face.data.is_exact_only();
            compact.faces[id as usize].own = face.vertices;
            for (edge, twin) in face.twins.into_iter().enumerate() {
                let [_, _, apex] = surface.face(twin.face()).vertices_from(twin.edge());
                compact.faces[id as usize].across[edge] = apex;
                compact.faces[twin.face() as usize].across[twin.edge()] =
                    face.vertices[(edge + 2) % 3];
            }
        }
        compact.listed = compact.new.len();
        Ok(())
    }

    /// The corners of a face and the vertices across its edges; `None` if there is no face.
    #[inline]
    pub(super) fn surroundings(&self, id: FaceId) -> Option<Corners> {
        let corners = if self.compact.is_used {
            self.compact.faces[id as usize]
        } else {
            let face = self.surface.face(id);
            let apex = |twin: HalfEdge| {
                let across = self.surface.face(twin.face());
                across.vertices[(twin.edge() + 2) % 3]
            };
            Corners {
                own: face.vertices,
                across: face.twins.map(apex),
            }
        };
        corners.is_alive().then_some(corners)
    }

    /// The corners of all faces, from the list if it is used. Then it must be up to date.
    pub(super) fn triangles(&self) -> impl Iterator<Item = [Vertex; 3]> + '_ {
        let listed = if self.compact.is_used {
            self.compact.faces.as_slice()
        } else {
            &[]
        };
        let others = (!self.compact.is_used).then(|| self.surface.alive());
        let others = others.into_iter().flatten().map(|(_, face)| face.vertices);
        let listed = listed.iter().filter(|face| face.is_alive());
        listed.map(|face| face.own).chain(others)
    }

    /// Computes all planes that are missing.
    pub(super) fn complete_planes(&mut self) {
        if self.compact.is_used {
            for id in 0..self.surface.slots() as FaceId {
                let face = self.surface.face_mut(id);
                if face.is_alive() {
                    face.data = self.vertices.plane_out_of_line(face.vertices);
                }
            }
            self.compact.stop();
        }
    }
}
