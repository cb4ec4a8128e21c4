//! One sector of a cloud in parts: which of its points are visible, and what else has to be known?

use alloc::vec::Vec;

use crate::answers::merge::check_mergeable;
use crate::base::allocation::{OutOfMemory, filled, with_capacity};
use crate::base::error::Error;
use crate::cloud::point_cloud::{NonFinite, PointCloud};
use crate::cloud::points::{Points, Position, checked_len, is_finite};
use crate::hull;
use crate::view::options::Options;

/// What [`share_visible`] answers. All lists ascend.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Share {
    visible: Vec<u32>,
    undecided: Vec<u32>,
    needed: Vec<u32>,
    missing: Vec<u32>,
}

impl Share {
    /// The indices of own points that are visible in the whole cloud. This is certain.
    #[must_use]
    pub fn visible(&self) -> &[u32] {
        &self.visible
    }

    /// The indices of own points that may be visible or hidden. The others are decided.
    #[must_use]
    pub fn undecided(&self) -> &[u32] {
        &self.undecided
    }

    /// The indices of the given points, own ones first, that can still hide others: those that are
    /// visible among the given points.
    #[must_use]
    pub fn needed(&self) -> &[u32] {
        &self.needed
    }

    /// The numbers of the boxes whose points may hide undecided points. If there is none, no point
    /// is undecided.
    #[must_use]
    pub fn missing(&self) -> &[u32] {
        &self.missing
    }
}

/// Which of the `own` points of a cloud are visible, if only a part of the cloud is at hand?
///
/// For clouds in parts that are too large for [`merge_visible`](crate::merge_visible). Each of
/// several machines answers for its own points, for example for those in one sector of the directions.
/// `others` are points near the sector. All further points of the cloud are in `elsewhere`: boxes,
/// each with its least and its largest coordinates, borders included.
///
/// Whatever is given, a point in [`Share::visible`] is visible in the whole cloud, and an own point that
/// is neither there nor in [`Share::undecided`] is hidden. If points are undecided, ask again:
/// the undecided points are own ones, the other [needed](Share::needed) points and all points of
/// the [missing](Share::missing) boxes are others, and these boxes are left out. Every question
/// empties boxes or decides all points, so this ends. Boxes that follow each other should be near
/// each other, then it is faster.
///
/// ```
/// use hidden_point_removal::{Options, share_visible};
///
/// let own = [[0.0, 0.0, 0.0], [0.1, 0.0, 0.0], [0.0, 0.1, 0.0], [-0.1, -0.1, 0.0]];
/// let (viewpoint, options) = ([0.0, 0.0, 5.0], Options::with_radius(100.0));
/// let behind = [[-0.1, -0.1, -9.0], [0.1, 0.1, -7.0]];
/// let before = [[-0.1, -0.1, 1.0], [0.1, 0.1, 2.0]];
///
/// let share = share_visible(&own, &[], &[behind], viewpoint, &options)?;
/// assert_eq!(share.visible()[0], 0);
/// let share = share_visible(&own, &[], &[behind, before], viewpoint, &options)?;
/// assert_eq!(share.undecided()[0], 0);
/// assert!(share.missing().contains(&1));
/// # Ok::<(), hidden_point_removal::Error>(())
/// ```
///
/// # Errors
/// As [`merge_visible`](crate::merge_visible); [`Error::BoundsInvalid`] for a box with a coordinate
/// that is not finite, or with a least coordinate above the largest one.
pub fn share_visible<P: Position>(
    own: &[P],
    others: &[P],
    elsewhere: &[[[f64; 3]; 2]],
    viewpoint: [f64; 3],
    options: &Options,
) -> Result<Share, Error> {
    check_mergeable(options)?;
    let is_box = |[low, high]: &[[f64; 3]; 2]| {
        is_finite(*low) && is_finite(*high) && (0..3).all(|axis| low[axis] <= high[axis])
    };
    if !elsewhere.iter().all(is_box) {
        return Err(Error::BoundsInvalid);
    }
    checked_len(elsewhere.len())?;
    let count = checked_len(own.len().saturating_add(others.len()))?;
    let mut positions = Points::with_capacity(count, P::given(own))?;
    positions.extend(P::given(own), 0..own.len());
    positions.extend(P::given(others), 0..others.len());
    let cloud = PointCloud::prepare(positions.as_given(), NonFinite::Error, &mut |_| ())?;
    drop(positions);
    let view = cloud.view(viewpoint, options)?;

    let points = &cloud.sequence.points;
    let mut owns: Vec<bool> = filled(points.len(), false)?;
    for (place, owns) in owns.iter_mut().enumerate() {
        let indices = cloud.sequence.indices_of(place);
        *owns = indices.iter().any(|&index| (index as usize) < own.len());
    }
    let blocks = &cloud.blocks.levels[0];
    let seen = hull::certain_among(points, blocks, &view.flip, &owns, elsewhere)?;
    let listed = |marks: &dyn Fn(usize) -> bool, below: usize| -> Result<Vec<u32>, OutOfMemory> {
        let mut is_listed = filled(count, false)?;
        for place in (0..points.len()).filter(|&place| marks(place)) {
            for &index in cloud.sequence.indices_of(place) {
                is_listed[index as usize] = true;
            }
        }
        numbers(&is_listed[..below])
    };
    let is_undecided = |place: usize| owns[place] && seen.visible[place] && !seen.certain[place];
    Ok(Share {
        visible: listed(&|place| seen.certain[place], own.len())?,
        undecided: listed(&is_undecided, own.len())?,
        needed: listed(&|place| seen.visible[place], count)?,
        missing: numbers(&seen.missing)?,
    })
}

/// The places of the marks.
fn numbers(marks: &[bool]) -> Result<Vec<u32>, OutOfMemory> {
    let marked = || (0..).zip(marks).filter(|(_, mark)| **mark);
    let mut numbers = with_capacity(marked().count())?;
    numbers.extend(marked().map(|(number, _)| number));
    Ok(numbers)
}
