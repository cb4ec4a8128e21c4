//! Cameras, and where they show points, in plain numbers: without the crate's code.

use hidden_point_removal::{Camera, Convention, Pose};

use super::rng::Rng;

fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    v.map(|x| x / length)
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// The numbers of a pose from the camera to the world.
pub fn matrix(camera: &mut Camera) -> &mut [f64; 16] {
    match &mut camera.pose {
        Pose::CameraToWorld(matrix) | Pose::WorldToCamera(matrix) => matrix,
    }
}

/// A camera at `from` that looks in the direction `ahead`, turned by chance around it.
pub fn camera(rng: &mut Rng, from: [f64; 3], ahead: [f64; 3], convention: Convention) -> Camera {
    let ahead = unit(ahead);
    let right = unit(cross(ahead, rng.direction()));
    with_axes(from, [right, cross(ahead, right), ahead], convention)
}

/// A camera whose axes are those of the coordinates, in some order and with some signs.
pub fn along_axes(rng: &mut Rng, from: [f64; 3], convention: Convention) -> Camera {
    let mut axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    rng.shuffle(&mut axes);
    let [right, down] = [axes[0], axes[1]].map(|axis| {
        let sign = rng.pick(&[1.0, -1.0]);
        axis.map(|x| sign * x)
    });
    with_axes(from, [right, down, cross(right, down)], convention)
}

fn with_axes(
    from: [f64; 3],
    [right, down, ahead]: [[f64; 3]; 3],
    convention: Convention,
) -> Camera {
    let axes = match convention {
        Convention::OpenCv => [right, down, ahead],
        Convention::OpenGl => [right, down.map(|x| -x), ahead.map(|x| -x)],
    };
    let mut camera = Camera::new(500.0, 510.0, 310.0, 245.0, 640.0, 480.0);
    camera.convention = convention;
    for (column, axis) in axes.into_iter().chain([from]).enumerate() {
        matrix(&mut camera)[4 * column..4 * column + 3].copy_from_slice(&axis);
    }
    camera
}

/// Where a camera shows a point.
#[derive(Clone, Copy, Debug)]
pub struct Shown {
    pub inside: bool,
    pub pixel: [f64; 2],
    pub depth: f64,
    /// Another order of the same operations could decide otherwise. Never without distortion: there, the
    /// order is that of the formula.
    pub in_doubt: bool,
}

/// The depth of a point along the optical axis, after its coordinates across and down.
pub fn in_camera(camera: &Camera, p: [f64; 3]) -> [f64; 3] {
    let Pose::CameraToWorld(m) = camera.pose else {
        unreachable!("all cameras here are made so");
    };
    let v: [f64; 3] = core::array::from_fn(|i| p[i] - m[12 + i]);
    let [x, y, z] = [0, 4, 8].map(|c| m[c] * v[0] + m[c + 1] * v[1] + m[c + 2] * v[2]);
    match camera.convention {
        Convention::OpenCv => [x, y, z],
        Convention::OpenGl => [x, -y, -z],
    }
}

/// The projection of OpenCV, with its distortion.
pub fn shown(camera: &Camera, p: [f64; 3]) -> Shown {
    let [x, y, depth] = in_camera(camera, p);
    let outside = Shown {
        inside: false,
        pixel: [0.0; 2],
        depth,
        in_doubt: false,
    };
    if depth <= 0.0 || depth < camera.near || depth > camera.far {
        return outside;
    }
    let (a, b) = (x / depth, y / depth);
    let r2 = a * a + b * b;
    if !r2.is_finite() {
        return outside;
    }
    let [k1, k2, p1, p2, k3] = camera.distortion;
    let is_distorted = camera.distortion != [0.0; 5];
    // The radial part must grow all the way from the middle.
    let steps = if is_distorted { 2000 } else { 0 };
    let slope = |s: f64| 1.0 + 3.0 * k1 * s + 5.0 * k2 * s * s + 7.0 * k3 * s * s * s;
    let slopes = (0..=steps).map(|step| slope(r2 * f64::from(step) / f64::from(steps.max(1))));
    let least = if is_distorted {
        slopes.fold(f64::INFINITY, f64::min)
    } else {
        1.0
    };
    let radial = 1.0 + k1 * r2 + k2 * r2 * r2 + k3 * r2 * r2 * r2;
    let u = a * radial + 2.0 * p1 * a * b + p2 * (r2 + 2.0 * a * a);
    let w = b * radial + p1 * (r2 + 2.0 * b * b) + 2.0 * p2 * a * b;
    let (u, w) = (camera.fx * u + camera.cx, camera.fy * w + camera.cy);
    let is_near = |x: f64, end: f64| x.abs().min((x - end).abs()) <= 1e-9 * (end + x.abs());
    Shown {
        inside: least > 0.0 && 0.0 <= u && u < camera.width && 0.0 <= w && w < camera.height,
        pixel: [u, w],
        depth,
        in_doubt: is_distorted
            && (least.abs() < 0.01 || is_near(u, camera.width) || is_near(w, camera.height)),
    }
}
