//! A view divided among several threads or workers. Each thread answers for its own points.
//! It does not need the others.

use alloc::vec::Vec;
use glam::DVec3;

use crate::answers::memory::ViewMemory;
use crate::answers::visibility::Visibility;
use crate::base::allocation::{OutOfMemory, filled, with_capacity};
use crate::base::error::Error;
use crate::base::real::square_root;
use crate::base::threads::{HAS_THREADS, deal};
use crate::cloud::point_cloud::PointCloud;
use crate::flip::inversion::Flip;
use crate::flip::kernel::Kernel;
use crate::hull::division::{Division, Sector};
use crate::hull::{self, Memory};
use crate::view::options::{Inversion, Options};
use crate::view::radius::ChosenRadius;
use crate::view::refusals::QuestionKind;
use crate::view::resolved::{View, looks};

impl PointCloud {
    /// The part of [`PointCloud::visible_from`] that belongs to one sector of the view. Every
    /// visible point is in the answer of exactly one sector, so all sectors together are exactly
    /// the whole answer.
    ///
    /// Give one sector to each of several threads, or of several processes with the same points.
    /// Sectors take about equal time. Each takes a little more than its share of the whole. Clouds
    /// below 200,000 points gain little.
    ///
    /// ```
    /// use hidden_point_removal::{Error, Options, PointCloud, Sector};
    ///
    /// let cloud = PointCloud::new(&[[0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [1.0, 0.0, 0.0]])?;
    /// let (viewpoint, options) = ([0.0, 0.0, 5.0], Options::default());
    /// let mut indices = std::thread::scope(|scope| {
    ///     let ask = |sector| cloud.visible_in_sector(viewpoint, &options, sector);
    ///     let sectors = (0..2).filter_map(|number| Sector::new(number, 2));
    ///     let threads: Vec<_> = sectors.map(|sector| scope.spawn(move || ask(sector))).collect();
    ///     threads
    ///         .into_iter()
    ///         .map(|thread| Ok::<_, Error>(thread.join().unwrap()?.into_indices()))
    ///         .collect::<Result<Vec<_>, _>>()
    /// })?
    /// .concat();
    /// indices.sort_unstable();
    /// assert_eq!(indices, [0, 2]);
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`PointCloud::visible_from`].
    pub fn visible_in_sector(
        &self,
        viewpoint: [f64; 3],
        options: &Options,
        sector: Sector,
    ) -> Result<Visibility, Error> {
        self.visible_in_sector_with(&mut ViewMemory::new(), viewpoint, options, sector)
    }

    /// [`PointCloud::visible_in_sector`] with the memory of earlier views.
    pub(crate) fn visible_in_sector_with(
        &self,
        memory: &mut ViewMemory,
        viewpoint: [f64; 3],
        options: &Options,
        sector: Sector,
    ) -> Result<Visibility, Error> {
        if sector.count == 1 {
            return self.visible_from_with(memory, viewpoint, options);
        }
        options.check(QuestionKind::View)?;
        let part = self.part(Some(viewpoint), options)?;
        memory.see(options.steps(Some(viewpoint))?);
        part.sector(memory, viewpoint, options, sector)
    }

    /// The sector of a view of all points of this cloud.
    fn sector(
        &self,
        memory: &mut ViewMemory,
        viewpoint: [f64; 3],
        options: &Options,
        sector: Sector,
    ) -> Result<Visibility, Error> {
        // With a vote, the answer of a point needs the answers of its neighbors. A draft takes
        // little time. In these cases the first sector answers for all.
        if !options.asks_for_looks() && !options.draft && options.vote.is_none() {
            let view = self.view(viewpoint, options)?;
            if is_divisible(&view) {
                let radius = view.chosen.radius;
                let sample = self.seen_sample(viewpoint, radius)?;
                let division = self.division(viewpoint, radius, &sample, sector)?;
                let points = &self.sequence.points;
                let blocks = &self.blocks.levels[0];
                let hull = &mut memory.hull;
                hull::mark_sector(points, blocks, &view.flip, division, hull)?;
                return self.answer(hull.visible(), options, view.chosen, view.inversion);
            }
        }
        if sector.number == 0 {
            self.seen_by(1, memory, viewpoint, options)
        } else {
            self.nothing_from(viewpoint, options)
        }
    }

    /// The answer in which nothing is visible.
    fn nothing_from(&self, viewpoint: [f64; 3], options: &Options) -> Result<Visibility, Error> {
        self.check_options(options)?;
        if looks(options)?.is_some() {
            return self.answer(&[], options, ChosenRadius::unit(0.0), options.inversion);
        }
        let view = self.view(viewpoint, options)?;
        self.answer(&[], options, view.chosen, view.inversion)
    }

    /// The visible points of a view that `threads` threads share, one sector each. `None` if the
    /// view is not divided.
    pub(crate) fn marked_by(
        &self,
        threads: usize,
        viewpoint: [f64; 3],
        view: &View,
        options: &Options,
    ) -> Result<Option<Vec<bool>>, OutOfMemory> {
        let points = &self.sequence.points;
        let blocks = &self.blocks.levels[0];
        let count = threads.min(blocks.len() / FEWEST_BLOCKS);
        if !HAS_THREADS || count < 2 || options.draft || !is_divisible(view) {
            return Ok(None);
        }
        let radius = view.chosen.radius;
        let sample = self.seen_sample(viewpoint, radius)?;
        let mut visible = filled(points.len(), false)?;
        let mark = |memory: &mut Memory, number: usize| -> Result<Vec<bool>, OutOfMemory> {
            let [number, count] = [number, count].map(|number| number as u32);
            let division = self.division(viewpoint, radius, &sample, Sector { number, count })?;
            hull::mark_sector(points, blocks, &view.flip, division, memory)?;
            Ok(memory.take_visible())
        };
        deal(count, count, &Memory::new, &mark, &mut |_, own| {
            for (visible, own) in visible.iter_mut().zip(own) {
                *visible |= own;
            }
        })?;
        Ok(Some(visible))
    }

    /// Which points of a sample are visible. This decides how the work is shared.
    fn seen_sample(&self, viewpoint: [f64; 3], radius: f64) -> Result<Vec<bool>, OutOfMemory> {
        let mut sample = with_capacity(self.blocks.levels[0].len())?;
        sample.extend(Division::sample(&self.blocks));
        let points = self.sequence.points.gathered(&sample)?;
        let center = DVec3::from_array(viewpoint);
        // Sparser points need a smaller sphere, as in the automatic radius.
        let sparser = square_root(points.len() as f64 / self.sequence.points.len() as f64);
        let mut coarse = radius * sparser;
        for point in points.iter() {
            let distance = (DVec3::from_array(point) - center).length();
            if distance > coarse {
                coarse = distance;
            }
        }
        let mut memory = Memory::new();
        let flip = Flip::new(viewpoint, Kernel::Spherical { radius: coarse });
        hull::mark_visible(&points, &[], &flip, &mut memory)?;
        Ok(memory.take_visible())
    }

    fn division(
        &self,
        viewpoint: [f64; 3],
        radius: f64,
        sample: &[bool],
        sector: Sector,
    ) -> Result<Division, OutOfMemory> {
        Division::new(
            &self.sequence.points,
            &self.blocks,
            DVec3::from_array(viewpoint),
            radius,
            sample,
            sector,
        )
    }
}

/// The fewest blocks of points for each thread. To start a thread takes as long as to decide about
/// some hundred points.
const FEWEST_BLOCKS: usize = 16;

/// Whether bounds of flipped points are known and useful. They are not useful where squares
/// overflow or underflow, nor where 2R − d keeps too few digits of d.
fn is_divisible(view: &View) -> bool {
    view.inversion == Inversion::Spherical
        && (1e-29..1e29).contains(&view.chosen.radius)
        && view.chosen.exponent < 8.0
}
