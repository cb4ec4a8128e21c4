//! What can be asked of a cloud: from one viewpoint, one after another, divided among
//! threads, from several, along a direction, in parts, as a surface, as light, with noise.

pub(crate) mod denoise;
pub(crate) mod direction;
pub(crate) mod illumination;
pub(crate) mod looks;
pub(crate) mod merge;
pub(crate) mod observer;
pub(crate) mod reconstruct;
pub(crate) mod sample;
pub(crate) mod sector;
pub(crate) mod union;
pub(crate) mod visibility;
