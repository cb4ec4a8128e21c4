//! All questions to a cloud. A view can be from one viewpoint, from one after another, from
//! several at once, along a direction, or divided among threads. A cloud can be in parts or
//! noisy, and only a part of it may take part. The answer can also be a surface, light, or an image of ranges.

pub(crate) mod calibration;
pub(crate) mod camera;
pub(crate) mod denoise;
pub(crate) mod direction;
pub(crate) mod horizon;
pub(crate) mod illumination;
pub(crate) mod looks;
pub(crate) mod memory;
pub(crate) mod merge;
pub(crate) mod observer;
pub(crate) mod panorama;
pub(crate) mod part;
pub(crate) mod placement;
pub(crate) mod reconstruct;
pub(crate) mod sees;
pub(crate) mod several;
pub(crate) mod threads;
pub(crate) mod transfer;
pub(crate) mod visibility;
pub(crate) mod visibility_map;
