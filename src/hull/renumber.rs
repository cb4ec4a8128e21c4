//! New numbers for a hull's vertices and faces: along the spatial order of the points. A hull
//! that is moved is read from end to end. Neighbors in memory are then neighbors in space, and
//! most reads find their data in a cache.

use alloc::vec::Vec;

use super::incremental::{Hull, ORIGIN, Vertices};
use super::topology::{FaceId, HalfEdge, Surface, Vertex};
use crate::base::allocation::{OutOfMemory, filled, with_capacity};

/// Bits of one word of a set of points.
const WORD: u32 = 64;

/// A set of points that tells how many of its members come before a point.
struct Ranks {
    words: Vec<u64>,
    /// Members before each word.
    before: Vec<u32>,
}

impl Ranks {
    fn of(members: impl Iterator<Item = u32>, count: usize) -> Result<Self, OutOfMemory> {
        let mut words = filled(count.div_ceil(WORD as usize), 0u64)?;
        for point in members {
            words[(point / WORD) as usize] |= 1 << (point % WORD);
        }
        let mut before = with_capacity(words.len())?;
        let mut sum = 0;
        for word in &words {
            before.push(sum);
            sum += word.count_ones();
        }
        Ok(Self { words, before })
    }

    fn len(&self) -> usize {
        let last = self.words.last().map_or(0, |word| word.count_ones());
        last as usize + self.before.last().map_or(0, |&before| before as usize)
    }

    fn rank(&self, point: u32) -> u32 {
        let word = (point / WORD) as usize;
        let lower = self.words[word] & ((1 << (point % WORD)) - 1);
        self.before[word] + lower.count_ones()
    }

    fn members(&self) -> impl Iterator<Item = u32> + '_ {
        (0..).zip(&self.words).flat_map(|(place, &word)| {
            let mut rest = word;
            core::iter::from_fn(move || {
                let bit = (rest != 0).then(|| rest.trailing_zeros())?;
                rest &= rest - 1;
                Some(place * WORD + bit)
            })
        })
    }
}

impl Hull {
    /// Numbers the vertices along the order of their points, and the faces along their lowest
    /// vertices. No number is free afterwards. Positions and planes must be computed again.
    /// `witnesses` are numbers of faces; they change with the faces. `count` is the number of
    /// points.
    #[inline(never)]
    pub(super) fn renumber(
        &mut self,
        count: usize,
        witnesses: &mut [FaceId],
    ) -> Result<(), OutOfMemory> {
        let Vertices {
            points,
            positions,
            free,
            ..
        } = &mut self.vertices;
        let used = self.surface.alive().flat_map(|(_, face)| face.vertices);
        let used = used.filter(|&vertex| vertex != ORIGIN);
        let ranks = Ranks::of(used.map(|vertex| points[vertex as usize]), count)?;
        let number = |vertex: Vertex| match vertex {
            ORIGIN => ORIGIN,
            vertex => 1 + ranks.rank(points[vertex as usize]),
        };
        self.surface.renumber(&number, ranks.len() + 1, witnesses)?;
        points.truncate(1);
        points.extend(ranks.members());
        positions.truncate(points.len());
        free.clear();
        self.compact.stop();
        Ok(())
    }
}

impl<T: Copy> Surface<T> {
    /// Gives each vertex its `number`, below `count`. Numbers the faces along their lowest
    /// vertices. Each face gets the data of any face.
    fn renumber(
        &mut self,
        number: &dyn Fn(Vertex) -> Vertex,
        count: usize,
        witnesses: &mut [FaceId],
    ) -> Result<(), OutOfMemory> {
        let mut ends: Vec<FaceId> = filled(count, 0)?;
        for face in self.faces.iter_mut().filter(|face| face.is_alive()) {
            face.vertices = face.vertices.map(number);
            ends[lowest(face.vertices) as usize] += 1;
        }
        let mut total = 0;
        for end in &mut ends {
            (total, *end) = (total + *end, total);
        }
        let mut numbers: Vec<FaceId> = filled(self.faces.len(), 0)?;
        let none = ([ORIGIN; 3], [HalfEdge::new(0, 0); 3]);
        let mut ordered = filled(total as usize, none)?;
        for (face, new) in self.faces.iter().zip(&mut numbers) {
            if face.is_alive() {
                let end = &mut ends[lowest(face.vertices) as usize];
                *new = *end;
                ordered[*end as usize] = (face.vertices, face.twins);
                *end += 1;
            }
        }
        self.faces.truncate(ordered.len());
        for (face, (vertices, twins)) in self.faces.iter_mut().zip(ordered) {
            face.vertices = vertices;
            face.twins =
                twins.map(|twin| HalfEdge::new(numbers[twin.face() as usize], twin.edge() as u32));
        }
        for witness in witnesses {
            *witness = numbers[*witness as usize];
        }
        self.free.clear();
        Ok(())
    }
}

fn lowest([a, b, c]: [Vertex; 3]) -> Vertex {
    a.min(b).min(c)
}
