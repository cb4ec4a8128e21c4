//! A part of a cloud is a cloud. This file says by which steps a part is made, and which parts are
//! kept for the next question.

use alloc::boxed::Box;
use core::ops::Deref;

use super::point_cloud::PointCloud;
use super::selection::Region;

/// A step from a cloud to a part of it, or to other places of its points. Indices stay.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Step {
    /// The points in this region.
    Within(Region),
    /// An even sample of so many distinct points.
    Sample(usize),
    /// Each point on the plane of itself and of so many others.
    Denoise(usize),
}

/// All steps from a cloud to the points of a question, in their order.
pub(crate) type Steps = [Option<Step>; 3];

/// Parts of one cloud, one by each kind of step.
#[derive(Default)]
pub(crate) struct KeptParts {
    within: Kept,
    sample: Kept,
    denoise: Kept,
}

/// A part, and the step that made it.
type Kept = Option<(Step, Box<PointCloud>)>;

impl KeptParts {
    pub(crate) fn get(&self, step: Step) -> Option<&PointCloud> {
        let kept = match step {
            Step::Within(_) => &self.within,
            Step::Sample(_) => &self.sample,
            Step::Denoise(_) => &self.denoise,
        };
        let kept = kept.as_ref().filter(|(kept, _)| *kept == step);
        kept.map(|(_, part)| &**part)
    }

    /// Where a part by this kind of step is kept.
    pub(crate) fn place(&mut self, step: Step) -> &mut Kept {
        match step {
            Step::Within(_) => &mut self.within,
            Step::Sample(_) => &mut self.sample,
            Step::Denoise(_) => &mut self.denoise,
        }
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
