//! The one place where a question gets its points. Options that choose points lead to a cloud of these points
//! alone; no question knows of them.

use alloc::boxed::Box;
use alloc::vec::Vec;
use core::ops::Deref;

use crate::answers::memory::ViewMemory;
use crate::answers::visibility::Visibility;
use crate::base::allocation::{OutOfMemory, with_capacity};
use crate::base::error::Error;
use crate::base::threads::deal;
use crate::cloud::point_cloud::PointCloud;
use crate::cloud::selection::{Region, Within};
use crate::view::camera::Seat;
use crate::view::options::Options;
use crate::view::resolved::looks;

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
    /// [`Error::Parameter`] for a box; [`Error::OutOfRange`] for a distance below 0;
    /// [`Error::Viewpoint`]; [`Error::OutOfMemory`].
    pub fn within(&self, within: &Within, viewpoint: [f64; 3]) -> Result<Self, Error> {
        Ok(match within.region(Some(viewpoint))? {
            Some(region) => self.of_region(&region)?,
            None => self.clone(),
        })
    }

    /// Prepares the cloud for views with the same `within`: keeps the points in the box until points are appended or
    /// removed. Answers are the same as without preparation. A view then need not choose points. Nothing is kept for a
    /// distance, because each viewpoint has other points there.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] and [`Error::Parameter`] as for the view;
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
        let Some(region) = options.region(viewpoint)? else {
            return Ok(());
        };
        let is_kept = matches!(&self.kept.within, Some((kept, _)) if *kept == region);
        if is_kept || viewpoint.is_none() && options.has_distance() {
            return Ok(());
        }
        // Another part is freed first: there may be no memory for two.
        self.kept.within = None;
        self.kept.within = Some((region, Box::new(self.of_region(&region)?)));
        Ok(())
    }

    /// The points of a question with these options. Without a viewpoint, a distance does not count.
    pub(crate) fn part(
        &self,
        viewpoint: Option<[f64; 3]>,
        options: &Options,
    ) -> Result<Part<'_>, Error> {
        let Some(region) = options.region(viewpoint)? else {
            return Ok(Part::Kept(self));
        };
        match &self.kept.within {
            Some((kept, part)) if *kept == region => Ok(Part::Kept(part)),
            _ => Ok(Part::Made(Box::new(self.of_region(&region)?))),
        }
    }

    /// Passes the view from each seat, with its number, in any order. A seat may have its own part.
    /// The threads share the seats, and a view if there are fewer seats.
    pub(crate) fn each_view<S: Copy + Into<Seat> + Sync>(
        &self,
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
        let for_each = options.with_threads(options.threads / count.max(1));
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
                return self.seen_at(part, memory, seat, &for_each);
            }
            let own = self.part(Some(seat.into().position()), options)?;
            memory.forget();
            self.seen_at(&own, memory, seat, &for_each)
        };
        deal(options.threads, count, &ViewMemory::new, &view, pass)
    }

    /// The view of a part of this cloud. Compiled for each kind of seat: what only viewpoints ask for needs no camera.
    fn seen_at<S: Into<Seat>>(
        &self,
        part: &Self,
        memory: &mut ViewMemory,
        seat: S,
        options: &Options,
    ) -> Result<Visibility, Error> {
        let seat = seat.into();
        let seen = part.seen_by(memory, seat.position(), options)?;
        match seat {
            Seat::Viewpoint(_) => Ok(seen),
            Seat::Camera(camera) => self.in_image(&camera, seen),
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
