//! Everything about the points that does not depend on a viewpoint: positions as given, the
//! canonical order along a Hilbert curve, nearest neighbors, statistics, the sampling of the
//! surface, its noise, spheres around blocks, choices of points.

pub(crate) mod blocks;
pub(crate) mod filling;
pub(crate) mod hilbert;
pub(crate) mod neighbors;
pub(crate) mod noise;
pub(crate) mod plane;
pub(crate) mod point_cloud;
pub(crate) mod points;
pub(crate) mod quadric;
pub(crate) mod selection;
pub(crate) mod sequence;
pub(crate) mod sheets;
pub(crate) mod spatial;
pub(crate) mod statistics;
pub(crate) mod surface;
