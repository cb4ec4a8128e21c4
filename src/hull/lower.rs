//! The lower boundary of a convex hull: the points that a viewer infinitely far below sees.
//!
//! INPUT    points (x, y, w); the viewer looks along +w, and the ghost vertex is
//!          infinitely far above.
//! OUTPUT   for each point whether it is on the lower boundary of the hull: no point
//!          of the hull with the same x, y has a smaller w. Exact.
//! SUMMARY  The same method as in `incremental`, but the rays are vertical lines. The
//!          lower boundary, seen along w, is a triangulation of the plane. Walks in it
//!          cannot go in circles, because it is a regular triangulation (Edelsbrunner: An
//!          acyclicity theorem for cell complexes in d dimensions, 1990).

use alloc::vec::Vec;
use glam::DVec3;

use crate::base::allocation::{OutOfMemory, filled, push, reserve, with_capacity};
use crate::base::sort::sorted_places;
use crate::hull::flat::convex_chain;
use crate::hull::order;
use crate::hull::outer_faces::{Exit, OuterFaces, border_of};
use crate::hull::predicates::{Sign, orient2d, side_of_face};
use crate::hull::topology::{Face, FaceId, Surface, Vertex};

/// The ghost vertex, infinitely far up.
const ABOVE: Vertex = 0;

/// Marks the points on the lower boundary among `count`, and returns its faces. There are none
/// where all points lie above one line.
pub(crate) fn lower_boundary<'a>(
    count: u32,
    lifted: &'a dyn Fn(u32) -> DVec3,
) -> Result<(Vec<bool>, Option<LowerFaces<'a>>), OutOfMemory> {
    let mut visible = filled(count as usize, false)?;
    let seed = first_triangle(count, order::sample_step(count), lifted)
        .or_else(|| first_triangle(count, 1, lifted));
    let Some(corners) = seed else {
        mark_upright(count, lifted, &mut visible)?;
        return Ok((visible, None));
    };
    let (hull, last) = mark_in_space(count, lifted, corners, &mut visible)?;
    Ok((visible, Some(LowerFaces { hull, lifted, last })))
}

/// The faces of a lower boundary.
pub(crate) struct LowerFaces<'a> {
    hull: LowerHull,
    lifted: &'a dyn Fn(u32) -> DVec3,
    /// The face at which the last walk ended. The next walk starts there.
    last: FaceId,
}

impl OuterFaces for LowerFaces<'_> {
    fn slots(&self) -> usize {
        self.hull.surface.slots()
    }

    fn corners(&self, id: FaceId) -> Option<[Vertex; 3]> {
        let face = self.hull.surface.face(id);
        (face.is_alive() && self.hull.vertices.is_outer(face)).then_some(face.vertices)
    }

    fn border(&self, id: FaceId, pass: &mut dyn FnMut([Vertex; 2])) {
        border_of(&self.hull.surface, id, self, pass);
    }

    fn points_of_vertices(&self) -> &[u32] {
        &self.hull.vertices.points
    }

    fn exit(&mut self, point: u32) -> Exit {
        // No point is below the boundary, so the walk ends at an outer face.
        let (face, side) = self.hull.locate((self.lifted)(point), self.last);
        self.last = face;
        match side {
            Sign::Zero => Exit::Nowhere,
            _ => Exit::Face(face, self.hull.surface.face(face).vertices),
        }
    }
}

/// Positive when a, b, c are counter-clockwise seen from below.
fn turn(a: DVec3, b: DVec3, c: DVec3) -> Sign {
    orient2d([b.x, b.y], [a.x, a.y], [c.x, c.y])
}

/// Three points from the sample of every `step`th point, counter-clockwise seen from below.
/// They do not all lie above one line.
#[inline(never)]
fn first_triangle(count: u32, step: usize, lifted: &dyn Fn(u32) -> DVec3) -> Option<[u32; 3]> {
    let points = || (0..count).step_by(step).map(|i| (i, lifted(i)));
    let largest = |measure: &dyn Fn(DVec3) -> f64| {
        points().max_by(|(_, p), (_, q)| measure(*p).total_cmp(&measure(*q)))
    };
    let (i, a) = points().next()?;
    let likely = largest(&|p| (p.x - a.x) * (p.x - a.x) + (p.y - a.y) * (p.y - a.y))?;
    // In doubt, any point that is not above the first one.
    let apart = |p: DVec3| p.x != a.x || p.y != a.y;
    let (j, b) = Some(likely)
        .filter(|(_, p)| apart(*p))
        .or_else(|| points().find(|(_, p)| apart(*p)))?;
    let likely = largest(&|p| ((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x)).abs());
    likely
        .into_iter()
        .chain(points())
        .find_map(|(k, c)| match turn(a, b, c) {
            Sign::Positive => Some([i, j, k]),
            Sign::Negative => Some([i, k, j]),
            Sign::Zero => None,
        })
}

/// Returns the hull and an outer face.
fn mark_in_space(
    count: u32,
    lifted: &dyn Fn(u32) -> DVec3,
    corners: [u32; 3],
    visible: &mut [bool],
) -> Result<(LowerHull, FaceId), OutOfMemory> {
    let mut hull = LowerHull::new(corners, lifted)?;
    // Points on the boundary now. They are visible only if they are still on it at the end.
    let mut on_boundary: Vec<u32> = Vec::new();
    let mut hint = 0;
    let rounds = order::coarse_rounds().chain([order::last_round()]);
    for round in rounds {
        for index in round.indices(count) {
            let q = lifted(index);
            let (face, side) = hull.locate(q, hint);
            hint = match side {
                Sign::Positive => hull.insert(index, q, face)?,
                Sign::Zero => {
                    push(&mut on_boundary, index)?;
                    face
                }
                Sign::Negative => face,
            };
        }
    }
    for (_, face) in hull.surface.alive() {
        if hull.vertices.is_outer(face) {
            for vertex in face.vertices {
                visible[hull.vertices.points[vertex as usize] as usize] = true;
            }
        }
    }
    for index in on_boundary {
        let (face, side) = hull.locate(lifted(index), hint);
        visible[index as usize] |= side == Sign::Zero;
        hint = face;
    }
    Ok((hull, hint))
}

struct LowerHull {
    surface: Surface<()>,
    vertices: Vertices,
}

struct Vertices {
    /// The place of each vertex; unused for the ghost vertex, which comes first.
    positions: Vec<DVec3>,
    /// The point of the cloud that each vertex is; unused for the ghost vertex.
    points: Vec<u32>,
}

impl Vertices {
    #[inline]
    fn at(&self, vertex: Vertex) -> DVec3 {
        self.positions[vertex as usize]
    }

    /// Which side of `face` the point `q` is on: positive is outside.
    fn side(&self, face: &Face<()>, q: DVec3) -> Sign {
        let [a, b, c] = face.vertices;
        let upright = |tail, head| turn(self.at(tail), self.at(head), q);
        if a == ABOVE {
            upright(b, c)
        } else if b == ABOVE {
            upright(c, a)
        } else if c == ABOVE {
            upright(a, b)
        } else {
            side_of_face(self.at(a), self.at(b), self.at(c), q)
        }
    }

    /// Whether `face` is neither a ghost face nor upright.
    #[inline]
    fn is_outer(&self, face: &Face<()>) -> bool {
        let [a, b, c] = face.vertices.map(|v| self.at(v));
        !face.vertices.contains(&ABOVE) && turn(a, b, c) == Sign::Positive
    }
}

impl LowerHull {
    fn new(corners: [u32; 3], lifted: &dyn Fn(u32) -> DVec3) -> Result<Self, OutOfMemory> {
        let [a, b, c] = corners;
        let mut surface = Surface::default();
        surface.start(ABOVE, [1, 2, 3], |_| ())?;
        Ok(Self {
            surface,
            vertices: Vertices {
                positions: alloc::vec![DVec3::NAN, lifted(a), lifted(b), lifted(c)],
                points: alloc::vec![u32::MAX, a, b, c],
            },
        })
    }

    /// Walks from the outer face `hint` to the face that is below or above `q`. The walk may also
    /// end at an upright face that has `q` outside. Returns the face, and the side on which `q`
    /// is.
    fn locate(&self, q: DVec3, hint: FaceId) -> (FaceId, Sign) {
        let mut id = hint;
        // The edge that was crossed last need not be tried again.
        let mut entered = 3;
        loop {
            let face = self.surface.face(id);
            let crossed = (0..3).find(|&edge| {
                let tail = self.vertices.at(face.vertices[edge]);
                let head = self.vertices.at(face.vertices[(edge + 1) % 3]);
                edge != entered && turn(tail, head, q) == Sign::Negative
            });
            let Some(edge) = crossed else {
                return (id, self.vertices.side(face, q));
            };
            id = face.twins[edge].face();
            entered = face.twins[edge].edge();
            // The plane of a ghost or upright face is the upright plane through this edge,
            // and q is strictly beyond it.
            if !self.vertices.is_outer(self.surface.face(id)) {
                return (id, Sign::Positive);
            }
        }
    }

    /// Makes a vertex of `q`, which is strictly outside of face `start`. Returns an outer face of
    /// this vertex.
    fn insert(&mut self, point: u32, q: DVec3, start: FaceId) -> Result<FaceId, OutOfMemory> {
        let vertex = self.vertices.positions.len() as Vertex;
        reserve(&mut self.vertices.positions, 1)?;
        reserve(&mut self.vertices.points, 1)?;
        self.vertices.positions.push(q);
        self.vertices.points.push(point);
        let vertices = &self.vertices;
        let conflicts = |face: &Face<()>| vertices.side(face, q) == Sign::Positive;
        self.surface.find_cavity(start, conflicts)?;
        self.surface.fill_cavity(vertex, |_| (), |(), ()| ())?;
        let is_outer = |&id: &FaceId| self.vertices.is_outer(self.surface.face(id));
        let outer = self.surface.fan().iter().rev().copied().find(is_outer);
        Ok(outer.expect("a new vertex is on the lower boundary"))
    }
}

/// Marks the points where all lie above one line or one point. The hull is a polygon then.
fn mark_upright(
    count: u32,
    lifted: &dyn Fn(u32) -> DVec3,
    visible: &mut [bool],
) -> Result<(), OutOfMemory> {
    if count == 0 {
        return Ok(());
    }
    // Points that are not above each other differ in this coordinate.
    let first = lifted(0);
    let by_x = (0..count).any(|i| lifted(i).x != first.x);
    let mut places: Vec<[f64; 2]> = with_capacity(count as usize)?;
    // Adding 0 makes -0 the same as 0.
    places.extend((0..count).map(|i| {
        let p = lifted(i);
        let along = if by_x { p.x } else { p.y };
        [along + 0.0, p.z + 0.0]
    }));
    let sorted = sorted_places(&places)?;
    let at = |k: u32| places[sorted[k as usize] as usize];
    // Among points with equal first coordinates, only the lowest can be on the lower side.
    let count = sorted.len() as u32;
    let is_lowest = |&k: &u32| k == 0 || at(k - 1)[0] != at(k)[0];
    let mut chain: Vec<u32> = with_capacity(sorted.len())?;
    convex_chain(&mut (0..count).filter(is_lowest), &at, &mut chain);
    for start in chain {
        let equal = (start..count).take_while(|&k| at(k) == at(start));
        equal.for_each(|k| visible[sorted[k as usize] as usize] = true);
    }
    Ok(())
}
