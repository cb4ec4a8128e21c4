//! A real camera: where a point appears in its image, and whether it is inside.

use crate::base::error::Error;
use crate::base::real::{larger, square_root};
use crate::view::distortion::{CameraModel, Distortion};
use glam::{DMat3, DVec3};

/// The axes of a camera.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Convention {
    /// x to the right, y down, z forward.
    #[default]
    OpenCv,
    /// x to the right, y up, z backward.
    OpenGl,
}

/// A camera's place and its axes: 16 numbers, column by column, a rotation and a translation, to
/// within 10⁻³. The nearest rotation is taken: poses in text files are rounded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pose {
    /// From the camera's space to the cloud's.
    CameraToWorld([f64; 16]),
    /// From the cloud's space to the camera's: the inverse, as COLMAP and OpenCV keep it.
    WorldToCamera([f64; 16]),
}

impl Pose {
    /// The camera's axes and its place, in the cloud's coordinates.
    fn rigid(self) -> ([DVec3; 3], DVec3) {
        let (Self::CameraToWorld(matrix) | Self::WorldToCamera(matrix)) = self;
        let [x, y, z, place] = [0, 4, 8, 12].map(|from| DVec3::from_slice(&matrix[from..from + 3]));
        let axes = rotation([x, y, z]);
        match self {
            Self::CameraToWorld(_) => (axes, place),
            Self::WorldToCamera(_) => {
                let [x, y, z] = axes;
                let turned = DMat3::from_cols(x, y, z).transpose();
                (
                    [turned.x_axis, turned.y_axis, turned.z_axis],
                    -(turned * place),
                )
            }
        }
    }

    /// The same numbers, taken the other way round.
    pub(crate) fn inverted(self) -> Self {
        match self {
            Self::CameraToWorld(matrix) => Self::WorldToCamera(matrix),
            Self::WorldToCamera(matrix) => Self::CameraToWorld(matrix),
        }
    }
}

/// The rotation nearest to axes that nearly are one.
fn rotation(mut axes: [DVec3; 3]) -> [DVec3; 3] {
    // Each step squares the deviation. Axes that are orthonormal except for rounding stay as they are.
    for _ in 0..3 {
        if deviation(axes) < 1e-14 {
            break;
        }
        let [x, y, z] = axes;
        let volume = x.cross(y).dot(z);
        let step = |axis: DVec3, across: DVec3| 0.5 * (axis + across / volume);
        axes = [
            step(x, y.cross(z)),
            step(y, z.cross(x)),
            step(z, x.cross(y)),
        ];
    }
    axes
}

/// A pinhole camera, with the distortion of its lens if there is one. A point at (x, y, z), with x
/// to the right, y down and z forward, appears at u = fx·x/z + cx and v = fy·y/z + cy. There is no
/// shift by half a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Its place and its axes.
    pub pose: Pose,
    /// The axes of the camera's space.
    pub convention: Convention,
    /// The focal length across, in pixels.
    pub fx: f64,
    /// The focal length down, in pixels.
    pub fy: f64,
    /// The principal point across, in pixels.
    pub cx: f64,
    /// The principal point down, in pixels.
    pub cy: f64,
    /// The image's width. A point is inside if 0 ≤ u < width.
    pub width: f64,
    /// The image's height. A point is inside if 0 ≤ v < height.
    pub height: f64,
    /// The model of the lens.
    pub model: CameraModel,
    /// The coefficients as the model lists them, then zeros. Beyond the radius where the radial part
    /// stops growing, points are outside.
    pub distortion: [f64; 8],
    /// The least depth along the optical axis; at least 0.
    pub near: f64,
    /// The largest depth; infinite where there is none.
    pub far: f64,
}

impl Camera {
    /// A camera without distortion and without limits of depth, at the origin.
    #[must_use]
    pub fn new(fx: f64, fy: f64, cx: f64, cy: f64, width: f64, height: f64) -> Self {
        let mut matrix = [0.0; 16];
        (0..4).for_each(|axis| matrix[5 * axis] = 1.0);
        Self {
            pose: Pose::CameraToWorld(matrix),
            convention: Convention::OpenCv,
            fx,
            fy,
            cx,
            cy,
            width,
            height,
            model: CameraModel::default(),
            distortion: [0.0; 8],
            near: 0.0,
            far: f64::INFINITY,
        }
    }

    /// The camera with these numbers: its pose, fx, fy, cx, cy, width, height, 8 coefficients of distortion, near,
    /// far, 1 for OpenGL's axes, COLMAP's number of the model, and 1 for a pose from the world to the camera.
    #[cfg(feature = "wasm")]
    #[inline(never)]
    pub(crate) fn of(numbers: &[f64; 35]) -> Self {
        let mut camera = Self::new(0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
        let mut matrix = [0.0; 16];
        matrix.copy_from_slice(&numbers[..16]);
        camera.pose = if numbers[34] == 0.0 {
            Pose::CameraToWorld(matrix)
        } else {
            Pose::WorldToCamera(matrix)
        };
        camera.distortion.copy_from_slice(&numbers[22..30]);
        [camera.fx, camera.fy, camera.cx, camera.cy] =
            [numbers[16], numbers[17], numbers[18], numbers[19]];
        [camera.width, camera.height, camera.near, camera.far] =
            [numbers[20], numbers[21], numbers[30], numbers[31]];
        if numbers[32] != 0.0 {
            camera.convention = Convention::OpenGl;
        }
        let model = CameraModel::ALL.get(numbers[33] as usize);
        camera.model = model.copied().unwrap_or_default();
        camera
    }

    /// The camera's place, in the cloud's coordinates.
    #[must_use]
    pub fn position(&self) -> [f64; 3] {
        self.pose.rigid().1.to_array()
    }

    /// Refuses what every question refuses. It tells which of many cameras that is.
    ///
    /// # Errors
    /// [`Error::Camera`].
    pub fn check(&self) -> Result<(), Error> {
        self.lens().map(|_| ())
    }

    /// The cone around the camera's image, for [`MapOptions::towards`](crate::MapOptions::towards): its axis, and its
    /// full opening in degrees. The image of a strongly distorted lens may reach beyond it.
    ///
    /// # Errors
    /// [`Error::Camera`].
    pub fn cone(&self) -> Result<([f64; 3], f64), Error> {
        let lens = self.lens()?;
        let half = |size: f64, middle: f64, focal: f64| {
            larger(middle.abs(), (size - middle).abs()) / focal
        };
        let across = half(self.width, self.cx, self.fx);
        let down = half(self.height, self.cy, self.fy);
        let mut wide = square_root(across * across + down * down);
        if self.distortion != [0.0; 8] {
            wide *= DISTORTED;
        }
        if lens.distortion.bends() {
            wide = f64::INFINITY;
        }
        // An angle of 0 is no cone.
        let angle = larger(2.0 * libm::atan(wide).to_degrees(), f64::MIN_POSITIVE);
        Ok((lens.axes[2].to_array(), angle))
    }

    /// The camera, ready to project points.
    pub(crate) fn lens(&self) -> Result<Lens<'_>, Error> {
        let infinity = f64::INFINITY;
        let least = f64::MIN_POSITIVE;
        let (Pose::CameraToWorld(matrix) | Pose::WorldToCamera(matrix)) = self.pose;
        if let Some(&value) = matrix.iter().find(|x| !x.is_finite()) {
            let problem = "pose must be finite";
            return Err(Error::Camera { problem, value });
        }
        let given = [0, 4, 8].map(|from| DVec3::from_slice(&matrix[from..from + 3]));
        let last = [matrix[3], matrix[7], matrix[11], matrix[15] - 1.0];
        let largest = f64::MAX;
        let limits = [
            (
                "pose must be a rotation and a translation, to within 1e-5",
                most(deviation(given), last),
                0.0,
                RIGID,
            ),
            ("fx must be finite and positive", self.fx, least, largest),
            ("fy must be finite and positive", self.fy, least, largest),
            (
                "width must be finite and positive",
                self.width,
                least,
                largest,
            ),
            (
                "height must be finite and positive",
                self.height,
                least,
                largest,
            ),
            ("cx must be finite", self.cx, -largest, largest),
            ("cy must be finite", self.cy, -largest, largest),
            (
                "near must be finite and at least 0",
                self.near,
                0.0,
                largest,
            ),
            ("far must be at least near", self.far, self.near, infinity),
        ];
        // The range also refuses a NaN.
        let mut limits = limits.into_iter();
        let wrong = limits.find(|(_, value, least, most)| !(least..=most).contains(&value));
        if let Some((problem, value, ..)) = wrong {
            return Err(Error::Camera { problem, value });
        }
        let (axes, place) = self.pose.rigid();
        let [x, y, z] = axes;
        Ok(Lens {
            camera: self,
            place,
            axes: match self.convention {
                Convention::OpenCv => axes,
                Convention::OpenGl => [x, -y, -z],
            },
            distortion: Distortion::new(self.model, &self.distortion)?,
        })
    }
}

/// How much wider the image of a distorted lens may be.
const DISTORTED: f64 = 1.3;

/// How far a matrix may be from a rigid one: several roundings to single precision.
const RIGID: f64 = 1e-5;

/// The largest deviation from a rotation; at least 2 for a reflection.
fn deviation([x, y, z]: [DVec3; 3]) -> f64 {
    let volume = x.cross(y).dot(z) - 1.0;
    let lengths = [x.dot(x) - 1.0, y.dot(y) - 1.0, z.dot(z) - 1.0];
    most(most(volume.abs(), lengths), [x.dot(y), y.dot(z), z.dot(x)])
}

/// The largest size of these numbers. Not `max`, which drops a NaN.
fn most<const N: usize>(first: f64, values: [f64; N]) -> f64 {
    values.into_iter().fold(first, |most, value| {
        let size = value.abs();
        if size > most || size.is_nan() {
            size
        } else {
            most
        }
    })
}

/// A camera that was checked.
pub(crate) struct Lens<'a> {
    camera: &'a Camera,
    place: DVec3,
    /// To the right, down and forward.
    axes: [DVec3; 3],
    distortion: Distortion,
}

impl Lens<'_> {
    /// Where the image shows a point, and its depth. All are 0 for a point outside of the image.
    pub(crate) fn project(&self, p: [f64; 3]) -> ([f64; 2], f64) {
        const OUTSIDE: ([f64; 2], f64) = ([0.0; 2], 0.0);
        let camera = self.camera;
        let v = DVec3::from_array(p) - self.place;
        let [x, y, depth] = self.axes.map(|axis| axis.dot(v));
        if !(depth > 0.0 && camera.near <= depth && depth <= camera.far) {
            return OUTSIDE;
        }
        let Some([across, down]) = self.distortion.apply(x / depth, y / depth) else {
            return OUTSIDE;
        };
        let u = camera.fx * across + camera.cx;
        let v = camera.fy * down + camera.cy;
        let is_inside = 0.0 <= u && u < camera.width && 0.0 <= v && v < camera.height;
        if is_inside { ([u, v], depth) } else { OUTSIDE }
    }

    /// The optical axis.
    pub(crate) fn ahead(&self) -> DVec3 {
        self.axes[2]
    }

    /// The direction of length 1 from a point to the camera.
    pub(crate) fn towards(&self, p: [f64; 3]) -> [f32; 3] {
        let v = self.place - DVec3::from_array(p);
        v.normalize_or_zero().as_vec3().to_array()
    }
}

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
