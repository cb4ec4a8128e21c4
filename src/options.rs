//! What a caller may choose for one view.

/// How the radius R of the flipping sphere is chosen.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Radius {
    /// From the cloud's spacing and the viewpoint: R = 5·r²/s, never below the
    /// farthest distance.
    #[default]
    Auto,
    /// R itself, in the cloud's units; at least the farthest distance.
    Absolute(f64),
    /// R = farthest distance · 10^exponent, the paper's own parameter; at least 0.
    Exponent(f64),
}

/// The options of one visibility query.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Options {
    /// How R is chosen.
    pub radius: Radius,
}

impl Options {
    /// Options with R given in the cloud's units.
    #[must_use]
    pub fn with_radius(radius: f64) -> Self {
        Self {
            radius: Radius::Absolute(radius),
        }
    }

    /// Options with R = farthest distance · 10^exponent.
    #[must_use]
    pub fn with_exponent(exponent: f64) -> Self {
        Self {
            radius: Radius::Exponent(exponent),
        }
    }
}
