//! Which options exclude each other, and which questions have no answer to an option: all of it.

use crate::base::error::{Error, in_range};
use crate::base::threads::HAS_THREADS;
use crate::view::options::{Inversion, Options, Radius};

/// A question that does not go with every option.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum QuestionKind {
    View,
    Map,
    Several,
    Direction,
    Sees,
    Coverage,
    PlaceViewpoints,
    Panorama,
    Reconstruct,
    Illuminate,
    Merge,
}

/// More threads would only wait for memory.
const MOST_THREADS: f64 = 256.0;

/// Something that options ask for.
struct Feature {
    /// As the JavaScript package calls it.
    name: &'static str,
    is_in: fn(&Options) -> bool,
}

const OPPOSITE: Feature = Feature {
    name: "radius \"opposite\"",
    is_in: |options| options.radius == Radius::Opposite,
};
const RADIUS: Feature = Feature {
    name: "radius",
    is_in: |options| matches!(options.radius, Radius::Absolute(_)),
};
const EXPONENT: Feature = Feature {
    name: "exponent",
    is_in: |options| matches!(options.radius, Radius::Exponent(_)),
};
const POWER: Feature = Feature {
    name: "inversion power",
    is_in: |options| matches!(options.inversion, Inversion::Power(_)),
};
const EXPONENTIAL: Feature = Feature {
    name: "inversion exponential",
    is_in: |options| matches!(options.inversion, Inversion::Exponential(_)),
};
const LOOKS: Feature = Feature {
    name: "looks",
    is_in: Options::asks_for_looks,
};
const ONE_HULL: Feature = Feature {
    name: "an answer without looks",
    is_in: |options| !options.asks_for_looks(),
};
const SCORES: Feature = Feature {
    name: "scores",
    is_in: |options| options.scores,
};
const THICKNESS: Feature = Feature {
    name: "thickness",
    is_in: |options| options.thickness.is_some(),
};
const SURFACE: Feature = Feature {
    name: "surface",
    is_in: |options| options.surface.is_some(),
};
const WITHIN: Feature = Feature {
    name: "within",
    is_in: |options| options.within.is_some(),
};
const DISTANCE: Feature = Feature {
    name: "within distance",
    is_in: Options::has_distance,
};

/// Each option with those that it excludes, for every question.
const OPTIONS: [(Feature, &[Feature]); 7] = [
    (LOOKS, &[OPPOSITE, RADIUS, EXPONENT]),
    (SCORES, &[ONE_HULL]),
    (THICKNESS, &[ONE_HULL]),
    (SURFACE, &[ONE_HULL]),
    (OPPOSITE, &[POWER, EXPONENTIAL]),
    (RADIUS, &[EXPONENTIAL]),
    (EXPONENT, &[POWER, EXPONENTIAL]),
];

impl QuestionKind {
    /// Its name, and the options that it excludes.
    fn excludes(self) -> (&'static str, &'static [Feature]) {
        match self {
            Self::View => ("a view", &[]),
            Self::Map => ("visibilityMap", &[SCORES, OPPOSITE]),
            Self::Several => ("several viewpoints", &[SCORES]),
            Self::Direction => ("a direction", &[DISTANCE, POWER, OPPOSITE]),
            Self::Sees => ("sees", &[SCORES]),
            Self::Coverage => ("coverage", &[SCORES]),
            Self::PlaceViewpoints => ("placeViewpoints", &[SCORES]),
            Self::Panorama => ("panorama", &[SCORES]),
            Self::Reconstruct => ("reconstruct", &[LOOKS]),
            Self::Illuminate => ("illuminate", &[LOOKS]),
            Self::Merge => ("merging", &[LOOKS, WITHIN]),
        }
    }
}

impl Options {
    /// Refuses what this question cannot answer, and options that exclude each other.
    #[inline(never)]
    pub(crate) fn check(&self, question: QuestionKind) -> Result<(), Error> {
        if HAS_THREADS {
            in_range("threads", self.threads.max(1) as f64, 1.0, MOST_THREADS)?;
        }
        let (name, excluded) = question.excludes();
        if let Some(option) = self.first_of(excluded) {
            return Err(Error::Excludes {
                option,
                other: name,
            });
        }
        for (feature, excluded) in &OPTIONS {
            if let Some(other) = self.first_of(excluded).filter(|_| (feature.is_in)(self)) {
                let option = feature.name;
                return Err(Error::Excludes { option, other });
            }
        }
        Ok(())
    }

    /// Refuses options that a cloud of this dimension, at least 4, has not.
    #[cfg(feature = "higher")]
    pub(crate) fn check_dimension(&self, dimension: usize) -> Result<(), Error> {
        let features = [LOOKS, SCORES, WITHIN];
        let refused = self.first_of(&features);
        refused.map_or(Ok(()), |option| Err(Error::Dimension { option, dimension }))
    }

    fn first_of(&self, features: &[Feature]) -> Option<&'static str> {
        let asked = features.iter().find(|feature| (feature.is_in)(self));
        asked.map(|feature| feature.name)
    }
}
