//! From a cloud and a viewpoint to visible indices.

use alloc::vec::Vec;

use crate::answers::looks::{Projection, Question, even_scales, scores_of_indices};
use crate::answers::memory::ViewMemory;
use crate::base::allocation::{OutOfMemory, copied, filled, with_capacity};
use crate::base::bits::{bits_of, places};
use crate::base::error::Error;
use crate::cloud::point_cloud::PointCloud;
use crate::hull;
use crate::view::options::{Exponential, Inversion, Options, Radius};
use crate::view::radius::ChosenRadius;
use crate::view::refusals::QuestionKind;
use crate::view::resolved::looks;

/// Which points of a cloud are visible from one viewpoint, or from several.
#[derive(Clone, Debug, PartialEq)]
pub struct Visibility {
    indices: Vec<u32>,
    cloud_len: usize,
    chosen: ChosenRadius,
    inversion: Inversion,
    looks: Vec<f64>,
    scores: Vec<f32>,
    exact: bool,
}

impl Visibility {
    /// `indices` ascend.
    pub(crate) fn new(
        indices: Vec<u32>,
        cloud_len: usize,
        chosen: ChosenRadius,
        inversion: Inversion,
    ) -> Self {
        Self {
            indices,
            cloud_len,
            chosen,
            inversion,
            looks: Vec::new(),
            scores: Vec::new(),
            exact: true,
        }
    }

    /// This answer, if `exact` is false as one that is not exact.
    #[cfg(feature = "higher")]
    pub(crate) fn if_exact(self, exact: bool) -> Self {
        let exact = self.exact && exact;
        Self { exact, ..self }
    }

    /// This answer with the larger radius and scale of two views, and with the number of hulls of
    /// both choices.
    pub(crate) fn joined(mut self, other: Self) -> Self {
        self.chosen = self.chosen.joined(other.chosen);
        if other.scale() > self.scale() {
            self.inversion = other.inversion;
            self.looks = other.looks;
        }
        self
    }

    /// This answer for other visible points.
    pub(crate) fn with_indices(self, indices: Vec<u32>) -> Self {
        Self { indices, ..self }
    }

    /// The largest scale c of its hulls; 0 where there is none.
    pub(crate) fn scale(&self) -> f64 {
        match self.inversion {
            Inversion::Exponential(Exponential::Scale(scale)) => scale,
            _ => self.looks.first().copied().unwrap_or(0.0),
        }
    }

    /// The visible points' indices in the cloud, ascending.
    #[must_use]
    pub fn indices(&self) -> &[u32] {
        &self.indices
    }

    /// The visible points' indices, ascending, as an owned list.
    #[must_use]
    pub fn into_indices(self) -> Vec<u32> {
        self.indices
    }

    /// How many points are visible.
    #[must_use]
    pub fn count(&self) -> usize {
        self.indices.len()
    }

    /// The radius R of the flipping sphere, in the cloud's units. It is 0 where all points are
    /// at the viewpoint. With [`Inversion::Power`] it is the unit S. With
    /// [`Inversion::Exponential`] and [`Inversion::Looks`] it is 0.
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.chosen.radius
    }

    /// log₁₀(R ÷ farthest distance), the paper's parameter; 0 where there is no R.
    #[must_use]
    pub fn exponent(&self) -> f64 {
        self.chosen.exponent
    }

    /// How many hulls the choice of R took. The final hull is not counted.
    #[must_use]
    pub fn evaluations(&self) -> u32 {
        self.chosen.evaluations
    }

    /// The inversion that was used, with numbers only. A part of the cloud that is asked with it
    /// (and with the radius, if it is spherical) is flipped in the same way.
    #[must_use]
    pub fn inversion(&self) -> Inversion {
        self.inversion
    }

    /// The scale c of each look, from tight to loose, in the cloud's units. The list is empty
    /// unless the options ask for [`Inversion::Looks`].
    #[must_use]
    pub fn looks(&self) -> &[f64] {
        &self.looks
    }

    /// A score for each index of the cloud: how likely the point is visible, from 0 to 1. It is
    /// 0 for skipped or removed points. The list is empty unless [`Options::scores`] is set. A
    /// visible point may have a score below ½, and a hidden point one above ½.
    #[must_use]
    pub fn scores(&self) -> &[f32] {
        &self.scores
    }

    /// Whether this is the exact answer to the question. It is false only for some clouds of a
    /// [`PointCloudNd`](crate::PointCloudNd).
    #[must_use]
    pub fn exact(&self) -> bool {
        self.exact
    }

    /// One byte for each index of the cloud: 1 visible, 0 hidden.
    #[must_use]
    pub fn mask(&self) -> Vec<u8> {
        let mut mask = alloc::vec![0; self.cloud_len];
        for &index in &self.indices {
            mask[index as usize] = 1;
        }
        mask
    }
}

impl PointCloud {
    /// Which points are visible from `viewpoint`, given in the cloud's own coordinates? This is
    /// the HPR operator, Algorithm 1 of the paper. The answer is exact for the flipped points
    /// as rounded to `f64`.
    ///
    /// A point at the viewpoint is visible and hides nothing. If several points are on one ray,
    /// only the nearest can be visible. Equal points share one answer.
    ///
    /// With [`Inversion::Looks`] the answer comes from several hulls. Each hull decides only the
    /// points that it is sure of. A tight hull hides the points behind a surface. A loose hull
    /// shows points that a tight hull cannot decide. Equal points still share one answer, and a
    /// point at the viewpoint is visible. But several points on one ray can be visible, if they
    /// are within one spacing of each other. `docs/LOOKS.md` gives the rule, and the clouds that
    /// it is for.
    ///
    /// ```
    /// use hidden_point_removal::{Options, PointCloud};
    ///
    /// // Two points on one ray: the nearer hides the farther.
    /// let cloud = PointCloud::new(&[[0.0, 0.0, 1.0], [0.0, 0.0, 2.0]])?;
    /// let visible = cloud.visible_from([0.0, 0.0, 5.0], &Options::default())?;
    /// assert_eq!(visible.indices(), [1]);
    /// # Ok::<(), hidden_point_removal::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Viewpoint`] for a viewpoint that is not finite; the `Radius…`
    /// errors for a choice of R that does not fit the view, or its
    /// inversion; [`Error::Parameter`]; [`Error::OutOfRange`] for a number of looks that is not 2 or 3;
    /// [`Error::Excludes`] for options that exclude each other;
    /// [`Error::OutOfMemory`].
    pub fn visible_from(
        &self,
        viewpoint: [f64; 3],
        options: &Options,
    ) -> Result<Visibility, Error> {
        self.visible_from_with(&mut ViewMemory::new(), viewpoint, options)
    }

    /// [`PointCloud::visible_from`] with the memory of earlier views.
    pub(crate) fn visible_from_with(
        &self,
        memory: &mut ViewMemory,
        viewpoint: [f64; 3],
        options: &Options,
    ) -> Result<Visibility, Error> {
        options.check(QuestionKind::View)?;
        let part = self.part(Some(viewpoint), options)?;
        memory.see(options.region(Some(viewpoint))?);
        part.seen_by(memory, viewpoint, options)
    }

    /// The view of all points of this cloud.
    #[inline(never)]
    pub(crate) fn seen_by(
        &self,
        memory: &mut ViewMemory,
        viewpoint: [f64; 3],
        options: &Options,
    ) -> Result<Visibility, Error> {
        if let Some(count) = looks(options)? {
            return self.seen_by_looks(memory, Projection::Perspective(viewpoint), count, options);
        }
        self.seen_by_hull(&mut memory.hull, viewpoint, options)
    }

    /// The view of one hull, without options that choose points. `memory` holds the last one.
    pub(crate) fn seen_by_hull(
        &self,
        memory: &mut hull::Memory,
        viewpoint: [f64; 3],
        options: &Options,
    ) -> Result<Visibility, Error> {
        let view = self.view(viewpoint, options)?;
        let shared = self.marked_by(options.threads, viewpoint, &view)?;
        let visible = match &shared {
            Some(shared) => shared,
            None => {
                let points = &self.sequence.points;
                let blocks = &self.blocks.levels[0];
                hull::mark_visible(points, blocks, &view.flip, memory)?;
                memory.visible()
            }
        };
        self.answer(visible, view.chosen, view.inversion)
    }

    /// Does a part of the work of a view: about `budget` points, kept in `memory`. Returns whether
    /// [`PointCloud::visible_from_with`] would have little more left than the answer.
    pub(crate) fn go_on_with(
        &self,
        memory: &mut ViewMemory,
        viewpoint: [f64; 3],
        options: &Options,
        budget: usize,
    ) -> Result<bool, Error> {
        options.check(QuestionKind::View)?;
        let region = options.region(Some(viewpoint))?;
        // To choose the points again for each slice would take too long.
        if region.is_some() {
            return Ok(true);
        }
        memory.see(region);
        if let Some(count) = looks(options)? {
            let question = question(Projection::Perspective(viewpoint), count, options);
            return memory.go_on_looking(self, question, budget);
        }
        let view = self.view(viewpoint, options)?;
        let points = &self.sequence.points;
        let blocks = &self.blocks.levels[0];
        Ok(hull::go_on(
            points,
            blocks,
            &view.flip,
            &mut memory.hull,
            budget,
        )?)
    }

    /// The answer from `count` looks.
    pub(crate) fn seen_by_looks(
        &self,
        memory: &mut ViewMemory,
        projection: Projection,
        count: usize,
        options: &Options,
    ) -> Result<Visibility, Error> {
        let seen = memory.look(self, question(projection, count, options))?;
        let scores = if options.scores {
            scores_of_indices(self, &seen.scores)?
        } else {
            Vec::new()
        };
        let chosen = ChosenRadius::unit(0.0);
        let answer = self.answer(&seen.visible, chosen, options.inversion)?;
        let looks = copied(&seen.scales[..count])?;
        Ok(Visibility {
            scores,
            looks,
            ..answer
        })
    }

    /// The answer for marked distinct points.
    #[inline(never)]
    pub(crate) fn answer(
        &self,
        visible: &[bool],
        chosen: ChosenRadius,
        inversion: Inversion,
    ) -> Result<Visibility, Error> {
        let indices = marked_indices(self.len(), visible, self.sequence.single_indices(), &|k| {
            self.sequence.indices_of(k)
        })?;
        let mut answer = Visibility::new(indices, self.len(), chosen, inversion);
        if let Inversion::Looks(count) = inversion {
            let scales = even_scales(count, &self.statistics()?, &*self.known_noise()?);
            answer.looks = copied(&scales[..count])?;
        }
        Ok(answer)
    }

    /// The radius that `rule` chooses for `viewpoint` in spherical flipping. Visible points are
    /// not computed.
    ///
    /// # Errors
    /// As [`PointCloud::visible_from`].
    pub fn auto_radius(&self, viewpoint: [f64; 3], rule: Radius) -> Result<ChosenRadius, Error> {
        let options = Options {
            radius: rule,
            ..Options::default()
        };
        Ok(self.view(viewpoint, &options)?.chosen)
    }
}

fn question(projection: Projection, count: usize, options: &Options) -> Question {
    Question {
        projection,
        count,
        with_scores: options.scores,
        surface: options.surface,
        thickness: options.thickness,
    }
}

/// The caller's indices of the distinct points marked as `visible`, ascending and below `len`.
/// `indices_of` lists the indices of one distinct point. `single` holds the index of each point
/// if all have only one; otherwise it is empty.
pub(crate) fn marked_indices<'a>(
    len: usize,
    visible: &[bool],
    single: &[u32],
    indices_of: &dyn Fn(usize) -> &'a [u32],
) -> Result<Vec<u32>, OutOfMemory> {
    // A bit for each index.
    let mut marked: Vec<u64> = filled(len.div_ceil(BITS), 0)?;
    let mut count = 0;
    for (run, start) in visible.chunks(BITS).zip((0..).step_by(BITS)) {
        // In most runs of a divided view nothing is visible. This loop has no branch.
        if !run.iter().fold(false, |any, &visible| any | visible) {
            continue;
        }
        let mut mark = |index: u32| {
            marked[index as usize / BITS] |= 1 << (index as usize % BITS);
            count += 1;
        };
        for place in places(bits_of(run)) {
            let k = start + place as usize;
            match single.get(k) {
                Some(&index) => mark(index),
                None => indices_of(k).iter().copied().for_each(&mut mark),
            }
        }
    }
    let mut indices = with_capacity(count)?;
    for (start, bits) in (0..).step_by(BITS).zip(marked) {
        indices.extend(places(bits).map(|place| start + place));
    }
    Ok(indices)
}

/// The bits of a number.
const BITS: usize = u64::BITS as usize;
