//! A viewpoint and options, checked and resolved to one flip: the radius is given, computed
//! or searched. The paper's bounds on it stand in `guarantees`.

pub(crate) mod camera;
pub(crate) mod choice;
pub(crate) mod distortion;
pub(crate) mod guarantees;
pub(crate) mod options;
pub(crate) mod radius;
pub(crate) mod refusals;
pub(crate) mod resolved;
