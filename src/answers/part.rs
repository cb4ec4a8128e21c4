//! Parts of a cloud: the answers of the points alone that a box, a distance or a mask leaves.

use alloc::boxed::Box;
use alloc::vec::Vec;

use crate::base::allocation::{OutOfMemory, with_capacity};
use crate::base::error::Error;
use crate::cloud::point_cloud::PointCloud;
use crate::cloud::selection::{Selection, Within};
use crate::view::options::Options;
use crate::view::resolved::check_viewpoint;

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
        let rest = self.sequence.without(|index| !mask[index as usize])?;
        Ok(self.of_sequence(rest)?)
    }

    /// Asks a cloud that holds only the points that `options` choose: those within a box and a
    /// distance from `viewpoint`, or, where there is no such choice, those of a sample. The query
    /// is asked with the other options.
    ///
    /// Without a viewpoint, only the box is followed, and the distance stays in the options.
    pub(crate) fn on_chosen<T>(
        &self,
        viewpoint: Option<[f64; 3]>,
        options: &Options,
        query: &mut dyn FnMut(&Self, &Options) -> Result<T, Error>,
    ) -> Result<T, Error> {
        let mut made = None;
        let mut options = *options;
        let cloud = self.chosen(viewpoint, &mut options, &mut made)?;
        query(cloud, &options)
    }

    /// The cloud of the chosen points, kept or `made`. Takes the choice out of `options`.
    #[inline(never)]
    fn chosen<'a>(
        &'a self,
        viewpoint: Option<[f64; 3]>,
        options: &mut Options,
        made: &'a mut Option<Self>,
    ) -> Result<&'a Self, Error> {
        let Some(within) = options.within else {
            return match options.sample.take() {
                Some(count) => self.kept_or_sampled(count, options, made),
                None => Ok(self),
            };
        };
        if within == Within::default() {
            options.within = None;
            return Ok(self);
        }
        let key = key(&within, viewpoint)?;
        options.within = match viewpoint {
            Some(_) => None,
            None => within.without_bounds(),
        };
        Ok(match &self.kept.within {
            Some((kept, part)) if *kept == key => part,
            _ => made.insert(self.within(&key)?),
        })
    }

    /// Keeps the cloud of the points within a box, or within a distance from `viewpoint`, and
    /// prepares it.
    pub(crate) fn keep_within(
        &mut self,
        viewpoint: Option<[f64; 3]>,
        within: &Within,
        options: &Options,
    ) -> Result<(), Error> {
        let key = key(within, viewpoint)?;
        if within.distance.is_some() && viewpoint.is_none() {
            // Each viewpoint of the query has another part.
            return Ok(());
        }
        if self
            .kept
            .within
            .as_ref()
            .is_none_or(|(kept, _)| *kept != key)
        {
            // The old cloud is freed first: there may be no memory for two.
            self.kept.within = None;
            self.kept.within = Some((key, Box::new(self.within(&key)?)));
        }
        let part = self.kept.within.as_mut();
        let options = Options {
            within: None,
            ..*options
        };
        part.map_or(Ok(()), |(_, cloud)| cloud.prepare_view(viewpoint, &options))
    }

    #[inline(never)]
    fn within(&self, selection: &Selection) -> Result<Self, OutOfMemory> {
        let points = &self.sequence.points;
        let mut places: Vec<u32> = with_capacity(points.len())?;
        let holds = |&place: &u32| selection.holds(points.get(place as usize));
        places.extend((0..points.len() as u32).filter(holds));
        self.of_places(&places)
    }

    /// Keeps the cloud of the masked points. Returns whether it is another one than before.
    #[cfg(feature = "wasm")]
    pub(crate) fn keep_masked(&mut self, mask: Vec<u8>) -> Result<bool, Error> {
        if self
            .kept
            .masked
            .as_ref()
            .is_some_and(|(kept, _)| *kept == mask)
        {
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

/// A checked choice. Without a viewpoint, the distance does not count.
fn key(within: &Within, viewpoint: Option<[f64; 3]>) -> Result<Selection, Error> {
    within.check()?;
    let Some(viewpoint) = viewpoint.filter(|_| within.distance.is_some()) else {
        let within = Within {
            distance: None,
            ..*within
        };
        return Ok(Selection::new(within, None));
    };
    check_viewpoint(viewpoint)?;
    Ok(Selection::new(*within, Some(viewpoint)))
}
