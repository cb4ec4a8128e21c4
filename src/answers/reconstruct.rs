//! View-dependent reconstruction (paper §5): the hull's own triangles, drawn between the
//! points at their own places.

use alloc::vec::Vec;

use crate::answers::visibility::Visibility;
use crate::base::allocation::{OutOfMemory, filled, with_capacity};
use crate::base::error::{Error, in_range};
use crate::base::real::square_root;
use crate::base::sort::sort_keyed;
use crate::cloud::neighbors::distance_squared;
use crate::cloud::point_cloud::PointCloud;
use crate::hull;
use crate::view::options::Options;
use crate::view::refusals::QuestionKind;

/// The default of the longest edge, in spacings. The paper's 2.5 % of the diameter leaves webs
/// on dense clouds.
const SPACINGS: f64 = 5.0;

/// The visible points of a view, and the mesh between them.
#[derive(Clone, Debug, PartialEq)]
pub struct Reconstruction {
    /// The visible points.
    pub visibility: Visibility,
    /// Triangles as indices into the cloud, counter-clockwise seen from the viewpoint, ordered by
    /// their corners.
    pub triangles: Vec<[u32; 3]>,
}

impl PointCloud {
    /// The surface that `viewpoint` sees: the triangles of the convex hull of the flipped points,
    /// with the corners back at their own places. It is the hull that decides visibility; no
    /// second hull is built.
    ///
    /// Triangles with an edge longer than `max_edge` are left out (`None`: 5 spacings; infinity
    /// keeps all), and so are triangles that touch the viewpoint. The lowest index stands for
    /// equal points.
    ///
    /// ```
    /// use hidden_point_removal::{Options, PointCloud};
    ///
    /// let cloud = PointCloud::new(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])?;
    /// let front = cloud.reconstruct([0.2, 0.2, 5.0], &Options::default(), None)?;
    /// assert_eq!(front.triangles, [[0, 1, 2]]);
    /// let back = cloud.reconstruct([0.2, 0.2, -5.0], &Options::default(), None)?;
    /// assert_eq!(back.triangles, [[0, 2, 1]]);
    /// # Ok::<(), hidden_point_removal::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a `max_edge` that is negative or NaN; [`Error::Excludes`]
    /// for [`Inversion::Looks`](crate::Inversion::Looks), which are several hulls; otherwise
    /// as [`PointCloud::visible_from`].
    pub fn reconstruct(
        &self,
        viewpoint: [f64; 3],
        options: &Options,
        max_edge: Option<f64>,
    ) -> Result<Reconstruction, Error> {
        options.check(QuestionKind::Reconstruct)?;
        let part = self.part(Some(viewpoint), options)?;
        let longest = match max_edge {
            Some(longest) => longest,
            None => SPACINGS * part.spacing()?,
        };
        in_range("maxEdge", longest, 0.0, f64::INFINITY)?;
        let (visibility, mut triangles) = part.triangulate(viewpoint, options)?;
        if longest < f64::INFINITY {
            let places = self.places()?;
            let at = |index: u32| self.sequence.points.get(places[index as usize] as usize);
            triangles.retain(|&[a, b, c]| {
                let [a, b, c] = [a, b, c].map(at);
                let edges = [(a, b), (b, c), (c, a)];
                edges
                    .into_iter()
                    .all(|(a, b)| square_root(distance_squared(a, b)) <= longest)
            });
        }
        Ok(Reconstruction {
            visibility,
            triangles,
        })
    }

    /// The visible points and all triangles, with the caller's indices.
    fn triangulate(
        &self,
        viewpoint: [f64; 3],
        options: &Options,
    ) -> Result<(Visibility, Vec<[u32; 3]>), Error> {
        let view = self.view(viewpoint, options)?;
        let (visible, mut triangles) =
            hull::triangulate_visible(&self.sequence.points, &view.flip)?;
        let lowest = |k: u32| self.sequence.indices_of(k as usize).iter().copied().min();
        for corners in &mut triangles {
            // Every distinct point has an index.
            *corners = corners.map(|k| lowest(k).unwrap_or(k));
            let first = (0..3).min_by_key(|&i| corners[i]).unwrap_or(0);
            corners.rotate_left(first);
        }
        sort_by_corners(&mut triangles)?;
        let visibility = self.answer(&visible, view.chosen, view.inversion)?;
        Ok((visibility, triangles))
    }

    /// The distinct point of each index of the cloud; any number for an index without a point.
    pub(crate) fn places(&self) -> Result<Vec<u32>, OutOfMemory> {
        let mut places: Vec<u32> = filled(self.len(), 0)?;
        for k in 0..self.sequence.points.len() {
            for &index in self.sequence.indices_of(k) {
                places[index as usize] = k as u32;
            }
        }
        Ok(places)
    }
}

/// Sorts triangles of a surface by their first two corners, which no other triangle has in
/// this order.
fn sort_by_corners(triangles: &mut [[u32; 3]]) -> Result<(), OutOfMemory> {
    let mut edges: Vec<(u64, u32)> = with_capacity(triangles.len())?;
    for &[a, b, c] in &*triangles {
        edges.push((u64::from(a) << 32 | u64::from(b), c));
    }
    sort_keyed(&mut edges);
    for (corners, (edge, c)) in triangles.iter_mut().zip(edges) {
        *corners = [(edge >> 32) as u32, edge as u32, c];
    }
    Ok(())
}
