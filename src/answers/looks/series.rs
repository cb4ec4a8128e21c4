//! The looks of one view, step by step, so that a viewer can give them up when its camera moves.

use glam::DVec3;

use super::followers::follow;
use super::look::{Gaze, Look, Seen, Verdicts};
use super::part::Part;
use crate::base::allocation::OutOfMemory;
use crate::base::error::Error;
use crate::base::real::power_of_two_below;
use crate::cloud::point_cloud::PointCloud;
use crate::cloud::points::Points;
use crate::cloud::statistics::Statistics;
use crate::flip::inversion::Flip;
use crate::flip::kernel::Kernel;
use crate::flip::lift::Lift;
use crate::hull::{self, Memory, OuterFaces};
use crate::view::resolved::check_viewpoint;

/// The scale c of each look as a share of the cloud's spacing × widening, from tight to loose. Two
/// looks leave out the middle one. Twice or half of any of these values changes the error little.
const SHARES: [f64; 3] = [0.28, 0.07, 0.02];
/// The highest score of a hull vertex, by look.
const SCORES: [f64; 3] = [1.0, 1.0, 0.9];

/// The c of each of `count` looks at a cloud with these statistics. The remaining numbers are 0.
pub(crate) fn scales(count: usize, statistics: &Statistics) -> [f64; 3] {
    // Where samples leave much empty, gaps are wider than the spacing.
    let gap = statistics.spacing * statistics.widening;
    // Without a spacing there is one point at most, and any scale gives the same answer.
    let gap = if gap > 0.0 { gap } else { 1.0 };
    let mut scales = [0.0; 3];
    for (number, scale) in scales.iter_mut().take(count).enumerate() {
        let share = SHARES[place(count, number)];
        *scale = (share * gap).clamp(f64::MIN_POSITIVE, f64::MAX);
    }
    scales
}

/// The place, among the three looks, of look `number` of `count`.
fn place(count: usize, number: usize) -> usize {
    if count == 2 { 2 * number } else { number }
}

/// Looks that may not all be taken yet.
pub(crate) struct Series {
    gaze: Gaze,
    count: usize,
    with_scores: bool,
    verdicts: Verdicts,
    /// The points of the next look.
    part: Part,
    /// The number of the next look; `count` after the last one, and more when all is done.
    next: usize,
    /// Whether the hull of the first look was begun.
    is_begun: bool,
    /// Whether all points are in one plane with the viewpoint.
    is_flat: bool,
}

impl Series {
    /// A viewpoint is checked here.
    pub(crate) fn new(
        cloud: &PointCloud,
        gaze: Gaze,
        count: usize,
        with_scores: bool,
    ) -> Result<Self, Error> {
        if let Gaze::From(viewpoint) = gaze {
            check_viewpoint(viewpoint)?;
        }
        Ok(Self {
            gaze,
            count,
            with_scores,
            verdicts: Verdicts::new(cloud.sequence.points.len(), with_scores)?,
            part: Part::All,
            next: 0,
            is_begun: false,
            is_flat: false,
        })
    }

    /// Whether this is the same question.
    pub(crate) fn is_of(&self, gaze: Gaze, count: usize, with_scores: bool) -> bool {
        (self.gaze, self.count, self.with_scores) == (gaze, count, with_scores)
    }

    /// Takes the next look. With a finite `budget`, it takes only a part of the first look: about
    /// `budget` points enter its hull. Hulls are built in `memory`. Returns whether all is done.
    pub(crate) fn step(
        &mut self,
        cloud: &PointCloud,
        memory: &mut Memory,
        budget: usize,
    ) -> Result<bool, Error> {
        if self.next >= self.count {
            // In one plane with the viewpoint, neighbors on a ray see different things.
            if self.next == self.count && !self.is_flat {
                follow(&mut self.verdicts, &cloud.sequence.points)?;
                self.verdicts.mix_scores()?;
            }
            self.next = self.count + 1;
            return Ok(true);
        }
        let outcome = match self.gaze {
            Gaze::From(viewpoint) => self.look_from(viewpoint, cloud, memory, budget)?,
            Gaze::Along(ahead) => self.look_along(ahead, cloud)?,
        };
        match outcome {
            Outcome::Begun => return Ok(false),
            Outcome::Flat => self.is_flat |= self.next == 0,
            Outcome::Left(part) => self.part = part,
            Outcome::Decided => self.next = self.count - 1,
        }
        self.next += 1;
        Ok(false)
    }

    fn look_from(
        &mut self,
        viewpoint: [f64; 3],
        cloud: &PointCloud,
        memory: &mut Memory,
        budget: usize,
    ) -> Result<Outcome, Error> {
        let points = &cloud.sequence.points;
        let farthest = cloud.blocks.farthest_distance(points, viewpoint)?;
        let mut look = self.look(cloud, DVec3::from_array(viewpoint), None);
        look.unit = power_of_two_below((1.0 / farthest).min(f64::MAX));
        let (own, blocks) = match &self.part {
            Part::All => (points, &cloud.blocks),
            Part::Some { points, blocks, .. } => (points, blocks),
        };
        let blocks = &blocks.levels[0];
        let kernel = Kernel::Exponential { scale: look.scale };
        let flip = Flip::new(viewpoint, kernel).rescaled_for(own);
        if self.next == 0 && budget < usize::MAX {
            let is_begun = core::mem::replace(&mut self.is_begun, true);
            if !is_begun {
                hull::mark_draft(own, blocks, &flip, memory)?;
            }
            if !is_begun || !hull::go_on(own, blocks, &flip, memory, budget)? {
                return Ok(Outcome::Begun);
            }
        }
        hull::mark_visible(own, blocks, &flip, None, memory)?;
        let verdicts = &mut self.verdicts;
        let outcome = match memory.outer_faces(own, &flip, farthest)? {
            Some(mut faces) => verdicts.after(&look, Ok(&mut faces), &self.part, points)?,
            None => verdicts.after(&look, Err(memory.visible()), &self.part, points)?,
        };
        memory.forget();
        Ok(outcome)
    }

    fn look_along(&mut self, ahead: DVec3, cloud: &PointCloud) -> Result<Outcome, OutOfMemory> {
        let mut look = self.look(cloud, DVec3::ZERO, Some(ahead));
        let lift = Lift::new(&cloud.bounds, ahead, 0.5 / look.scale);
        look.origin = lift.middle();
        look.unit = lift.scale();
        let points = &cloud.sequence.points;
        let own = match &self.part {
            Part::All => points,
            Part::Some { points, .. } => points,
        };
        let lifted = |index: u32| lift.apply(own.get(index as usize));
        let verdicts = &mut self.verdicts;
        match hull::lower_boundary(own.len() as u32, &lifted, false)? {
            (_, Some(mut faces)) => verdicts.after(&look, Ok(&mut faces), &self.part, points),
            (visible, None) => verdicts.after(&look, Err(&visible), &self.part, points),
        }
    }

    #[inline(never)]
    fn look(&self, cloud: &PointCloud, origin: DVec3, ahead: Option<DVec3>) -> Look {
        Look {
            origin,
            unit: 1.0,
            ahead,
            scale: scales(self.count, &cloud.statistics)[self.next],
            score: SCORES[place(self.count, self.next)],
            is_last: self.next + 1 == self.count,
        }
    }

    pub(crate) fn finish(self) -> Result<Seen, OutOfMemory> {
        self.verdicts.finish()
    }
}

/// How a step ends.
enum Outcome {
    /// The hull is not complete.
    Begun,
    /// The hull has no faces. The same points take part in the next look.
    Flat,
    /// These points take part in the next look.
    Left(Part),
    /// There is no next look.
    Decided,
}

impl Verdicts {
    /// Lets a look at `part` decide by its faces. Without faces, the visible points of the flat hull
    /// count.
    #[inline(never)]
    fn after(
        &mut self,
        look: &Look,
        hull: Result<&mut dyn OuterFaces, &[bool]>,
        part: &Part,
        points: &Points,
    ) -> Result<Outcome, OutOfMemory> {
        let faces = match hull {
            Ok(faces) => faces,
            Err(visible) => {
                self.take_flat(look, part, visible);
                return Ok(Outcome::Flat);
            }
        };
        let left = self.take(look, points, faces, part)?;
        if look.is_last || !self.are_open() {
            return Ok(Outcome::Decided);
        }
        Ok(Outcome::Left(left.part(points, part)?))
    }
}
