//! The looks of one view, step by step, so that a viewer can give them up when its camera moves.

use glam::DVec3;

use crate::answers::looks::beside::follow;
use crate::answers::looks::look::{Look, SCORES, Seen, Verdicts};
use crate::answers::looks::part::Part;
use crate::answers::looks::rays::Projection;
use crate::answers::looks::tuning::Tuning;
use crate::base::allocation::OutOfMemory;
use crate::base::error::Error;
use crate::base::real::power_of_two_below;
use crate::cloud::noise::{Noise, Surface};
use crate::cloud::point_cloud::{PointCloud, Smooth, Survey};
use crate::cloud::points::Points;
use crate::cloud::statistics::Statistics;
use crate::flip::inversion::{Flip, Lift};
use crate::flip::kernel::Kernel;
use crate::hull::{self, Memory, OuterFaces};
use crate::view::resolved::check_viewpoint;

/// How far, in standard deviations of the noise, a point may be from its place without noise. Chosen
/// on four views of a cow with noise of two spacings.
const DEVIATIONS: f64 = 10.0;

/// How many times the c of the loosest look a map takes. Champions are farther from each other than samples, so that their
/// triangles hide less. With 2, maps hid up to 4 % of what looks show in towns with sparse walls.
const TIGHTER: f64 = 1.4;

/// The place, among the three looks, of look `number` of `count`.
fn place(count: usize, number: usize) -> usize {
    if count == 2 { 2 * number } else { number }
}

/// The c of each of `count` looks at a cloud with these statistics, without noise and range. The
/// remaining numbers are 0.
pub(crate) fn even_scales(count: usize, statistics: &Statistics, noise: &Noise) -> [f64; 3] {
    scales_of(count, &Tuning::plain(statistics, noise))
}

fn scales_of(count: usize, tuning: &Tuning) -> [f64; 3] {
    let mut scales = [0.0; 3];
    for (number, scale) in scales.iter_mut().take(count).enumerate() {
        *scale = tuning.scales[place(count, number)];
    }
    scales
}

/// Where points of a surface with a thickness may be visible.
#[derive(Default)]
pub(crate) struct Depth {
    /// How far behind a surface.
    pub behind: f64,
    /// How far beside a visible point.
    pub aside: f64,
}

/// The hull of a map that stands in for looks: its kernel, where points may be visible besides, and the farthest
/// distance of a point. The map's points are `apart` times as far from each other as those of the cloud.
#[inline(never)]
pub(crate) fn look_of_map(
    cloud: &PointCloud,
    survey: Option<&Survey>,
    viewpoint: [f64; 3],
    thickness: Option<f64>,
    apart: f64,
) -> Result<(Kernel, Depth, f64), Error> {
    check_viewpoint(viewpoint)?;
    let points = &cloud.sequence.points;
    let farthest = cloud.blocks.farthest_distance(points, viewpoint)?;
    let projection = Projection::Perspective(viewpoint);
    let tuning = Tuning::of(projection, cloud, survey, thickness, farthest)?;
    let scale = TIGHTER * apart * tuning.scales[2];
    let kernel = tuning.kernel(scale, farthest);
    let mut behind = tuning.thickness;
    if survey.is_some() && thickness.is_none() {
        behind += DEVIATIONS * cloud.noise()?;
    }
    // The margins of a measured thickness are wide enough as they are.
    let aside = thickness.map_or(0.0, |_| tuning.thickness);
    Ok((kernel, Depth { behind, aside }, farthest))
}

/// What looks are asked for.
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct Question {
    pub projection: Projection,
    pub count: usize,
    pub with_scores: bool,
    pub surface: Option<Surface>,
    pub thickness: Option<f64>,
}

/// Looks that may not all be taken yet.
pub(crate) struct Series {
    question: Question,
    survey: Option<Survey>,
    tuning: Tuning,
    farthest: f64,
    verdicts: Verdicts,
    /// The points of the next look.
    part: Part,
    /// The number of the next look; `count` after the last one, and more when all is done.
    next: usize,
    /// Whether all points are in one plane with the viewpoint.
    is_flat: bool,
}

impl Series {
    /// A viewpoint is checked here.
    pub(crate) fn new(cloud: &PointCloud, question: Question) -> Result<Self, Error> {
        if let Projection::Perspective(viewpoint) = question.projection {
            check_viewpoint(viewpoint)?;
        }
        let survey = cloud.survey(question.surface, question.thickness)?;
        let cloud = looked_at(&survey, cloud);
        let farthest = match question.projection {
            Projection::Perspective(viewpoint) => {
                let points = &cloud.sequence.points;
                cloud.blocks.farthest_distance(points, viewpoint)?
            }
            Projection::Parallel(_) => 0.0,
        };
        let tuning = Tuning::of(
            question.projection,
            cloud,
            survey.as_ref(),
            question.thickness,
            farthest,
        )?;
        Ok(Self {
            question,
            verdicts: Verdicts::new(cloud.sequence.points.len(), question.with_scores)?,
            survey,
            tuning,
            farthest,
            part: Part::All,
            next: 0,
            is_flat: false,
        })
    }

    /// Whether this is the same question.
    pub(crate) fn is_of(&self, question: Question) -> bool {
        self.question == question
    }

    /// Takes the next look. With a finite `budget`, it takes only a part of the first look: about
    /// `budget` points enter its hull. Hulls are built in `memory`. Returns whether all is done.
    pub(crate) fn step(
        &mut self,
        cloud: &PointCloud,
        memory: &mut Memory,
        budget: usize,
    ) -> Result<bool, Error> {
        let survey = self.survey.clone();
        let cloud = looked_at(&survey, cloud);
        let count = self.question.count;
        if self.next >= count {
            // In one plane with the viewpoint, neighbors on a ray see different things.
            if self.next == count && !self.is_flat {
                let points = &cloud.sequence.points;
                follow(&mut self.verdicts, points)?;
                if self.tuning.thickness > 0.0 {
                    let look = self.look(cloud, count - 1);
                    self.verdicts.show_aside(&look, points)?;
                }
                self.verdicts.calibrate(self.tuning.odds);
            }
            self.next = count + 1;
            return Ok(true);
        }
        let outcome = match self.question.projection {
            Projection::Perspective(viewpoint) => {
                self.look_from(viewpoint, cloud, memory, budget)?
            }
            Projection::Parallel(ahead) => self.look_along(ahead, cloud)?,
        };
        match outcome {
            Outcome::Begun => return Ok(false),
            Outcome::Flat => self.is_flat |= self.next == 0,
            Outcome::Left(part) => self.part = part,
            Outcome::Decided => self.next = count - 1,
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
        let look = self.look(cloud, self.next);
        let (own, blocks) = match &self.part {
            Part::All => (points, &cloud.blocks),
            Part::Some { points, blocks, .. } => (points, blocks),
        };
        let blocks = &blocks.levels[0];
        let kernel = self.tuning.kernel(look.scale, self.farthest);
        let flip = Flip::new(viewpoint, kernel).rescaled_for(own);
        let is_sliced = self.next == 0 && budget < usize::MAX;
        if is_sliced && !hull::go_on(own, blocks, &flip, memory, budget)? {
            return Ok(Outcome::Begun);
        }
        hull::mark_visible(own, blocks, &flip, memory)?;
        let verdicts = &mut self.verdicts;
        let outcome = match memory.outer_faces(own, &flip, self.farthest)? {
            Some(mut faces) => verdicts.after(&look, Ok(&mut faces), &self.part, points)?,
            None => verdicts.after(&look, Err(memory.visible()), &self.part, points)?,
        };
        memory.forget();
        Ok(outcome)
    }

    fn look_along(&mut self, ahead: DVec3, cloud: &PointCloud) -> Result<Outcome, OutOfMemory> {
        let look = self.look(cloud, self.next);
        let lift = Lift::new(&cloud.bounds, ahead, 0.5 / look.scale);
        let points = &cloud.sequence.points;
        let own = match &self.part {
            Part::All => points,
            Part::Some { points, .. } => points,
        };
        let lifted = |index: u32| lift.apply(own.get(index as usize));
        let verdicts = &mut self.verdicts;
        match hull::lower_boundary(own.len() as u32, &lifted)? {
            (_, Some(mut faces)) => verdicts.after(&look, Ok(&mut faces), &self.part, points),
            (visible, None) => verdicts.after(&look, Err(&visible), &self.part, points),
        }
    }

    #[inline(never)]
    fn look(&self, cloud: &PointCloud, number: usize) -> Look {
        let place = place(self.question.count, number);
        let scale = self.tuning.scales[place];
        let (origin, unit, ahead) = match self.question.projection {
            Projection::Perspective(viewpoint) => {
                let unit = power_of_two_below((1.0 / self.farthest).min(f64::MAX));
                (DVec3::from_array(viewpoint), unit, None)
            }
            Projection::Parallel(ahead) => {
                let lift = Lift::new(&cloud.bounds, ahead, 0.5 / scale);
                (lift.middle(), lift.scale(), Some(ahead))
            }
        };
        Look {
            origin,
            unit,
            ahead,
            scale,
            tuning: self.tuning,
            farthest: self.farthest,
            score: SCORES[place],
            is_last: number + 1 == self.question.count,
        }
    }

    /// The answer for the points of `cloud`, at which all looks were taken.
    pub(crate) fn finish(self, cloud: &PointCloud) -> Result<Seen, Error> {
        let mut seen = self.verdicts.finish()?;
        seen.scales = scales_of(self.question.count, &self.tuning);
        match smooth(&self.survey) {
            Some(smooth) => smooth.back(seen, cloud),
            None => Ok(seen),
        }
    }
}

/// The points without noise, if they are looked at.
fn smooth(survey: &Option<Survey>) -> Option<&Smooth> {
    survey.as_ref()?.smooth.as_deref()
}

/// The cloud at which the looks are.
pub(crate) fn looked_at<'a>(survey: &'a Option<Survey>, cloud: &'a PointCloud) -> &'a PointCloud {
    smooth(survey).map_or(cloud, |smooth| &smooth.cloud)
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
