//! The one place where a question gets its points. Options that choose points, or move them, lead
//! to a cloud of these points alone; no question knows of them.

use alloc::boxed::Box;
use alloc::vec::Vec;
use core::ops::Deref;

use crate::answers::memory::ViewMemory;
use crate::answers::visibility::Visibility;
use crate::base::allocation::{OutOfMemory, with_capacity};
use crate::base::error::Error;
use crate::base::threads::deal;
use crate::cloud::part::Step;
use crate::cloud::point_cloud::PointCloud;
use crate::cloud::selection::{Region, Within};
use crate::view::options::Options;
use crate::view::resolved::looks;
use crate::view::seat::Seat;

impl PointCloud {
    /// The cloud of the indices that `mask` marks, for many views. The answers are those of a
    /// cloud of these points alone, with its own spacing. Indices stay.
    ///
    /// ```
    /// use hidden_point_removal::{Options, PointCloud};
    ///
    /// let cloud = PointCloud::new(&[[0.0, 0.0, 2.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]])?;
    /// let part = cloud.masked(&[false, true, true])?;
    /// let visible = part.visible_from([0.0, 0.0, 5.0], &Options::default())?;
    /// assert_eq!(visible.indices(), [1, 2]);
    /// # Ok::<(), hidden_point_removal::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::MaskLength`] unless there is one mark for each index; [`Error::OutOfMemory`].
    pub fn masked(&self, mask: &[bool]) -> Result<Self, Error> {
        if mask.len() != self.len() {
            let (given, len) = (mask.len(), self.len());
            return Err(Error::MaskLength { given, len });
        }
        let rest = self.sequence.without(&|index| !mask[index as usize])?;
        Ok(self.of_sequence(rest)?)
    }

    /// The cloud of the points in a box, or within a distance from `viewpoint`, for many views.
    /// [`Options::within`] asks the same cloud. Indices stay.
    ///
    /// # Errors
    /// [`Error::BoundsInvalid`]; [`Error::OutOfRange`] for a distance below 0;
    /// [`Error::Viewpoint`]; [`Error::OutOfMemory`].
    pub fn within(&self, within: &Within, viewpoint: [f64; 3]) -> Result<Self, Error> {
        Ok(match within.region(Some(viewpoint))? {
            Some(region) => self.of_region(&region)?,
            None => self.clone(),
        })
    }

    /// The cloud of an even sample of `count` distinct places, for many views. [`Options::sample`]
    /// asks the same cloud. Indices stay.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] unless `count` is at least 1; [`Error::OutOfMemory`].
    pub fn sampled(&self, count: usize) -> Result<Self, Error> {
        let sampled = self.after(Step::Sample(count))?;
        Ok(sampled.unwrap_or_else(|| self.clone()))
    }

    /// Prepares the cloud for views with the same `within`, `sample`, `denoise` and `vote`. It
    /// keeps the points in the box, the sampled or the denoised points, and the neighbors that
    /// vote (up to 64 a point, 4 bytes each), until points are appended or removed. Answers are
    /// the same as without preparation. A view then need not choose points or search neighbors.
    /// This saves some microseconds a point. Nothing is kept for a distance, because each
    /// viewpoint has other points there.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] and [`Error::BoundsInvalid`] as for the view;
    /// [`Error::OutOfMemory`]. After an error the cloud answers as before.
    pub fn prepare_for(&mut self, options: &Options) -> Result<(), Error> {
        self.keep_part(None, options)
    }

    /// [`PointCloud::prepare_for`] views from `viewpoint`, if there is only one.
    pub(crate) fn keep_part(
        &mut self,
        viewpoint: Option<[f64; 3]>,
        options: &Options,
    ) -> Result<(), Error> {
        let steps = options.steps(viewpoint)?;
        if viewpoint.is_none() && options.has_distance() {
            return Ok(());
        }
        let mut cloud = self;
        for step in steps.into_iter().flatten() {
            cloud = cloud.kept_after(step)?;
        }
        cloud.keep_voters(options)
    }

    /// The points of a question with these options. Without a viewpoint, a distance does not count.
    pub(crate) fn part(
        &self,
        viewpoint: Option<[f64; 3]>,
        options: &Options,
    ) -> Result<Part<'_>, Error> {
        let mut part = Part::Kept(self);
        for step in options.steps(viewpoint)?.into_iter().flatten() {
            part = part.then(step)?;
        }
        Ok(part)
    }

    /// The same at their own places: not denoised.
    pub(crate) fn chosen(
        &self,
        viewpoint: Option<[f64; 3]>,
        options: &Options,
    ) -> Result<Part<'_>, Error> {
        let denoise = None;
        self.part(
            viewpoint,
            &Options {
                denoise,
                ..*options
            },
        )
    }

    /// Passes the view from each seat, with its number, in any order. A seat may have its own part.
    /// The threads share the seats, and a view if there are fewer seats.
    pub(crate) fn each_view<S: Copy + Into<Seat> + Sync>(
        &self,
        threads: usize,
        seats: &[S],
        options: &Options,
        pass: &mut (dyn FnMut(usize, Visibility) + Send),
    ) -> Result<(), Error> {
        for &seat in seats {
            if let Seat::Camera(camera) = seat.into() {
                camera.check()?;
            }
        }
        let count = seats.len();
        let for_each = threads / count.max(1);
        let part = if options.has_distance() && count > 0 {
            None
        } else {
            let part = self.part(None, options)?;
            if count == 0 {
                return part.check_options(options);
            }
            if looks(options)?.is_some() {
                // For all threads.
                part.survey(options.surface, options.thickness)?;
            }
            Some(part)
        };
        let view = |memory: &mut ViewMemory, number: usize| {
            let seat = seats[number];
            if let Some(part) = &part {
                return self.seen_at(part, for_each, memory, seat, options);
            }
            let own = self.part(Some(seat.into().position()), options)?;
            memory.forget();
            self.seen_at(&own, for_each, memory, seat, options)
        };
        deal(threads, count, &ViewMemory::new, &view, pass)
    }

    /// The view of a part of this cloud. Compiled for each kind of seat: what only viewpoints ask for needs no camera.
    fn seen_at<S: Into<Seat>>(
        &self,
        part: &Self,
        threads: usize,
        memory: &mut ViewMemory,
        seat: S,
        options: &Options,
    ) -> Result<Visibility, Error> {
        let seat = seat.into();
        let seen = part.seen_by(threads, memory, seat.position(), options)?;
        match seat {
            Seat::Viewpoint(_) => Ok(seen),
            Seat::Camera(camera) => self.in_image(&camera, seen),
        }
    }

    /// The cloud after a step, which is kept from now on.
    fn kept_after(&mut self, step: Step) -> Result<&mut Self, Error> {
        // Another part is freed first: there may be no memory for two.
        let kept = self.kept.parts.place(step).take();
        let part = match kept.filter(|(kept, _)| *kept == step) {
            Some((_, part)) => part,
            None => match self.after(step)? {
                Some(part) => Box::new(part),
                None => return Ok(self),
            },
        };
        Ok(&mut self.kept.parts.place(step).insert((step, part)).1)
    }

    /// The cloud after a step; `None` if it is this cloud.
    #[inline(never)]
    fn after(&self, step: Step) -> Result<Option<Self>, Error> {
        match step {
            Step::Within(region) => Ok(Some(self.of_region(&region)?)),
            Step::Sample(count) => self.sample(count),
            Step::Denoise(k) => Ok(Some(self.denoised(k)?)),
        }
    }

    fn of_region(&self, region: &Region) -> Result<Self, OutOfMemory> {
        let points = &self.sequence.points;
        let mut places: Vec<u32> = with_capacity(points.len())?;
        let holds = |&place: &u32| region.holds(points.get(place as usize));
        places.extend((0..points.len() as u32).filter(holds));
        self.of_places(&places)
    }

    /// Keeps the cloud of the masked points. Returns whether it is another one than before.
    #[cfg(feature = "lite")]
    pub(crate) fn keep_masked(&mut self, mask: Vec<u8>) -> Result<bool, Error> {
        let kept = self.kept.masked.as_ref();
        if kept.is_some_and(|(kept, _)| *kept == mask) {
            return Ok(false);
        }
        self.kept.masked = None;
        let mut marks: Vec<bool> = with_capacity(mask.len())?;
        marks.extend(mask.iter().map(|&byte| byte != 0));
        let part = Box::new(self.masked(&marks)?);
        self.kept.masked = Some((mask, part));
        Ok(true)
    }
}

/// The points of one question.
pub(crate) enum Part<'a> {
    Kept(&'a PointCloud),
    Made(Box<PointCloud>),
}

impl Deref for Part<'_> {
    type Target = PointCloud;

    fn deref(&self) -> &PointCloud {
        match self {
            Self::Kept(cloud) => cloud,
            Self::Made(cloud) => cloud,
        }
    }
}

impl Part<'_> {
    /// The part of this part after one more step.
    fn then(self, step: Step) -> Result<Self, Error> {
        if let Self::Kept(cloud) = self {
            if let Some(kept) = cloud.kept.parts.get(step) {
                return Ok(Self::Kept(kept));
            }
        }
        Ok(match self.after(step)? {
            Some(made) => Self::Made(Box::new(made)),
            None => self,
        })
    }
}
