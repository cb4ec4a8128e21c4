//! Shadows (paper §5): a light lights the points that it sees. Brightness is then softened
//! over neighbors. There is only diffuse and ambient light. Light passes through holes.

use alloc::vec::Vec;

use crate::base::allocation::{OutOfMemory, filled, with_capacity};
use crate::base::error::{Error, in_range};
use crate::base::sort::sort_keyed;
use crate::cloud::neighbors::{Nearest, Neighbors};
use crate::cloud::point_cloud::PointCloud;
use crate::view::options::Options;
use crate::view::refusals::QuestionKind;

/// The number of neighbors of a point where there is no mesh.
const NEIGHBORS: usize = 6;
/// The largest number of rounds; more change little and take long.
const MOST_ROUNDS: f64 = 1000.0;

/// How light is spread and softened.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lighting<'a> {
    /// A mesh of the points, as indices into the cloud. Shadows are softened along its edges.
    /// Without a mesh they are softened over the 6 nearest points.
    pub triangles: Option<&'a [[u32; 3]]>,
    /// How many times every point takes the mean of itself and its neighbors: 1 by default, at
    /// most 1000.
    pub smoothing: usize,
    /// The brightness of a point that no light sees, from 0 to 1; 0 by default.
    pub ambient: f64,
}

impl Default for Lighting<'_> {
    fn default() -> Self {
        Self {
            triangles: None,
            smoothing: 1,
            ambient: 0.0,
        }
    }
}

impl PointCloud {
    /// The brightness of every index, from 0 to 1, under point `lights`: ambient +
    /// (1 − ambient)·(lights that see the point ÷ lights), then softened. Indices that
    /// were skipped or removed are not lit. Without lights every point has the ambient brightness.
    ///
    /// ```
    /// use hidden_point_removal::{Lighting, Options, PointCloud};
    ///
    /// let cloud = PointCloud::new(&[[0.0, 0.0, 1.0], [0.0, 0.0, 2.0]])?;
    /// let lighting = Lighting { smoothing: 0, ambient: 0.25, ..Lighting::default() };
    /// let lights = [[0.0, 0.0, 9.0], [0.0, 0.0, -9.0]];
    /// let brightness = cloud.illuminate(&lights[..1], &Options::default(), &lighting)?;
    /// assert_eq!(brightness, [0.25, 1.0]);
    /// let brightness = cloud.illuminate(&lights, &Options::default(), &lighting)?;
    /// assert_eq!(brightness, [0.625, 0.625]);
    /// # Ok::<(), hidden_point_removal::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for `smoothing` or `ambient`; [`Error::IndexOutOfRange`] for
    /// a corner that is no index of the cloud; [`Error::Excludes`] for
    /// [`Inversion::Looks`](crate::Inversion::Looks); otherwise as
    /// [`PointCloud::visible_from`].
    pub fn illuminate(
        &self,
        lights: &[[f64; 3]],
        options: &Options,
        lighting: &Lighting,
    ) -> Result<Vec<f32>, Error> {
        options.check(QuestionKind::Illuminate)?;
        let ambient = in_range("ambient", lighting.ambient, 0.0, 1.0)?;
        in_range("smoothing", lighting.smoothing as f64, 0.0, MOST_ROUNDS)?;
        let mut corners = lighting.triangles.unwrap_or(&[]).iter().flatten();
        let len = self.len();
        if let Some(&index) = corners.find(|&&i| i as usize >= len) {
            return Err(Error::IndexOutOfRange { index, len });
        }

        let mut brightness = filled(len, 0.0)?;
        self.each_view(lights, options, &mut |_, seen| {
            for &index in seen.indices() {
                brightness[index as usize] += 1.0;
            }
        })?;
        let share = (1.0 - ambient) / (lights.len().max(1) as f64);
        for light in &mut brightness {
            *light = ambient + share * *light;
        }
        if lighting.smoothing > 0 && !lights.is_empty() {
            self.part(None, options)?
                .soften(&mut brightness, lighting)?;
        }

        let mut rounded: Vec<f32> = with_capacity(len)?;
        rounded.extend(brightness.iter().map(|&light| light as f32));
        Ok(rounded)
    }

    fn soften(&self, brightness: &mut Vec<f64>, lighting: &Lighting) -> Result<(), OutOfMemory> {
        if let Some(triangles) = lighting.triangles {
            let links = Links::along_edges(triangles, brightness.len())?;
            return links.average(brightness, lighting.smoothing);
        }
        // Equal points count as one.
        let count = self.sequence.points.len();
        let links = Links::among_nearest(&Neighbors::new(&self.sequence.points)?, count)?;
        let mut distinct = filled(count, 0.0)?;
        let first = |k: usize| self.sequence.indices_of(k).first().map(|&i| i as usize);
        for (k, light) in distinct.iter_mut().enumerate() {
            *light = first(k).map_or(0.0, |index| brightness[index]);
        }
        links.average(&mut distinct, lighting.smoothing)?;
        for (k, &light) in distinct.iter().enumerate() {
            for &index in self.sequence.indices_of(k) {
                brightness[index as usize] = light;
            }
        }
        Ok(())
    }
}

/// The neighbors of every point, as lists one after another.
struct Links {
    /// Where each list starts in `others`, with an end mark.
    starts: Vec<usize>,
    others: Vec<u32>,
}

impl Links {
    fn among_nearest(neighbors: &Neighbors, count: usize) -> Result<Self, OutOfMemory> {
        let mut links = Self {
            starts: Vec::new(),
            others: Vec::new(),
        };
        links.starts.try_reserve_exact(count + 1)?;
        links.others.try_reserve_exact(count * NEIGHBORS)?;
        let mut nearest = Nearest::with_capacity(NEIGHBORS)?;
        for point in 0..count {
            neighbors.find(point, &mut nearest);
            links.starts.push(links.others.len());
            links
                .others
                .extend(nearest.found().iter().map(|other| other.index));
        }
        links.starts.push(links.others.len());
        Ok(links)
    }

    fn along_edges(triangles: &[[u32; 3]], count: usize) -> Result<Self, OutOfMemory> {
        // Each edge has a number that sorts it by its ends.
        let mut edges: Vec<(u64, u32)> = with_capacity(triangles.len() * 6)?;
        let edge = |from: u32, to: u32| (u64::from(from) << 32 | u64::from(to), to);
        for &[a, b, c] in triangles {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                if from != to {
                    edges.extend([edge(from, to), edge(to, from)]);
                }
            }
        }
        sort_keyed(&mut edges);
        edges.dedup();
        let mut starts: Vec<usize> = with_capacity(count + 1)?;
        let mut others: Vec<u32> = with_capacity(edges.len())?;
        for vertex in 0..count {
            starts.push(others.len());
            let own = edges[others.len()..].iter();
            let own = own.take_while(|(ends, _)| (ends >> 32) as usize == vertex);
            others.extend(own.map(|(_, to)| to));
        }
        starts.push(others.len());
        Ok(Self { starts, others })
    }

    /// Each value becomes the mean of itself and its neighbors' values, `rounds` times.
    fn average(&self, values: &mut Vec<f64>, rounds: usize) -> Result<(), OutOfMemory> {
        let mut next = filled(values.len(), 0.0)?;
        for _ in 0..rounds {
            for (i, mean) in next.iter_mut().enumerate() {
                let others = &self.others[self.starts[i]..self.starts[i + 1]];
                let sum: f64 = others.iter().map(|&other| values[other as usize]).sum();
                *mean = (values[i] + sum) / (others.len() + 1) as f64;
            }
            core::mem::swap(values, &mut next);
        }
        Ok(())
    }
}
