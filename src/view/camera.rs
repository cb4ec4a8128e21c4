//! A real camera: where a point appears in its image, and whether it is inside.

use glam::DVec3;

use crate::base::error::Error;
use crate::base::real::square_root;

/// The axes of a camera.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Convention {
    /// x to the right, y down, z forward.
    #[default]
    OpenCv,
    /// x to the right, y up, z backward.
    OpenGl,
}

/// A camera's place and its axes: 16 numbers, column by column, a rotation and a translation, to
/// within 10⁻⁵.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pose {
    /// From the camera's space to the cloud's.
    CameraToWorld([f64; 16]),
    /// From the cloud's space to the camera's: the inverse, as COLMAP and OpenCV keep it.
    WorldToCamera([f64; 16]),
}

impl Pose {
    /// From the camera's space to the cloud's. The last row stays, for the check.
    pub(crate) fn camera_to_world(self) -> [f64; 16] {
        match self {
            Self::CameraToWorld(matrix) => matrix,
            Self::WorldToCamera(matrix) => inverse(matrix),
        }
    }
}

/// The inverse of a rotation and a translation.
fn inverse(m: [f64; 16]) -> [f64; 16] {
    let place = |i: usize| -(m[i] * m[12] + m[i + 1] * m[13] + m[i + 2] * m[14]);
    let (x, y, z) = (place(0), place(4), place(8));
    [
        m[0], m[4], m[8], m[3], m[1], m[5], m[9], m[7], m[2], m[6], m[10], m[11], x, y, z, m[15],
    ]
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
    /// OpenCV's k1, k2, p1, p2, k3. Beyond the radius where the radial part stops growing, points
    /// are outside.
    pub distortion: [f64; 5],
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
            distortion: [0.0; 5],
            near: 0.0,
            far: f64::INFINITY,
        }
    }

    /// The camera with these numbers: its pose as camera to world, fx, fy, cx, cy, width, height, distortion, near,
    /// far, and 1 for OpenGL's axes.
    #[cfg(feature = "wasm")]
    #[inline(never)]
    pub(crate) fn of(numbers: &[f64; 30]) -> Self {
        let mut camera = Self::new(0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
        let mut matrix = [0.0; 16];
        matrix.copy_from_slice(&numbers[..16]);
        camera.pose = Pose::CameraToWorld(matrix);
        camera.distortion.copy_from_slice(&numbers[22..27]);
        [camera.fx, camera.fy, camera.cx, camera.cy] =
            [numbers[16], numbers[17], numbers[18], numbers[19]];
        [camera.width, camera.height, camera.near, camera.far] =
            [numbers[20], numbers[21], numbers[27], numbers[28]];
        if numbers[29] != 0.0 {
            camera.convention = Convention::OpenGl;
        }
        camera
    }

    /// The camera's place, in the cloud's coordinates.
    #[must_use]
    pub fn position(&self) -> [f64; 3] {
        let matrix = self.pose.camera_to_world();
        [matrix[12], matrix[13], matrix[14]]
    }

    /// The camera, ready to project points.
    pub(crate) fn lens(&self) -> Result<Lens<'_>, Error> {
        let infinity = f64::INFINITY;
        let least = f64::MIN_POSITIVE;
        let matrix = self.pose.camera_to_world();
        if let Some(&value) = matrix.iter().find(|x| !x.is_finite()) {
            let problem = "pose must be finite";
            return Err(Error::Camera { problem, value });
        }
        let axes = [0, 4, 8].map(|from| DVec3::from_slice(&matrix[from..from + 3]));
        let deviation = deviation(axes, &matrix);
        let largest = f64::MAX;
        let mut limits = [
            (
                "pose must be a rotation and a translation, to within 1e-5",
                deviation,
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
        ]
        .into_iter()
        .chain(
            self.distortion
                .map(|value| ("distortion must be finite", value, -largest, largest)),
        );
        // The range also refuses a NaN.
        let wrong = limits.find(|(_, value, least, most)| !(least..=most).contains(&value));
        if let Some((problem, value, ..)) = wrong {
            return Err(Error::Camera { problem, value });
        }
        let [k1, k2, _, _, k3] = self.distortion;
        let [x, y, z] = axes;
        Ok(Lens {
            camera: self,
            place: DVec3::from_slice(&matrix[12..15]),
            axes: match self.convention {
                Convention::OpenCv => axes,
                Convention::OpenGl => [x, -y, -z],
            },
            limit: first_zero([1.0, 3.0 * k1, 5.0 * k2, 7.0 * k3]),
        })
    }
}

/// How far a matrix may be from a rigid one.
const RIGID: f64 = 1e-5;

/// The largest deviation from a rotation and a translation; at least 2 for a reflection.
fn deviation([x, y, z]: [DVec3; 3], matrix: &[f64; 16]) -> f64 {
    let mut most = (x.cross(y).dot(z) - 1.0).abs();
    let lengths = [x.dot(x) - 1.0, y.dot(y) - 1.0, z.dot(z) - 1.0];
    let angles = [x.dot(y), y.dot(z), z.dot(x)];
    let last = [matrix[3], matrix[7], matrix[11], matrix[15] - 1.0];
    for value in lengths.into_iter().chain(angles).chain(last) {
        let size = value.abs();
        // Not `max`, which drops a NaN.
        if size > most || size.is_nan() {
            most = size;
        }
    }
    most
}

/// A camera that was checked.
pub(crate) struct Lens<'a> {
    camera: &'a Camera,
    place: DVec3,
    /// To the right, down and forward.
    axes: [DVec3; 3],
    /// The square of the undistorted radius from which on the distortion does not grow.
    limit: f64,
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
        let (x, y) = (x / depth, y / depth);
        let squared = x * x + y * y;
        if squared >= self.limit || squared.is_nan() {
            return OUTSIDE;
        }
        let [k1, k2, p1, p2, k3] = camera.distortion;
        let radial = 1.0 + squared * (k1 + squared * (k2 + squared * k3));
        let both = 2.0 * x * y;
        let across = x * radial + p1 * both + p2 * (squared + 2.0 * x * x);
        let down = y * radial + p2 * both + p1 * (squared + 2.0 * y * y);
        let u = camera.fx * across + camera.cx;
        let v = camera.fy * down + camera.cy;
        let is_inside = 0.0 <= u && u < camera.width && 0.0 <= v && v < camera.height;
        if is_inside { ([u, v], depth) } else { OUTSIDE }
    }

    /// The direction of length 1 from a point to the camera.
    pub(crate) fn towards(&self, p: [f64; 3]) -> [f32; 3] {
        let v = self.place - DVec3::from_array(p);
        v.normalize_or_zero().as_vec3().to_array()
    }
}

/// The first positive zero of a cubic that is 1 at 0, by its coefficients from low to high;
/// infinite if there is none.
fn first_zero([a, b, c, d]: [f64; 4]) -> f64 {
    /// No image reaches that far.
    const LARGEST: f64 = 1e30;
    let value = |x: f64| a + x * (b + x * (c + x * d));
    let mut low = 0.0;
    // Between its extremes and beyond them the cubic is monotone.
    for end in extremes(b, 2.0 * c, 3.0 * d) {
        if end > low && end < LARGEST {
            if value(end) <= 0.0 {
                return bisected(low, end, &value);
            }
            low = end;
        }
    }
    let mut high = (2.0f64 * low).max(1.0);
    while high < LARGEST {
        if value(high) <= 0.0 {
            return bisected(low, high, &value);
        }
        high *= 2.0;
    }
    f64::INFINITY
}

/// The real zeros of a + b·x + c·x², ascending; NaN where there are none.
fn extremes(a: f64, b: f64, c: f64) -> [f64; 2] {
    if c == 0.0 {
        return [-a / b, f64::NAN];
    }
    let half = -0.5 * b;
    let root = square_root(half * half - a * c);
    // The sum of equal signs loses no digits.
    let sum = half + root.copysign(half);
    let (one, other) = (sum / c, a / sum);
    if one < other {
        [one, other]
    } else {
        [other, one]
    }
}

fn bisected(mut low: f64, mut high: f64, value: &dyn Fn(f64) -> f64) -> f64 {
    loop {
        let middle = low + 0.5 * (high - low);
        if middle <= low || middle >= high {
            return high;
        }
        if value(middle) <= 0.0 {
            high = middle;
        } else {
            low = middle;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_zero_of_a_cubic_is_found() {
        let is_near = |x: f64, y: f64| (x - y).abs() <= 1e-12 * y;
        assert!(is_near(first_zero([1.0, -0.5, 0.0, 0.0]), 2.0));
        assert!(is_near(first_zero([1.0, -1.25, 0.25, 0.0]), 1.0));
        // (1 − x)(1 − x/2)(1 − x/3), and one zero only.
        let cubic = [1.0, -11.0 / 6.0, 1.0, -1.0 / 6.0];
        assert!(is_near(first_zero(cubic), 1.0));
        assert!(is_near(first_zero([1.0, 1.0, 1.0, -3.0]), 1.0));
        for positive in [
            [1.0, 0.0, 0.0, 0.0],
            [1.0, 3.0, 2.0, 1.0],
            [1.0, -1.0, 1.0, 0.0],
            [1.0, -1.0, 0.5, 0.1],
        ] {
            assert_eq!(first_zero(positive), f64::INFINITY, "{positive:?}");
        }
    }

    #[test]
    fn the_first_zero_is_found_wherever_the_others_are() {
        let none = f64::INFINITY;
        for zeros in [
            [1.2, 1.5, none],
            [1.2, 1.5, 1.7],
            [1.2, 1.5, -3.0],
            [-0.3, -2.0, 40.0],
            [-0.5, 0.25, 0.26],
            [0.7, none, none],
            [-1.0, -2.0, none],
            [3e4, 4e5, -1.0],
        ] {
            // The product of 1 - x/z over the zeros.
            let [a, b, c] = zeros.map(|z| -1.0 / z);
            let found = first_zero([1.0, a + b + c, a * b + b * c + c * a, a * b * c]);
            let first = zeros.into_iter().filter(|z| *z > 0.0).fold(none, f64::min);
            assert!(
                found == first || (found / first - 1.0).abs() < 1e-9,
                "{zeros:?}: {found}"
            );
        }
        assert_eq!(first_zero([1.0, 0.0, 0.0, 0.0]), none);
    }
}
