//! The options of one view.

use crate::base::error::Error;

/// How the radius R of the flipping sphere is chosen.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Radius {
    /// From the cloud's spacing and the viewpoint: R = 5·r²/s, never below the
    /// farthest distance.
    #[default]
    Auto,
    /// By antipodal search around the closed form of [`Radius::Auto`], with six hulls. Looking
    /// back along the same rays should show exactly the hidden points; R is chosen so.
    Search,
    /// By the paper's own rule (§4), with about 40 hulls. C′ is the mirror image of the
    /// viewpoint C in the cloud's centroid. The rule takes the R for which the most points are
    /// seen by exactly one of C and C′, the smallest of several. In perspective this R is
    /// mostly far too large; the rule is offered for comparison. At the centroid it is
    /// [`Radius::Auto`].
    Opposite,
    /// R itself, in the cloud's units; at least the farthest distance.
    Absolute(f64),
    /// R = farthest distance · 10^exponent, the paper's own parameter; at least 0.
    Exponent(f64),
}

impl Radius {
    /// The option that makes this choice, as the JavaScript package calls it.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Auto | Self::Absolute(_) => "radius",
            Self::Search => "radius \"search\"",
            Self::Opposite => "radius \"opposite\"",
            Self::Exponent(_) => "exponent",
        }
    }
}

/// The distance to which the flip moves a point at distance d from the viewpoint: the kernel
/// f of q = f(d)·v/|v|, strictly decreasing in d.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Inversion {
    /// 2R − d, spherical flipping (paper §3, eq. 1); R by [`Options::radius`].
    #[default]
    Spherical,
    /// d·(d/S)^−γ, the paper's other kernel 1/‖p‖^γ (§3), with 1 < γ ≤ 16. The unit S
    /// fixes the rounding only: [`Radius::Absolute`] if it is given, otherwise the
    /// farthest distance. The nearer γ is to 1, the more is visible.
    Power(f64),
    /// exp(c/d). The scale c depends on the cloud only: one c serves near and far viewpoints.
    /// The smaller c is, the more points are visible. On a surface that faces the viewer it
    /// acts like R = d²/2c.
    Exponential(Exponential),
    /// 2 or 3 looks: exact hulls of exp(c/d) with c from large to small in the cloud's
    /// spacing, each of which decides only what it is sure of. Truer than one hull, but
    /// no longer the operator of the paper: see [`PointCloud::visible_from`]. R has no
    /// meaning for it, so the radius must be [`Radius::Auto`].
    ///
    /// [`PointCloud::visible_from`]: crate::PointCloud::visible_from
    Looks(usize),
}

/// The scale c of [`Inversion::Exponential`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Exponential {
    /// From the cloud's spacing s alone: c = 0.07·s.
    #[default]
    Auto,
    /// c itself, in the cloud's units; positive.
    Scale(f64),
}

/// The options of one visibility query.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Options {
    /// How R is chosen. With [`Inversion::Power`] it may only be [`Radius::Auto`] or
    /// [`Radius::Absolute`], with [`Inversion::Exponential`] only [`Radius::Auto`].
    pub radius: Radius,
    /// How points are flipped.
    pub inversion: Inversion,
    /// For noisy clouds. Before the view, each point is projected on the least-squares plane of
    /// itself and its k nearest other points. Indices and the cloud's positions stay. Each
    /// query computes this anew; for several queries, ask
    /// [`PointCloud::denoised`](crate::PointCloud::denoised) once.
    pub denoise: Option<usize>,
    /// For noisy clouds. After the view, a point is visible when more than 0.4 of itself and its
    /// k nearest other points are.
    pub vote: Option<usize>,
    /// How sure the answer is, too: [`Visibility::scores`](crate::Visibility::scores).
    /// With [`Inversion::Looks`] and one viewpoint only.
    pub scores: bool,
    /// An early answer: contains all that is visible, with the same radius, and some of what
    /// is hidden. What it leaves out is hidden for certain. Takes about half of the time;
    /// from an [`Observer`](crate::Observer) the same view without `draft` goes on from it.
    /// Not with [`Radius::Search`] or [`Radius::Opposite`], whose choice takes longer, nor
    /// where the whole hull is needed ([`Error::NoDraft`]).
    pub draft: bool,
    /// Only an even sample of so many points takes part: the answer is that of a cloud of the
    /// sampled points alone, its own spacing and farthest distance included. Of equal points
    /// all are sampled or none. The sample depends on the set of points alone; a smaller one
    /// is part of a larger one. Chosen anew for each query, unless the cloud is
    /// [prepared](crate::PointCloud::prepare_for) for it.
    pub sample: Option<usize>,
}

impl Options {
    /// Whether the answer is the final one to its question.
    pub(crate) fn is_exact(&self) -> bool {
        !self.draft && self.sample.is_none()
    }

    /// Refuses a draft of what `option` asks for.
    pub(crate) fn refuse_draft(&self, option: &'static str) -> Result<(), Error> {
        if self.draft {
            return Err(Error::NoDraft { option });
        }
        Ok(())
    }

    /// Refuses options that need space, for a cloud of another dimension.
    pub(crate) fn check_dimension(&self, dimension: usize) -> Result<(), Error> {
        let asked = [
            ("denoise", self.denoise.is_some()),
            ("vote", self.vote.is_some()),
            ("looks", self.asks_for_looks()),
            ("scores", self.scores),
        ];
        match asked.into_iter().find(|&(_, is_asked)| is_asked) {
            Some((option, _)) => Err(Error::Dimension { option, dimension }),
            None => Ok(()),
        }
    }

    pub(crate) fn asks_for_looks(&self) -> bool {
        matches!(self.inversion, Inversion::Looks(_))
    }

    /// Refuses looks for what is asked of one hull: `other`, as the JavaScript package
    /// calls it.
    pub(crate) fn refuse_looks(&self, other: &'static str) -> Result<(), Error> {
        if self.asks_for_looks() {
            return Err(Error::LooksWith { other });
        }
        Ok(())
    }

    /// Refuses drafts and samples, in a dimension that has none.
    pub(crate) fn check_whole(&self, dimension: usize) -> Result<(), Error> {
        let asked = [("draft", self.draft), ("sample", self.sample.is_some())];
        match asked.into_iter().find(|(_, is_asked)| *is_asked) {
            Some((option, _)) => Err(Error::Dimension { option, dimension }),
            None => Ok(()),
        }
    }

    /// Options with R given in the cloud's units.
    #[must_use]
    pub fn with_radius(radius: f64) -> Self {
        Self {
            radius: Radius::Absolute(radius),
            ..Self::default()
        }
    }

    /// Options with R = farthest distance · 10^exponent.
    #[must_use]
    pub fn with_exponent(exponent: f64) -> Self {
        Self {
            radius: Radius::Exponent(exponent),
            ..Self::default()
        }
    }

    /// Options with another inversion than the spherical one.
    #[must_use]
    pub fn with_inversion(inversion: Inversion) -> Self {
        Self {
            inversion,
            ..Self::default()
        }
    }
}
