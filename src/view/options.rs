//! The options of one view.

use crate::base::error::Error;
use crate::cloud::noise::Surface;
use crate::cloud::selection::{Region, Within};

/// How the radius R of the flipping sphere is chosen.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Radius {
    /// From the cloud's sampling and the viewpoint: R = 0.4·n^¼·r²/g, never below the
    /// farthest distance. n is the number of distinct points. g = mean(s³)/mean(s)², where s is the
    /// mean distance of a point from its 6 nearest points: the cloud's spacing where sampling is
    /// even, and more where it is not. g is up to 32 times larger where the points leave much of
    /// what they span empty, and smaller for measured surfaces (`docs/VISIBLE.md`). r² is the mean square of the distances from the
    /// viewpoint, in which each point counts s² times, as the area for which it stands.
    #[default]
    Auto,
    /// By the paper's own rule (§4), with about 40 hulls. C′ is the mirror image of the
    /// viewpoint C in the cloud's centroid. The rule takes the R for which the most points are
    /// seen by exactly one of C and C′. If several R are equally good, it takes the smallest.
    /// In perspective this R is mostly far too large; the rule is offered for comparison. At
    /// the centroid it is [`Radius::Auto`].
    Opposite,
    /// R itself, in the cloud's units; at least the farthest distance.
    Absolute(f64),
    /// R = farthest distance · 10^exponent, the paper's own parameter; at least 0.
    Exponent(f64),
}

/// The distance to which the flip moves a point at distance d from the viewpoint: the kernel
/// f of q = f(d)·v/|v|, strictly decreasing in d.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
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
    /// 2 or 3 looks: exact hulls of exp(c/d), with c from large to small. It follows from the
    /// cloud's spacing, and from how much its points leave empty. Each look decides only the points that it is sure of. The answer has
    /// fewer errors than that of one hull, but it is not the operator of the paper: see
    /// [`PointCloud::visible_from`]. R has no meaning here, so the radius must be
    /// [`Radius::Auto`].
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

/// The options of one visibility query. Each has a field, and a method that sets it.
///
/// ```
/// use hidden_point_removal::{Options, Radius};
///
/// let options = Options::looks(3).with_scores(true);
/// assert!(options.scores && options.within.is_none());
/// assert_eq!(Options::exponent(3.0), Options::default().with_radius(Radius::Exponent(3.0)));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// How R is chosen. With [`Inversion::Power`] it may only be [`Radius::Auto`] or
    /// [`Radius::Absolute`], with [`Inversion::Exponential`] only [`Radius::Auto`].
    pub radius: Radius,
    /// How points are flipped.
    pub inversion: Inversion,
    /// Whether the answer also holds scores, which show how sure it is:
    /// [`Visibility::scores`](crate::Visibility::scores). Scores need [`Inversion::Looks`] and a
    /// single viewpoint.
    pub scores: bool,
    /// With [`Inversion::Looks`]: how far behind the surface before it a point may lie and still be
    /// seen, in the cloud's units; at least 0. Without a number it follows from the cloud's noise
    /// ([`PointCloud::noise`](crate::PointCloud::noise)), and noise that is the same everywhere is
    /// removed before the view. 0 stands for a surface without thickness.
    pub thickness: Option<f64>,
    /// With [`Inversion::Looks`]: what the cloud is. By default it is what
    /// [`PointCloud::surface`](crate::PointCloud::surface) finds; with a number as thickness, points do not move.
    pub surface: Option<Surface>,
    /// Only these points take part: those near the viewpoint, or in a box. The answer is the same
    /// as that of a cloud of these points alone, with its own spacing and farthest distance. It is
    /// followed before all other options. Where there are several viewpoints or lights, each has
    /// its own points. A mask chooses points by index: [`PointCloud::masked`].
    ///
    /// [`PointCloud::masked`]: crate::PointCloud::masked
    pub within: Option<Within>,
    /// How many threads compute, at most 256; 0 and 1 are the caller's alone. They change no bit of an answer.
    /// Several viewpoints are shared among the threads. If there are fewer viewpoints than threads, each view is divided
    /// by direction. This needs spherical flipping with an exponent below 8, and gains little below 200,000 points. While
    /// a question is answered, each thread takes about 150 bytes for each visible point of its share, and one byte for
    /// each point. One thread answers all other questions, and all without the feature `std`.
    pub threads: usize,
}

/// A value of an option as another language gives it: [`Options::set`].
#[doc(hidden)]
#[derive(Clone, Copy, Debug)]
pub enum Given<'a> {
    Number(f64),
    Word(&'a str),
    Truth(bool),
    /// A dictionary of one entry.
    Entry(&'a str, &'a Given<'a>),
}

impl Options {
    pub(crate) fn asks_for_looks(&self) -> bool {
        matches!(self.inversion, Inversion::Looks(_))
    }

    /// These options for a cloud of the points that take part.
    pub(crate) fn of_all(&self) -> Self {
        Self {
            within: None,
            ..*self
        }
    }

    /// Whether each viewpoint has its own part of the points.
    pub(crate) fn has_distance(&self) -> bool {
        self.within.is_some_and(|within| within.distance.is_some())
    }

    /// Where the points are that take part in a view from `viewpoint`; `None` if that is everywhere. Without a
    /// viewpoint, a distance does not count.
    pub(crate) fn region(&self, viewpoint: Option<[f64; 3]>) -> Result<Option<Region>, Error> {
        match &self.within {
            Some(within) => within.region(viewpoint),
            None => Ok(None),
        }
    }

    /// Sets an option by its name in `src/options.json`. Returns whether it takes such a value. For bindings.
    #[doc(hidden)]
    #[must_use]
    pub fn set(&mut self, name: &str, value: Given<'_>) -> bool {
        use Given::{Entry, Number, Truth, Word};
        match (name, value) {
            ("radius", Word("auto")) => self.radius = Radius::Auto,
            ("radius", Word("opposite")) => self.radius = Radius::Opposite,
            ("radius", Number(radius)) => self.radius = Radius::Absolute(radius),
            ("exponent", Number(exponent)) => self.radius = Radius::Exponent(exponent),
            ("inversion", Word("spherical")) => self.inversion = Inversion::Spherical,
            ("inversion", Entry("power", &Number(power))) => {
                self.inversion = Inversion::Power(power);
            }
            ("inversion", Entry("exponential", Word("auto"))) => {
                self.inversion = Inversion::Exponential(Exponential::Auto);
            }
            ("inversion", Entry("exponential", &Number(scale))) => {
                self.inversion = Inversion::Exponential(Exponential::Scale(scale));
            }
            ("looks", Number(count)) if count >= 0.0 && count as usize as f64 == count => {
                self.inversion = Inversion::Looks(count as usize);
            }
            ("scores", Truth(scores)) => self.scores = scores,
            ("thickness", Word("auto")) => self.thickness = None,
            ("thickness", Number(thickness)) => self.thickness = Some(thickness),
            ("surface", Word("auto")) => self.surface = None,
            ("surface", Word(word)) => {
                match Surface::ALL.into_iter().find(|own| own.name() == word) {
                    None => return false,
                    found => self.surface = found,
                }
            }
            _ => return false,
        }
        true
    }

    const DEFAULT: Self = Self {
        radius: Radius::Auto,
        inversion: Inversion::Spherical,
        scores: false,
        thickness: None,
        surface: None,
        within: None,
        threads: 0,
    };

    /// Options with R given in the cloud's units.
    #[must_use]
    pub const fn radius(radius: f64) -> Self {
        Self::DEFAULT.with_radius(Radius::Absolute(radius))
    }

    /// Options with R = farthest distance · 10^exponent.
    #[must_use]
    pub const fn exponent(exponent: f64) -> Self {
        Self::DEFAULT.with_radius(Radius::Exponent(exponent))
    }

    /// Options with another inversion than the spherical one.
    #[must_use]
    pub const fn inversion(inversion: Inversion) -> Self {
        Self::DEFAULT.with_inversion(inversion)
    }

    /// Options with 2 or 3 looks: [`Inversion::Looks`].
    #[must_use]
    pub const fn looks(count: usize) -> Self {
        Self::inversion(Inversion::Looks(count))
    }

    /// Sets [`Options::radius`](field@Self::radius).
    #[must_use]
    pub const fn with_radius(self, radius: Radius) -> Self {
        Self { radius, ..self }
    }

    /// Sets [`Options::inversion`](field@Self::inversion).
    #[must_use]
    pub const fn with_inversion(self, inversion: Inversion) -> Self {
        Self { inversion, ..self }
    }

    /// Sets [`Options::scores`](field@Self::scores).
    #[must_use]
    pub const fn with_scores(self, scores: bool) -> Self {
        Self { scores, ..self }
    }

    /// Sets [`Options::thickness`](field@Self::thickness), to a number or to none.
    #[must_use]
    pub fn with_thickness(self, thickness: impl Into<Option<f64>>) -> Self {
        let thickness = thickness.into();
        Self { thickness, ..self }
    }

    /// Sets [`Options::surface`](field@Self::surface).
    #[must_use]
    pub fn with_surface(self, surface: impl Into<Option<Surface>>) -> Self {
        let surface = surface.into();
        Self { surface, ..self }
    }

    /// Sets [`Options::within`](field@Self::within), to a choice or to none.
    #[must_use]
    pub fn with_within(self, within: impl Into<Option<Within>>) -> Self {
        let within = within.into();
        Self { within, ..self }
    }

    /// Sets [`Options::threads`](field@Self::threads).
    #[must_use]
    pub const fn with_threads(self, threads: usize) -> Self {
        Self { threads, ..self }
    }
}
