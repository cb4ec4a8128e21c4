//! Many viewpoints of one cloud: which few of them see most.

use alloc::vec::Vec;

use crate::base::allocation::{copied, reserve, with_capacity};
use crate::base::error::{Error, in_range};
use crate::cloud::point_cloud::PointCloud;
use crate::view::camera::Seat;
use crate::view::options::Options;
use crate::view::refusals::QuestionKind;

/// What is wanted of chosen viewpoints.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Placing<'a> {
    /// The largest number of viewpoints to choose, at least 1; any number by default.
    pub count: Option<usize>,
    /// The choice ends when so much of the weight is seen that some candidate sees: above 0, at
    /// most 1; 1 by default.
    pub share: Option<f64>,
    /// How much each index counts: numbers of at least 0 with a finite sum. 1 each by default.
    pub weights: Option<&'a [f64]>,
}

/// Chosen viewpoints.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Placement {
    /// The numbers of the chosen candidates, in the order of their choice.
    pub chosen: Vec<usize>,
    /// The weight that each of them adds to those before it.
    pub gains: Vec<f64>,
    /// The indices that at least one of them sees, ascending.
    pub seen: Vec<u32>,
    /// The indices that no candidate sees, ascending; also those of removed and skipped points.
    pub unseen: Vec<u32>,
}

impl PointCloud {
    /// Chooses viewpoints, or cameras, among candidates, greedily: always the one that adds most weight, ties to
    /// the lowest number. The choice ends when nothing more is gained. For a number of viewpoints,
    /// it sees at least 1 − 1/e of what the best choice of that number sees.
    ///
    /// The view of each candidate is computed once, and again when it may be the next one. A
    /// candidate whose gain was already lower than that of another is not asked again, because
    /// gains only fall. So the memory does not grow with the number of candidates.
    ///
    /// ```
    /// use hidden_point_removal::{Options, Placing, PointCloud};
    ///
    /// let cloud = PointCloud::new(&[[0.0, 0.0, 1.0], [0.0, 0.0, 2.0], [1.0, 0.0, 0.0]])?;
    /// let candidates = [[0.0, 0.0, 5.0], [0.0, 0.0, 6.0], [0.0, 0.0, -5.0]];
    /// let placing = Placing::default();
    /// let placed = cloud.place_viewpoints(&candidates, &Options::default(), &placing)?;
    /// assert_eq!((placed.chosen, placed.gains), (vec![0, 2], vec![2.0, 1.0]));
    /// assert_eq!((placed.seen, placed.unseen), (vec![0, 1, 2], vec![]));
    /// # Ok::<(), hidden_point_removal::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for the numbers of `placing`; otherwise as [`PointCloud::coverage`].
    pub fn place_viewpoints<S: Copy + Into<Seat> + Sync>(
        &self,
        candidates: &[S],
        options: &Options,
        placing: &Placing,
    ) -> Result<Placement, Error> {
        let mut choice = Choice::new(placing)?;
        choice.look(self, candidates, options)?;
        choice.choose(self, candidates, options)
    }

    /// The indices that these candidates see, each with its number.
    fn views_of<S: Copy + Into<Seat> + Sync>(
        &self,
        asked: &[usize],
        candidates: &[S],
        options: &Options,
    ) -> Result<Vec<(usize, Vec<u32>)>, Error> {
        let mut seats: Vec<S> = with_capacity(asked.len())?;
        seats.extend(asked.iter().map(|&number| candidates[number]));
        let mut views = with_capacity(asked.len())?;
        self.each_view(&seats, options, &mut |at, seen| {
            views.push((asked[at], seen.into_indices()));
        })?;
        Ok(views)
    }
}

/// A choice among candidates whose first views are computed group by group. So its caller can say how far it is, or
/// end it. [`PointCloud::place_viewpoints`] does the same at once.
///
/// ```
/// use hidden_point_removal::{Choice, Options, Placing, PointCloud};
///
/// let cloud = PointCloud::new(&[[0.0, 0.0, 1.0], [0.0, 0.0, 2.0], [1.0, 0.0, 0.0]])?;
/// let options = Options::default();
/// let candidates = [[0.0, 0.0, 5.0], [0.0, 0.0, 6.0], [0.0, 0.0, -5.0]];
/// let mut choice = Choice::new(&Placing::default())?;
/// for group in candidates.chunks(2) {
///     choice.look(&cloud, group, &options)?;
/// }
/// assert_eq!(choice.choose(&cloud, &candidates, &options)?.chosen, [0, 2]);
/// # Ok::<(), hidden_point_removal::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Choice {
    /// The largest number of viewpoints.
    count: usize,
    share: f64,
    weights: Option<Vec<f64>>,
    /// The last known gain of each candidate.
    gains: Vec<f64>,
    /// How many were chosen when the gain was measured.
    measured: Vec<usize>,
    seen: Vec<bool>,
    seen_by_any: Vec<bool>,
    /// The weight that some candidate sees, known when the choice begins.
    reachable: Option<f64>,
    placement: Placement,
}

impl Choice {
    /// A choice without candidates.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for the numbers of `placing`; [`Error::OutOfMemory`].
    pub fn new(placing: &Placing) -> Result<Self, Error> {
        in_range(
            "count",
            placing.count.map_or(1.0, |n| n as f64),
            1.0,
            f64::MAX,
        )?;
        in_range(
            "share",
            placing.share.unwrap_or(1.0),
            f64::MIN_POSITIVE,
            1.0,
        )?;
        let weights = placing.weights.unwrap_or_default();
        for &weight in weights {
            in_range("weights", weight, 0.0, f64::MAX)?;
        }
        in_range("the sum of weights", weights.iter().sum(), 0.0, f64::MAX)?;
        Ok(Self {
            count: placing.count.unwrap_or(usize::MAX),
            share: placing.share.unwrap_or(1.0),
            weights: placing.weights.map(copied).transpose()?,
            gains: Vec::new(),
            measured: Vec::new(),
            seen: Vec::new(),
            seen_by_any: Vec::new(),
            reachable: None,
            placement: Placement::default(),
        })
    }

    /// Looks from the next candidates. Points may be appended between.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for the number of weights; otherwise as [`PointCloud::coverage`].
    pub fn look<S: Copy + Into<Seat> + Sync>(
        &mut self,
        cloud: &PointCloud,
        group: &[S],
        options: &Options,
    ) -> Result<(), Error> {
        let first = self.gains.len();
        self.reserve(cloud.len(), first + group.len())?;
        options.check(QuestionKind::PlaceViewpoints)?;
        cloud.each_view(group, options, &mut |number, seen| {
            self.take(first + number, seen.indices());
        })
    }

    /// Chooses among all candidates: those of each `look`, in this order.
    ///
    /// # Errors
    /// As [`Choice::look`].
    pub fn choose<S: Copy + Into<Seat> + Sync>(
        mut self,
        cloud: &PointCloud,
        candidates: &[S],
        options: &Options,
    ) -> Result<Placement, Error> {
        let known = self.gains.len() as f64;
        in_range(
            "the number of candidates",
            candidates.len() as f64,
            known,
            known,
        )?;
        self.look::<S>(cloud, &[], options)?;
        // The indices that some candidates see.
        let mut views: Vec<(usize, Vec<u32>)> = Vec::new();
        loop {
            let view_of = |wanted| {
                let own = views.iter().find(|(number, _)| *number == wanted);
                own.map(|(_, view)| view.as_slice())
            };
            if self.go_on(&view_of).is_none() {
                return self.placed();
            }
            let asked = highest_of(&self.gains, options.threads.max(1))?;
            views = cloud.views_of(&asked, candidates, options)?;
        }
    }

    /// Room for a cloud of so many indices, and so many candidates.
    pub(crate) fn reserve(&mut self, len: usize, candidates: usize) -> Result<(), Error> {
        if let Some(weights) = &self.weights {
            in_range(
                "the number of weights",
                weights.len() as f64,
                len as f64,
                len as f64,
            )?;
        }
        lengthen(&mut self.gains, candidates, 0.0)?;
        lengthen(&mut self.measured, candidates, 0)?;
        lengthen(&mut self.seen, len, false)?;
        lengthen(&mut self.seen_by_any, len, false)
    }

    /// Takes the first view of a candidate: the indices that it sees.
    pub(crate) fn take(&mut self, candidate: usize, view: &[u32]) {
        self.gains[candidate] = self.gain(view);
        for &index in view {
            self.seen_by_any[index as usize] = true;
        }
    }

    /// Chooses as far as the known views allow. Returns the candidate whose view is needed to go on: none at the end.
    pub(crate) fn go_on<'v>(
        &mut self,
        view_of: &dyn Fn(usize) -> Option<&'v [u32]>,
    ) -> Option<usize> {
        let reachable = match self.reachable {
            Some(reachable) => reachable,
            None => *self.reachable.insert(self.total(&self.seen_by_any)),
        };
        while self.placement.chosen.len() < self.count {
            // With a share of 1, the choice ends when nothing is gained: sums in another order may
            // differ.
            if self.share < 1.0 && self.total(&self.seen) >= self.share * reachable {
                return None;
            }
            let best = highest(&self.gains)?;
            let Some(view) = view_of(best) else {
                return Some(best);
            };
            // Sums run over ascending indices, so rounding keeps their order, too.
            if self.measured[best] < self.placement.chosen.len() {
                self.gains[best] = self.gain(view);
                self.measured[best] = self.placement.chosen.len();
                if highest(&self.gains) != Some(best) {
                    continue;
                }
            }
            for &index in view {
                self.seen[index as usize] = true;
                // Points may have been appended since the first view.
                self.seen_by_any[index as usize] = true;
            }
            self.placement.chosen.push(best);
            self.placement.gains.push(self.gains[best]);
            self.gains[best] = 0.0;
        }
        None
    }

    /// What was chosen.
    pub(crate) fn placed(&mut self) -> Result<Placement, Error> {
        let mut placement = core::mem::take(&mut self.placement);
        placement.seen = marked(&self.seen, true)?;
        placement.unseen = marked(&self.seen_by_any, false)?;
        Ok(placement)
    }

    fn weight(&self, index: u32) -> f64 {
        let weights = self.weights.as_ref();
        weights.map_or(1.0, |weights| weights[index as usize])
    }

    /// The weight that a view adds.
    fn gain(&self, view: &[u32]) -> f64 {
        let new = view.iter().filter(|&&index| !self.seen[index as usize]);
        new.fold(0.0, |sum, &index| sum + self.weight(index))
    }

    fn total(&self, marks: &[bool]) -> f64 {
        let marked = (0u32..).zip(marks).filter(|(_, mark)| **mark);
        marked.fold(0.0, |sum, (index, _)| sum + self.weight(index))
    }
}

fn lengthen<T: Copy>(list: &mut Vec<T>, len: usize, value: T) -> Result<(), Error> {
    reserve(list, len.saturating_sub(list.len()))?;
    list.resize(len, value);
    Ok(())
}

/// The numbers of the `count` highest gains, as far as they are above 0.
fn highest_of(gains: &[f64], count: usize) -> Result<Vec<usize>, Error> {
    let mut others = copied(gains)?;
    let mut numbers: Vec<usize> = with_capacity(count.min(gains.len()))?;
    while let Some(next) = highest(&others).filter(|_| numbers.len() < count) {
        numbers.push(next);
        others[next] = 0.0;
    }
    Ok(numbers)
}

/// The lowest number of the highest gain, if that is above 0.
fn highest(gains: &[f64]) -> Option<usize> {
    let higher = |best: usize, number: usize| {
        if gains[number] > gains[best] {
            number
        } else {
            best
        }
    };
    (0..gains.len())
        .reduce(higher)
        .filter(|&best| gains[best] > 0.0)
}

/// The indices with this mark, ascending.
fn marked(marks: &[bool], wanted: bool) -> Result<Vec<u32>, Error> {
    let is_wanted = |mark: &&bool| **mark == wanted;
    let mut indices: Vec<u32> = with_capacity(marks.iter().filter(is_wanted).count())?;
    let all = (0..).zip(marks);
    indices.extend(
        all.filter(|(_, mark)| is_wanted(mark))
            .map(|(index, _)| index),
    );
    Ok(indices)
}
