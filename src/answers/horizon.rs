//! A horizon: the hull of some points of a cloud, which hides other points for good.

use alloc::vec::Vec;

use crate::answers::merge::check_mergeable;
use crate::base::allocation::{push, with_capacity};
use crate::base::error::{Error, check_box};
use crate::cloud::point_cloud::{NonFinite, PointCloud};
use crate::cloud::points::{Given, Points, Position, checked_len, is_finite};
use crate::flip::inversion::Flip;
use crate::hull::{KeptHull, hides_box};
use crate::view::options::{Options, Radius};
use crate::view::radius::check_reach;
use crate::view::resolved::numbered_flip;

/// The hull of some points of a cloud, as seen from one viewpoint. It tells which other points of
/// the cloud are hidden, wherever they are stored.
///
/// K, the hull of the flipped points and the viewpoint, only grows when points are added. So a
/// point that is hidden by some points of a cloud is hidden in the whole cloud. A horizon of a
/// sample thus screens the other points, file by file, and rules out whole boxes unread. Then
/// [`merge_visible`](crate::merge_visible) answers exactly for the few points that are left.
///
/// ```
/// use hidden_point_removal::{Horizon, Options};
///
/// let mut horizon = Horizon::new([0.0, 0.0, 5.0], &Options::radius(100.0))?;
/// horizon.add(&[[-0.1, -0.1, 1.0], [0.1, -0.1, 1.0], [0.0, 0.2, 1.0]])?;
/// assert_eq!(horizon.screen(&[[0.0, 0.0, 0.0], [3.0, 0.0, 0.0]])?, [1]);
/// assert!(horizon.hides_box([-0.01, -0.01, -1.0], [0.01, 0.01, 0.0])?);
/// # Ok::<(), hidden_point_removal::Error>(())
/// ```
pub struct Horizon {
    radius: Radius,
    flip: Flip,
    /// The points that were given and are visible among them.
    visible: Points,
    hull: KeptHull,
}

impl Horizon {
    /// A horizon without points, which hides nothing.
    ///
    /// # Errors
    /// [`Error::MergeRadius`] unless the radius or the inversion is a number, as in
    /// [`merge_visible`](crate::merge_visible), and its other errors that concern `options`;
    /// [`Error::Viewpoint`].
    pub fn new(viewpoint: [f64; 3], options: &Options) -> Result<Self, Error> {
        check_mergeable(options)?;
        let flip = numbered_flip(viewpoint, options)?;
        let visible = Points::Single(Vec::new());
        Ok(Self {
            radius: options.radius,
            flip,
            hull: KeptHull::of(&visible, &[], &flip)?,
            visible,
        })
    }

    /// Adds points. The horizon then hides what all points so far hide together.
    ///
    /// # Errors
    /// [`Error::NonFinite`], [`Error::Radius`] for a point beyond the radius,
    /// [`Error::TooManyPoints`], [`Error::OutOfMemory`]. The horizon is unchanged then.
    pub fn add<P: Position>(&mut self, positions: &[P]) -> Result<(), Error> {
        self.grow(P::given(positions))
    }

    #[inline(never)]
    pub(crate) fn grow(&mut self, given: Given) -> Result<(), Error> {
        let new = self.not_hidden(given)?;
        let precision = match self.visible {
            Points::Single(_) => given,
            Points::Double(_) => self.visible.as_given(),
        };
        let count = checked_len(self.visible.len().saturating_add(new.len()))?;
        let mut points = Points::with_capacity(count, precision)?;
        points.extend(self.visible.as_given(), 0..self.visible.len());
        new.iter()
            .for_each(|&index| points.push(given.get(index as usize)));
        let cloud = PointCloud::prepare(points.as_given(), NonFinite::Error, &mut |_| ())?;
        drop(points);
        let sorted = &cloud.sequence.points;
        let hull = KeptHull::of(sorted, &cloud.blocks.levels[0], &self.flip)?;
        let mut places: Vec<u32> = with_capacity(sorted.len())?;
        places.extend(
            (0..)
                .zip(hull.visible())
                .filter(|(_, seen)| **seen)
                .map(|(k, _)| k as u32),
        );
        self.visible = sorted.gathered(&places)?;
        self.hull = hull;
        Ok(())
    }

    /// The indices of the points that the horizon does not hide, ascending. A point that is not
    /// among them is hidden in every cloud that holds the horizon's points. A point is among them
    /// exactly if it is visible in the cloud of the horizon's points and this point.
    ///
    /// # Errors
    /// As [`Horizon::add`].
    pub fn screen<P: Position>(&self, positions: &[P]) -> Result<Vec<u32>, Error> {
        self.not_hidden(P::given(positions))
    }

    #[inline(never)]
    pub(crate) fn not_hidden(&self, given: Given) -> Result<Vec<u32>, Error> {
        checked_len(given.len())?;
        let bad = || given.iter().enumerate().filter(|&(_, p)| !is_finite(p));
        if let Some((first, _)) = bad().next() {
            let count = bad().count();
            return Err(Error::NonFinite { count, first });
        }
        self.check_reach(given)?;
        let mut kept = Vec::new();
        let mut hint = self.hull.first_hint();
        for (index, position) in (0..).zip(given.iter()) {
            if self.hull.hides(position, &mut hint) != Some(true) {
                push(&mut kept, index)?;
            }
        }
        Ok(kept)
    }

    fn check_reach(&self, given: Given) -> Result<(), Error> {
        check_reach(self.radius, self.flip.viewpoint().to_array(), given)
    }

    /// Whether every point of a box, borders included, is hidden, wherever it is in the box. The
    /// answer `true` is certain. A box may be hidden although the answer is `false`.
    ///
    /// # Errors
    /// [`Error::Parameter`] if a coordinate is not finite, or if one of `min` is above that of
    /// `max`.
    pub fn hides_box(&self, min: [f64; 3], max: [f64; 3]) -> Result<bool, Error> {
        check_box([min, max])?;
        let mut corners = min.into_iter().chain(max);
        if let Some(value) = corners.find(|x| !x.is_finite()) {
            return Err(Error::Parameter {
                option: "a box",
                must_be: "finite",
                value,
            });
        }
        // Points outside of the sphere cannot be flipped.
        if self
            .check_reach(Given::Double(&corners_of(min, max)))
            .is_err()
        {
            return Ok(false);
        }
        Ok(hides_box(&self.hull, min, max))
    }

    /// The points that were added and are not hidden by others of them. A horizon of these points
    /// hides the same as this one. So only they have to be sent to other machines.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn visible(&self) -> Result<Vec<[f64; 3]>, Error> {
        let mut points = with_capacity(self.visible.len())?;
        points.extend(self.visible.iter());
        Ok(points)
    }
}

/// The eight corners of a box.
fn corners_of(min: [f64; 3], max: [f64; 3]) -> [[f64; 3]; 8] {
    core::array::from_fn(|corner| {
        core::array::from_fn(|axis| {
            if corner >> axis & 1 == 0 {
                min[axis]
            } else {
                max[axis]
            }
        })
    })
}
