//! A viewpoint and options, checked and resolved to one flip: the radius is given, computed
//! or searched. The paper's bounds on it stand in `radius`.

pub(crate) mod camera;
pub(crate) mod distortion;
pub(crate) mod options;
pub(crate) mod radius;
pub(crate) mod refusals;
pub(crate) mod resolved;
