//! A part of a cloud is a cloud. This file says by which steps a part is made, and which parts are
//! kept for the next question.

use alloc::boxed::Box;

use crate::cloud::selection::Region;

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

/// Parts of one `Cloud`, one by each kind of step.
pub(crate) struct KeptParts<Cloud> {
    within: Kept<Cloud>,
    sample: Kept<Cloud>,
    denoise: Kept<Cloud>,
}

/// A part, and the step that made it.
type Kept<Cloud> = Option<(Step, Box<Cloud>)>;

impl<Cloud> Default for KeptParts<Cloud> {
    fn default() -> Self {
        Self {
            within: None,
            sample: None,
            denoise: None,
        }
    }
}

impl<Cloud> KeptParts<Cloud> {
    pub(crate) fn get(&self, step: Step) -> Option<&Cloud> {
        let kept = match step {
            Step::Within(_) => &self.within,
            Step::Sample(_) => &self.sample,
            Step::Denoise(_) => &self.denoise,
        };
        let kept = kept.as_ref().filter(|(kept, _)| *kept == step);
        kept.map(|(_, part)| &**part)
    }

    /// Where a part by this kind of step is kept.
    pub(crate) fn place(&mut self, step: Step) -> &mut Kept<Cloud> {
        match step {
            Step::Within(_) => &mut self.within,
            Step::Sample(_) => &mut self.sample,
            Step::Denoise(_) => &mut self.denoise,
        }
    }
}
