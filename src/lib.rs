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
//! Other questions of the same cloud: three looks, what a camera sees in which pixel, how many
//! viewpoints see each point, places beside the cloud, threads, and clouds in parts:
//!
//! ```
//! # use hidden_point_removal::*;
//! let looks = Options::looks(3).with_scores(true);
//! let positions: Vec<[f64; 3]> = (0..900)
//!     .map(|i| [f64::from(i % 30), f64::from(i / 30), f64::from(i % 7) / 9.0])
//!     .collect();
//! let cloud = PointCloud::new(&positions)?;
//! let visible = cloud.visible_from([15.0, 15.0, 40.0], &looks)?;
//! assert_eq!(visible.scores().len(), cloud.len());
//!
//! let mut camera = Camera::new(400.0, 400.0, 320.0, 240.0, 640.0, 480.0);
//! // Column by column: where x (to the right), y (down) and z (forward) point, and the camera's place.
//! camera.pose = Pose::CameraToWorld([
//!     1.0, 0.0, 0.0, 0.0, /**/ 0.0, -1.0, 0.0, 0.0, /**/ 0.0, 0.0, -1.0, 0.0, /**/ 15.0, 15.0, 40.0, 1.0,
//! ]);
//! let view = cloud.visible_from_camera(&camera, &Options::looks(3))?;
//! assert_eq!(view.pixels.len(), view.visibility.indices().len());
//!
//! let ring = [[99.0, 0.0, 40.0], [0.0, 99.0, 40.0]];
//! let counts = cloud.coverage(&ring, &Options::default().with_threads(2))?;
//! assert!(counts.iter().all(|&count| count <= 2));
//! let is_seen = cloud.sees([15.0, 15.0, 40.0], &[[15.0, 15.0, 9.0]], &Options::looks(3))?;
//! assert_eq!(is_seen, [true]);
//!
//! // Each part with ids of its own; R is that of the whole cloud.
//! let (ids, options) = ((0..900).collect::<Vec<u64>>(), Options::radius(500.0));
//! let parts = [(&positions[..450], &ids[..450]), (&positions[450..], &ids[450..])];
//! let merged = merge_visible_u64(&parts, [15.0, 15.0, 40.0], &options)?;
//! assert_eq!(merged.len(), cloud.visible_from([15.0, 15.0, 40.0], &options)?.indices().len());
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
pub use answers::camera::{Image, Pixels};
pub use answers::horizon::Horizon;
pub use answers::illumination::Lighting;
pub use answers::merge::{merge_visible, merge_visible_u64};
pub use answers::observer::Observer;
pub use answers::panorama::{Panorama, PanoramaOptions};
pub use answers::placement::{Choice, Placement, Placing};
pub use answers::reconstruct::Reconstruction;
pub use answers::several::ring_of_viewpoints;
pub use answers::transfer::{
    Merge, Sampling, Transfer, TransferOptions, Transferred, Values, Weights,
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
#[doc(hidden)]
pub use view::options::Given;
pub use view::options::{Exponential, Inversion, Options, Radius};
pub use view::radius::ChosenRadius;
pub use view::radius::{permissible_curvature, radius_bound};

/// The documents' Rust snippets, as documentation tests.
#[cfg(doctest)]
mod documents {
    #[doc = include_str!("../README.md")]
    struct Readme;
    #[doc = include_str!("../docs/API.md")]
    struct Api;
}
