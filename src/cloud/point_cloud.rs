//! The cloud: checked positions in spatial order, duplicates grouped, and everything else
//! that does not depend on the viewpoint.

use alloc::boxed::Box;
use alloc::sync::Arc;
use alloc::vec::Vec;
use core::fmt;

use crate::base::allocation::{OutOfMemory, filled};
use crate::base::error::Error;
use crate::base::threads::Once;
use crate::cloud::blocks::Blocks;
use crate::cloud::noise::Noise;
use crate::cloud::points::{Given, Points, Position, checked_len, is_finite};
use crate::cloud::selection::Region;
use crate::cloud::sequence::Sequence;
use crate::cloud::spatial::{Bounds, HilbertCurve};
use crate::cloud::statistics::{Sampled, Statistics, sample_of};

/// The share of a cloud's building that is done when its points are checked, and when
/// they are sorted.
const SURVEYED: f64 = 0.05;
const SORTED: f64 = 0.85;

/// The choice about points with a NaN or infinite coordinate.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum NonFinite {
    /// The cloud is refused with [`Error::NonFinite`].
    #[default]
    Error,
    /// They keep their indices, are never visible and hide nothing.
    Skip,
}

/// A point cloud, prepared for visibility queries.
///
/// Building costs one sort, O(n log n). Each query reuses it. A cloud takes 17 bytes a point
/// for `f32` positions, 29 for `f64`. While points are appended or removed, it takes twice
/// that.
///
/// Answers and automatic radii depend on the present points alone. A cloud that was
/// appended to and removed from answers, to the bit, like a new cloud of the same points.
#[derive(Clone)]
pub struct PointCloud {
    pub(crate) sequence: Sequence,
    /// The box of the present points.
    pub(crate) bounds: Bounds,
    pub(crate) blocks: Blocks,
    pub(crate) kept: Kept,
    non_finite: NonFinite,
    len: usize,
    skipped: usize,
}

/// What is kept for the next questions.
#[derive(Default)]
pub(crate) struct Kept {
    /// The cloud of the points in a region.
    pub within: Option<(Region, Box<PointCloud>)>,
    pub sample: Once<Arc<Sampled>>,
    pub statistics: Once<Statistics>,
    pub noise: Once<Arc<Noise>>,
    /// Its points moved all the way, and as far as the cloud is noisy.
    pub smooth: [Once<Arc<Smooth>>; 2],
    /// The cloud of the points that a mask marks, with one byte for each index.
    #[cfg(feature = "lite")]
    pub masked: Option<(Vec<u8>, Box<PointCloud>)>,
}

/// What looks know of a cloud before they look.
#[derive(Clone)]
pub(crate) struct Survey {
    pub noise: Arc<Noise>,
    /// How far it counts as noisy and as layered.
    pub shares: [f64; 2],
    /// The cloud without its noise, if the looks are at that.
    pub smooth: Option<Arc<Smooth>>,
}

/// A cloud whose points moved to the planes of their neighbors.
pub(crate) struct Smooth {
    pub cloud: Box<PointCloud>,
    pub noise: Arc<Noise>,
}

impl Clone for Kept {
    /// A copy of a cloud keeps nothing: its questions may be others.
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl PointCloud {
    /// Prepares `positions`, in any units.
    ///
    /// # Errors
    /// [`Error::NonFinite`], [`Error::TooManyPoints`], [`Error::OutOfMemory`].
    pub fn new<P: Position>(positions: &[P]) -> Result<Self, Error> {
        Self::with_non_finite(positions, NonFinite::Error)
    }

    /// Like [`PointCloud::new`], with a choice about points that are not finite,
    /// which holds for appended points, too.
    ///
    /// # Errors
    /// As [`PointCloud::new`].
    pub fn with_non_finite<P: Position>(
        positions: &[P],
        non_finite: NonFinite,
    ) -> Result<Self, Error> {
        Self::prepare(P::given(positions), non_finite, &mut |_| ())
    }

    /// Prepares a cloud. Calls `progress` with about the share of the work that is done.
    pub(crate) fn prepare(
        positions: Given,
        non_finite: NonFinite,
        progress: &mut dyn FnMut(f64),
    ) -> Result<Self, Error> {
        let len = checked_len(positions.len())?;
        let (bounds, skipped) = bounds_of(positions, non_finite)?;
        progress(SURVEYED);
        let curve = HilbertCurve::new(&bounds);
        let sequence = Sequence::sorted(positions, 0, len - skipped, &curve)?;
        progress(SORTED);
        let blocks = Blocks::around(&sequence.points)?;
        progress(1.0);
        Ok(Self {
            sequence,
            bounds,
            blocks,
            kept: Kept::default(),
            non_finite,
            len,
            skipped,
        })
    }

    /// Adds points, which take the next indices: all of them, or none and an error.
    ///
    /// They are sorted and merged into the present order. This takes O(n + m log m) time for m new
    /// points. If they extend the cloud's box beyond a power of two (or a multiple of it), the
    /// whole cloud is sorted again, as when it is built.
    ///
    /// Positions keep their precision: `f64` positions make an `f32` cloud an `f64` one.
    ///
    /// ```
    /// use hidden_point_removal::{Options, PointCloud};
    ///
    /// let mut cloud = PointCloud::new(&[[0.0f32, 0.0, 1.0]])?;
    /// cloud.append(&[[0.0f32, 0.0, 2.0]])?;
    /// let visible = cloud.visible_from([0.0, 0.0, 5.0], &Options::default())?;
    /// assert_eq!(visible.indices(), [1]);
    ///
    /// cloud.remove(&[1])?;
    /// let visible = cloud.visible_from([0.0, 0.0, 5.0], &Options::default())?;
    /// assert_eq!(visible.indices(), [0]);
    /// # Ok::<(), hidden_point_removal::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NonFinite`], [`Error::TooManyPoints`] (removed points count),
    /// [`Error::OutOfMemory`]; the cloud is unchanged then.
    pub fn append<P: Position>(&mut self, positions: &[P]) -> Result<(), Error> {
        self.add(P::given(positions))
    }

    pub(crate) fn add(&mut self, positions: Given) -> Result<(), Error> {
        let len = checked_len(self.len.saturating_add(positions.len()))?;
        let (mut bounds, skipped) = bounds_of(positions, self.non_finite)?;
        let finite = positions.len() - skipped;
        if finite > 0 {
            bounds.union(&self.bounds);
            self.replace(self.sequence_with(positions, finite, &bounds)?, bounds)?;
        }
        self.len = len;
        self.skipped += skipped;
        Ok(())
    }

    /// The cloud with one more, finite point, which takes the next index.
    pub(crate) fn with_point(&self, place: [f64; 3]) -> Result<Self, Error> {
        let len = checked_len(self.len + 1)?;
        let mut bounds = self.bounds;
        bounds.include(place);
        let sequence = self.sequence_with(Given::Double(&[place]), 1, &bounds)?;
        let cloud = self.with_sequence(sequence, bounds)?;
        Ok(Self { len, ..cloud })
    }

    /// The present points and those of `positions` that are finite. All are in the box `bounds`.
    fn sequence_with(
        &self,
        positions: Given,
        finite: usize,
        bounds: &Bounds,
    ) -> Result<Sequence, OutOfMemory> {
        let curve = HilbertCurve::new(bounds);
        let new = Sequence::sorted(positions, self.len as u32, finite, &curve)?;
        if self.sequence.points.len() == 0 {
            Ok(new)
        } else if curve == HilbertCurve::new(&self.bounds) {
            self.sequence.merged(&new, &curve)
        } else {
            self.sequence.resorted(&curve)?.merged(&new, &curve)
        }
    }

    /// The choice about points that are not finite.
    pub(crate) fn non_finite(&self) -> NonFinite {
        self.non_finite
    }

    /// Removes the points with these indices: they are never visible again and
    /// hide nothing, and their indices are never given again. An index that was
    /// removed before, or skipped, is ignored. Other points at the same place stay.
    ///
    /// Takes one pass over the cloud. If its box shrinks below a power of two, the cloud is sorted
    /// again; see [`PointCloud::append`].
    ///
    /// # Errors
    /// [`Error::IndexOutOfRange`], [`Error::OutOfMemory`]; the cloud is unchanged then.
    pub fn remove(&mut self, indices: &[u32]) -> Result<(), Error> {
        let len = self.len;
        if let Some(&index) = indices.iter().find(|&&index| index as usize >= len) {
            return Err(Error::IndexOutOfRange { index, len });
        }
        let mut removed: Vec<bool> = filled(len, false)?;
        for &index in indices {
            removed[index as usize] = true;
        }
        let rest = self.sequence.without(&|index| removed[index as usize])?;
        if rest.points.len() == self.sequence.points.len() {
            // The positions are the same: only duplicates were removed.
            self.sequence = rest;
            self.kept = Kept::default();
            return Ok(());
        }
        let (bounds, _) = bounds_of(rest.points.as_given(), NonFinite::Error)?;
        let curve = HilbertCurve::new(&bounds);
        if curve == HilbertCurve::new(&self.bounds) {
            self.replace(rest, bounds)?;
        } else {
            self.replace(rest.resorted(&curve)?, bounds)?;
        }
        Ok(())
    }

    /// How many points were ever given. Skipped and removed points count, too. The largest
    /// index is one less.
    #[must_use]
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether no points were given.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// How many points were left out because they are not finite.
    #[must_use]
    pub fn skipped(&self) -> usize {
        self.skipped
    }

    /// The position of each index, in double precision; none for a point that was removed or skipped.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn positions(&self) -> Result<Vec<Option<[f64; 3]>>, Error> {
        let mut positions = filled(self.len, None)?;
        for (place, point) in self.sequence.points.iter().enumerate() {
            for &index in self.sequence.indices_of(place) {
                positions[index as usize] = Some(point);
            }
        }
        Ok(positions)
    }

    /// Whether the positions are kept in single precision.
    #[must_use]
    pub fn is_single(&self) -> bool {
        matches!(self.sequence.points, Points::Single(_))
    }

    /// The mean distance of a point from its 6 nearest other points, in the cloud's units. The
    /// automatic scales of [`Inversion::Exponential`] and [`Inversion::Looks`] are shares of it. It is
    /// measured at up to 2048 distinct points, and is 0 where there are fewer than two. With `std` it
    /// is measured once, when it is asked for or when an automatic radius needs it.
    ///
    /// [`Inversion::Exponential`]: crate::Inversion::Exponential
    /// [`Inversion::Looks`]: crate::Inversion::Looks
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn spacing(&self) -> Result<f64, Error> {
        Ok(self.statistics()?.spacing)
    }

    pub(crate) fn statistics(&self) -> Result<Statistics, OutOfMemory> {
        let measure =
            || Statistics::measure(&self.sequence.points, &self.bounds, &*self.sampled()?);
        self.kept.statistics.get(measure)
    }

    /// The points that are measured.
    fn sampled(&self) -> Result<Arc<Sampled>, OutOfMemory> {
        let choose = || Ok(Arc::new(sample_of(&self.sequence.points, &self.bounds)?));
        self.kept.sample.get(choose)
    }

    /// What a sample tells of the cloud's noise.
    pub(crate) fn known_noise(&self) -> Result<Arc<Noise>, OutOfMemory> {
        let measure = || {
            Ok(Arc::new(Noise::of(
                &self.sequence.points,
                &self.sampled()?.places,
            )?))
        };
        self.kept.noise.get(measure)
    }

    /// A cloud with the same indices at other, finite `positions`, one for each distinct point.
    pub(crate) fn moved(&self, positions: &[[f64; 3]]) -> Result<Self, OutOfMemory> {
        let mut bounds = Bounds::EMPTY;
        positions.iter().for_each(|&p| bounds.include(p));
        let sequence = self
            .sequence
            .moved(positions, &HilbertCurve::new(&bounds))?;
        self.with_sequence(sequence, bounds)
    }

    /// The cloud of the distinct points at these places of the order. The places ascend. Indices
    /// stay.
    pub(crate) fn of_places(&self, places: &[u32]) -> Result<Self, OutOfMemory> {
        self.of_sequence(self.sequence.selected(places)?)
    }

    /// The cloud of a part of the sequence. Indices stay.
    #[inline(never)]
    pub(crate) fn of_sequence(&self, sequence: Sequence) -> Result<Self, OutOfMemory> {
        let mut bounds = Bounds::EMPTY;
        sequence.points.iter().for_each(|p| bounds.include(p));
        let curve = HilbertCurve::new(&bounds);
        let sequence = if curve == HilbertCurve::new(&self.bounds) {
            sequence
        } else {
            sequence.resorted(&curve)?
        };
        self.with_sequence(sequence, bounds)
    }

    /// A cloud with the same indices whose points are those of `sequence`, in the box `bounds`.
    #[inline(never)]
    fn with_sequence(&self, sequence: Sequence, bounds: Bounds) -> Result<Self, OutOfMemory> {
        let blocks = Blocks::around(&sequence.points)?;
        Ok(Self {
            sequence,
            bounds,
            blocks,
            kept: Kept::default(),
            ..*self
        })
    }

    /// Replaces the present points by those of `sequence`, in the box `bounds`. Nothing changes
    /// where memory for their blocks is refused.
    fn replace(&mut self, sequence: Sequence, bounds: Bounds) -> Result<(), OutOfMemory> {
        self.blocks = Blocks::around(&sequence.points)?;
        self.sequence = sequence;
        self.bounds = bounds;
        self.kept = Kept::default();
        Ok(())
    }
}

impl fmt::Debug for PointCloud {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("PointCloud")
            .field("len", &self.len)
            .field("skipped", &self.skipped)
            .finish_non_exhaustive()
    }
}

/// Checks every coordinate; returns the box of the finite points and how many are not.
fn bounds_of(positions: Given, non_finite: NonFinite) -> Result<(Bounds, usize), Error> {
    let mut bounds = Bounds::EMPTY;
    let mut bad = 0;
    let mut first = 0;
    for (index, p) in positions.iter().enumerate() {
        if is_finite(p) {
            bounds.include(p);
        } else {
            if bad == 0 {
                first = index;
            }
            bad += 1;
        }
    }
    if bad > 0 && non_finite == NonFinite::Error {
        return Err(Error::NonFinite { count: bad, first });
    }
    Ok((bounds, bad))
}
