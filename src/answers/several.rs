//! One answer from several viewpoints (paper §5: more viewpoints around C help at
//! silhouettes).

use crate::answers::visibility::Visibility;
use crate::base::allocation::{filled, with_capacity};
use crate::base::error::{Error, in_range};
use crate::base::real::{sine_cosine, square_root};
use crate::cloud::point_cloud::PointCloud;
use crate::view::camera::Seat;
use crate::view::options::{Inversion, Options};
use crate::view::radius::ChosenRadius;
use crate::view::refusals::QuestionKind;
use alloc::vec::Vec;
use glam::DVec3;

impl PointCloud {
    /// Which points are visible from at least one of `viewpoints`, or in the image of at least one camera? Each view chooses its own R by
    /// `options`. The answer holds the largest R, and the largest c where a distance in
    /// [`Options::within`] gives each view its own. It also holds the number of hulls that all
    /// choices took.
    /// Without viewpoints nothing is visible.
    ///
    /// A union over a small ring ([`ring_of_viewpoints`]) finds points at silhouettes that one
    /// view misses. But it shows too much of a plane that is seen edge-on. There, ask for at
    /// least two viewpoints with [`PointCloud::visible_from_at_least`].
    ///
    /// # Errors
    /// As [`PointCloud::visible_from`]; [`Error::Camera`].
    pub fn visible_from_any<S: Copy + Into<Seat> + Sync>(
        &self,
        viewpoints: &[S],
        options: &Options,
    ) -> Result<Visibility, Error> {
        self.visible_from_several(1, viewpoints, options)
    }

    /// Which points are visible from at least `k` of `viewpoints`? Otherwise as
    /// [`PointCloud::visible_from_any`].
    ///
    /// ```
    /// use hidden_point_removal::{Options, PointCloud, ring_of_viewpoints};
    ///
    /// let cloud = PointCloud::new(&[[0.0, 0.0, 1.0], [0.0, 0.0, 0.5], [1.0, 0.0, 0.0]])?;
    /// let viewpoint = [0.0, 0.0, 5.0];
    /// let mut viewpoints = ring_of_viewpoints(viewpoint, [0.0; 3], 4, 0.05)?;
    /// viewpoints.push(viewpoint);
    /// let options = Options::default();
    /// let safe = cloud.visible_from_at_least(2, &viewpoints, &options)?;
    /// let any = cloud.visible_from_any(&viewpoints, &options)?;
    /// assert!(safe.count() <= any.count());
    /// # Ok::<(), hidden_point_removal::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::OutOfRange`] unless 1 ≤ `k` ≤ the number of viewpoints; otherwise as
    /// [`PointCloud::visible_from`].
    pub fn visible_from_at_least<S: Copy + Into<Seat> + Sync>(
        &self,
        k: usize,
        viewpoints: &[S],
        options: &Options,
    ) -> Result<Visibility, Error> {
        in_range("k", k as f64, 1.0, viewpoints.len() as f64)?;
        self.visible_from_several(k, viewpoints, options)
    }

    /// The answer from no viewpoint.
    fn nothing(&self, options: &Options) -> Result<Visibility, Error> {
        let inversion = match options.inversion {
            Inversion::Looks(_) => options.inversion,
            _ => self.resolved_inversion(options)?,
        };
        self.answer(&[], ChosenRadius::unit(0.0), inversion)
    }

    fn visible_from_several<S: Copy + Into<Seat> + Sync>(
        &self,
        k: usize,
        viewpoints: &[S],
        options: &Options,
    ) -> Result<Visibility, Error> {
        options.check(QuestionKind::Several)?;
        let mut views: Vec<u32> = filled(self.len(), 0)?;
        let mut joined: Option<(usize, Visibility)> = None;
        let size = |view: &Visibility| (view.radius(), view.scale());
        self.each_view(viewpoints, options, &mut |number, seen| {
            for &index in seen.indices() {
                views[index as usize] += 1;
            }
            joined = Some(match joined.take() {
                Some((other, joined)) => {
                    let is_larger = if size(&seen) == size(&joined) {
                        // Of equal radii the first one's exponent counts; with own points each, the last one's.
                        (number > other) == options.has_distance()
                    } else {
                        size(&seen) > size(&joined)
                    };
                    if is_larger {
                        (number, seen.joined(joined))
                    } else {
                        (other, joined.joined(seen))
                    }
                }
                None => (number, seen),
            });
        })?;
        let joined = match joined {
            Some((_, joined)) => joined,
            None => self.part(None, options)?.nothing(options)?,
        };
        let is_seen = |&index: &u32| views[index as usize] as usize >= k;
        let mut indices: Vec<u32> = with_capacity(self.len())?;
        indices.extend((0..self.len() as u32).filter(is_seen));
        Ok(joined.with_indices(indices))
    }
}

/// `count` viewpoints, evenly on a circle around `viewpoint`. The circle is perpendicular to the
/// line to `target`, and its radius is `fraction` of the distance to it; usual values are 4 and
/// 0.05. The viewpoint itself is not in the list.
///
/// # Errors
/// [`Error::Viewpoint`] for a viewpoint or a target that is not finite, or a ring that
/// overflows; [`Error::OutOfRange`] for a `fraction` that is negative or not finite;
/// [`Error::OutOfMemory`].
pub fn ring_of_viewpoints(
    viewpoint: [f64; 3],
    target: [f64; 3],
    count: usize,
    fraction: f64,
) -> Result<Vec<[f64; 3]>, Error> {
    let finite = |place: DVec3| {
        let viewpoint = place.to_array();
        let refused = Error::Viewpoint { viewpoint };
        place.is_finite().then_some(viewpoint).ok_or(refused)
    };
    in_range("fraction", fraction, 0.0, f64::MAX)?;
    let center = DVec3::from_array(viewpoint);
    let ahead = DVec3::from_array(target) - center;
    finite(center)?;
    finite(ahead)?;

    // Scaled, so that squares neither overflow nor underflow.
    let size = ahead.abs().max_element();
    let (mut right, mut up, mut radius) = (DVec3::ZERO, DVec3::ZERO, 0.0);
    if size > 0.0 {
        let direction = ahead / size;
        let length = square_root(direction.dot(direction));
        let direction = direction / length;
        let across = direction.cross(DVec3::AXES[direction.abs().min_position()]);
        right = across / square_root(across.dot(across));
        up = right.cross(direction);
        radius = fraction * length * size;
    }
    let mut ring = with_capacity(count)?;
    for k in 0..count {
        let turn = core::f64::consts::TAU * (k as f64 / count as f64);
        let (sin, cos) = sine_cosine(turn);
        ring.push(finite(center + (right * cos + up * sin) * radius)?);
    }
    Ok(ring)
}

impl PointCloud {
    /// How many of `viewpoints`, or of cameras, see each index? The memory does not grow with their number.
    ///
    /// ```
    /// use hidden_point_removal::{Options, PointCloud};
    ///
    /// let cloud = PointCloud::new(&[[0.0, 0.0, 1.0], [0.0, 0.0, 2.0], [1.0, 0.0, 0.0]])?;
    /// let viewpoints = [[0.0, 0.0, 5.0], [0.0, 0.0, -5.0]];
    /// assert_eq!(cloud.coverage(&viewpoints, &Options::default())?, [1, 1, 2]);
    /// # Ok::<(), hidden_point_removal::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Excludes`] for scores; [`Error::Camera`]; otherwise as [`PointCloud::visible_from`].
    pub fn coverage<S: Copy + Into<Seat> + Sync>(
        &self,
        viewpoints: &[S],
        options: &Options,
    ) -> Result<Vec<u32>, Error> {
        let mut counts: Vec<u32> = filled(self.len(), 0)?;
        options.check(QuestionKind::Coverage)?;
        self.each_view(viewpoints, options, &mut |_, seen| {
            let indices = seen.indices().iter();
            indices.for_each(|&index| counts[index as usize] += 1);
        })?;
        Ok(counts)
    }
}
