//! From where a cloud is seen.

use crate::view::camera::Camera;

/// A viewpoint, which looks everywhere, or a camera, which sees only what is in its image. Points outside of the image
/// still hide others.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(
    clippy::large_enum_variant,
    reason = "seats are few, and a box is not Copy"
)]
pub enum Seat {
    /// A viewpoint.
    Viewpoint([f64; 3]),
    /// A camera.
    Camera(Camera),
}

impl Seat {
    /// Its place, in the cloud's coordinates.
    #[must_use]
    pub fn position(&self) -> [f64; 3] {
        match self {
            Self::Viewpoint(place) => *place,
            Self::Camera(camera) => camera.position(),
        }
    }
}

impl From<[f64; 3]> for Seat {
    fn from(viewpoint: [f64; 3]) -> Self {
        Self::Viewpoint(viewpoint)
    }
}

impl From<Camera> for Seat {
    fn from(camera: Camera) -> Self {
        Self::Camera(camera)
    }
}
