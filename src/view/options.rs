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

/// Makes [`Options`]. Each row gives a field, a method that sets it, and how [`Options::set`] reads it: by its type.
macro_rules! options {
    ($($(#[$doc:meta])* pub $name:ident: $type:ty, set by $setter:ident($given:ty);)*) => {
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
            $($(#[$doc])* pub $name: $type,)*
        }

        impl Options {
            $(
                #[doc = concat!("Sets [`Options::", stringify!($name), "`](field@Self::", stringify!($name), ").")]
                #[must_use]
                pub fn $setter(self, $name: $given) -> Self {
                    Self { $name: $name.into(), ..self }
                }
            )*

            /// Sets an option by its name in `src/options.json`. Returns whether it takes such a value. For bindings.
            #[doc(hidden)]
            #[must_use]
            pub fn set(&mut self, name: &str, value: Given<'_>) -> bool {
                match name {
                    $(stringify!($name) => self.$name.read(value),)*
                    _ => self.set_other(name, value),
                }
            }
        }
    };
}

options! {
    /// How R is chosen. With [`Inversion::Power`] it may only be [`Radius::Auto`] or
    /// [`Radius::Absolute`], with [`Inversion::Exponential`] only [`Radius::Auto`].
    pub radius: Radius, set by with_radius(Radius);

    /// How points are flipped.
    pub inversion: Inversion, set by with_inversion(Inversion);

    /// Whether the answer also holds scores, which show how sure it is:
    /// [`Visibility::scores`](crate::Visibility::scores). Scores need [`Inversion::Looks`] and a
    /// single viewpoint.
    pub scores: bool, set by with_scores(bool);

    /// With [`Inversion::Looks`]: how far behind the surface before it a point may lie and still be
    /// seen, in the cloud's units; at least 0. Without a number it follows from the cloud's noise
    /// ([`PointCloud::noise`](crate::PointCloud::noise)), and noise that is the same everywhere is
    /// removed before the view. 0 stands for a surface without thickness.
    pub thickness: Option<f64>, set by with_thickness(impl Into<Option<f64>>);

    /// With [`Inversion::Looks`]: what the cloud is. By default it is what
    /// [`PointCloud::surface`](crate::PointCloud::surface) finds; with a number as thickness, points do not move.
    pub surface: Option<Surface>, set by with_surface(impl Into<Option<Surface>>);

    /// Only these points take part: those near the viewpoint, or in a box. The answer is the same
    /// as that of a cloud of these points alone, with its own spacing and farthest distance. It is
    /// followed before all other options. Where there are several viewpoints or lights, each has
    /// its own points. A mask chooses points by index: [`PointCloud::masked`].
    ///
    /// [`PointCloud::masked`]: crate::PointCloud::masked
    pub within: Option<Within>, set by with_within(impl Into<Option<Within>>);

    /// How many threads compute, at most 256; 0 and 1 are the caller's alone. They change no bit of an answer.
    /// Several viewpoints are shared among the threads. If there are fewer viewpoints than threads, each view is divided
    /// by direction. This needs spherical flipping with an exponent below 8, and gains little below 200,000 points. While
    /// a question is answered, each thread takes about 150 bytes for each visible point of its share, and one byte for
    /// each point. One thread answers all other questions, and all without the feature `std`.
    pub threads: usize, set by with_threads(usize);
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

    /// Sets what has no field of its own.
    fn set_other(&mut self, name: &str, value: Given<'_>) -> bool {
        match (name, value) {
            ("exponent", Given::Number(exponent)) => self.radius = Radius::Exponent(exponent),
            ("looks", Given::Number(count)) if count >= 0.0 && count as usize as f64 == count => {
                self.inversion = Inversion::Looks(count as usize);
            }
            _ => return false,
        }
        true
    }

    /// Options with R given in the cloud's units.
    #[must_use]
    pub fn radius(radius: f64) -> Self {
        Self::default().with_radius(Radius::Absolute(radius))
    }

    /// Options with R = farthest distance · 10^exponent.
    #[must_use]
    pub fn exponent(exponent: f64) -> Self {
        Self::default().with_radius(Radius::Exponent(exponent))
    }

    /// Options with another inversion than the spherical one.
    #[must_use]
    pub fn inversion(inversion: Inversion) -> Self {
        Self::default().with_inversion(inversion)
    }

    /// Options with 2 or 3 looks: [`Inversion::Looks`].
    #[must_use]
    pub fn looks(count: usize) -> Self {
        Self::inversion(Inversion::Looks(count))
    }
}

/// A type that some option has.
trait Value {
    /// Reads a value from another language, and returns whether it is of this type.
    fn read(&mut self, _: Given<'_>) -> bool {
        false
    }
}

impl Value for bool {
    fn read(&mut self, given: Given<'_>) -> bool {
        let Given::Truth(truth) = given else {
            return false;
        };
        *self = truth;
        true
    }
}

impl Value for Option<f64> {
    fn read(&mut self, given: Given<'_>) -> bool {
        *self = match given {
            Given::Word("auto") => None,
            Given::Number(number) => Some(number),
            _ => return false,
        };
        true
    }
}

impl Value for Option<Surface> {
    fn read(&mut self, given: Given<'_>) -> bool {
        let Given::Word(word) = given else {
            return false;
        };
        *self = Surface::ALL.into_iter().find(|own| own.name() == word);
        self.is_some() || word == "auto"
    }
}

impl Value for Radius {
    fn read(&mut self, given: Given<'_>) -> bool {
        *self = match given {
            Given::Word("auto") => Self::Auto,
            Given::Word("opposite") => Self::Opposite,
            Given::Number(radius) => Self::Absolute(radius),
            _ => return false,
        };
        true
    }
}

impl Value for Inversion {
    fn read(&mut self, given: Given<'_>) -> bool {
        use Given::{Entry, Number, Word};
        *self = match given {
            Word("spherical") => Self::Spherical,
            Entry("power", &Number(power)) => Self::Power(power),
            Entry("exponential", Word("auto")) => Self::Exponential(Exponential::Auto),
            Entry("exponential", &Number(scale)) => Self::Exponential(Exponential::Scale(scale)),
            _ => return false,
        };
        true
    }
}

// Bindings read these two themselves.
impl Value for Option<Within> {}
impl Value for usize {}
