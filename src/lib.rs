//! Which points of a point cloud can be seen from here?
//!
//! Hidden-point removal without a surface, normals or a screen: the HPR operator
//! of S. Katz, A. Tal and R. Basri, "Direct Visibility of Point Sets", ACM
//! Transactions on Graphics 26(3), 2007. Points are flipped on a sphere around
//! the viewpoint; those on the convex hull of the flipped cloud and the
//! viewpoint are visible.
//!
//! ```
//! use hidden_point_removal::{Options, PointCloud};
//!
//! let positions = [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [1.0, 0.0, 0.0]];
//! let cloud = PointCloud::new(&positions)?;
//! let visible = cloud.visible_from([0.0, 0.0, 5.0], &Options::default())?;
//! assert_eq!(visible.indices(), [0, 2]);
//! # Ok::<(), hidden_point_removal::Error>(())
//! ```
//!
//! Answers are exact for the flipped points as rounded to `f64`: every sign
//! comes from an adaptive exact predicate, so native code, WebAssembly and
//! `no_std` builds give the same bits.
//!
//! # Features
//! - `std` (default): threads, and the platform's square root. Without it the
//!   crate needs only `alloc`; answers are the same.
//! - `higher` (default): clouds of four and more dimensions.
//! - `wasm`: the JavaScript bindings of the npm package; not a Rust API. `lite`: those of its small
//!   module, which holds the operator alone.
#![no_std]
#![cfg_attr(not(feature = "lite"), forbid(unsafe_code))]
#![warn(missing_docs)]

extern crate alloc;
#[cfg(feature = "std")]
extern crate std;

mod answers;
mod base;
mod cloud;
#[cfg(feature = "higher")]
mod dimensions;
mod flip;
mod hull;
mod view;
#[cfg(feature = "lite")]
mod wasm;

pub use answers::calibration::{Calibration, Station};
pub use answers::camera::CameraView;
pub use answers::horizon::Horizon;
pub use answers::illumination::Lighting;
pub use answers::merge::{merge_visible, merge_visible_u64};
pub use answers::observer::Observer;
pub use answers::panorama::{Panorama, PanoramaOptions};
pub use answers::placement::{Choice, Placement, Placing};
pub use answers::reconstruct::Reconstruction;
pub use answers::several::ring_of_viewpoints;
#[cfg(feature = "std")]
pub use answers::threads::Threads;
pub use answers::transfer::{
    Image, Merge, Pixels, Sampling, Transfer, TransferOptions, Transferred, Values, Weights,
};
pub use answers::visibility::Visibility;
pub use answers::visibility_map::{MapOptions, VisibilityMap};
pub use base::MAX_POINTS;
#[cfg(feature = "stop")]
#[doc(hidden)]
pub use base::beat::{Stopped, stop, stop_by};
pub use base::error::Error;
pub use cloud::noise::Surface;
pub use cloud::point_cloud::{NonFinite, PointCloud};
pub use cloud::points::Position;
pub use cloud::selection::Within;
#[cfg(feature = "higher")]
pub use dimensions::{MAX_DIMENSION, PointCloudNd};
pub use view::camera::Seat;
pub use view::camera::{Camera, Convention, Pose};
pub use view::distortion::CameraModel;
pub use view::guarantees::{permissible_curvature, radius_bound};
pub use view::options::{Exponential, Inversion, Options, Radius};
pub use view::radius::ChosenRadius;

/// The documents' Rust snippets, as documentation tests.
#[cfg(doctest)]
mod documents {
    #[doc = include_str!("../README.md")]
    struct Readme;
    #[doc = include_str!("../docs/API.md")]
    struct Api;
}
