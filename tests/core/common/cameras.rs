//! Cameras, and where they show points, in plain numbers: without the crate's code.

use hidden_point_removal::{Camera, CameraModel, Convention, Pose};

use super::cross;
use super::rng::Rng;

fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    v.map(|x| x / length)
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
        other => unreachable!("{other:?}"),
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
        other => unreachable!("{other:?}"),
    }
}

fn is_fisheye(model: CameraModel) -> bool {
    model.name().contains("FISHEYE")
}

/// The factor by which the radius changes; for a fisheye lens, the angle.
fn radial(camera: &Camera, r: f64) -> f64 {
    let c = camera.distortion;
    let s = r * r;
    match camera.model {
        CameraModel::SimplePinhole | CameraModel::Pinhole => 1.0,
        CameraModel::SimpleRadial | CameraModel::SimpleRadialFisheye => 1.0 + c[0] * s,
        CameraModel::Radial | CameraModel::RadialFisheye => 1.0 + c[0] * s + c[1] * s * s,
        CameraModel::OpenCv => 1.0 + c[0] * s + c[1] * s * s + c[4] * s * s * s,
        CameraModel::OpenCvFisheye => {
            1.0 + c[0] * s + c[1] * s * s + c[2] * s * s * s + c[3] * s * s * s * s
        }
        CameraModel::FullOpenCv => {
            (1.0 + c[0] * s + c[1] * s * s + c[4] * s * s * s)
                / (1.0 + c[5] * s + c[6] * s * s + c[7] * s * s * s)
        }
        CameraModel::Fov if c[0] == 0.0 || r == 0.0 => 1.0,
        CameraModel::Fov => (2.0 * r * (0.5 * c[0]).tan()).atan() / (r * c[0]),
        CameraModel::ThinPrismFisheye => {
            1.0 + c[0] * s + c[1] * s * s + c[4] * s * s * s + c[5] * s * s * s * s
        }
    }
}

/// Where a lens shows the point a, b of the plane at depth 1: the formulas of OpenCV and COLMAP.
fn distorted(camera: &Camera, a: f64, b: f64) -> [f64; 2] {
    let c = camera.distortion;
    let r = (a * a + b * b).sqrt();
    let (a, b) = if is_fisheye(camera.model) && r > 0.0 {
        (a * r.atan() / r, b * r.atan() / r)
    } else {
        (a, b)
    };
    let r2 = a * a + b * b;
    let factor = radial(camera, r2.sqrt());
    let (u, w) = (a * factor, b * factor);
    let tangential = [
        2.0 * c[2] * a * b + c[3] * (r2 + 2.0 * a * a),
        2.0 * c[3] * a * b + c[2] * (r2 + 2.0 * b * b),
    ];
    match camera.model {
        CameraModel::OpenCv | CameraModel::FullOpenCv => [u + tangential[0], w + tangential[1]],
        CameraModel::ThinPrismFisheye => {
            [u + tangential[0] + c[6] * r2, w + tangential[1] + c[7] * r2]
        }
        _ => [u, w],
    }
}

/// Lenses of every model. Some stop growing within the image.
#[rustfmt::skip]
pub const LENSES: [(CameraModel, [f64; 8]); 19] = [
    (CameraModel::OpenCv, [0.0; 8]),
    (CameraModel::OpenCv, [0.1, -0.02, 0.001, -0.002, 0.003, 0.0, 0.0, 0.0]),
    (CameraModel::OpenCv, [-1.2, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
    (CameraModel::OpenCv, [0.3, -2.0, 0.01, 0.0, 0.2, 0.0, 0.0, 0.0]),
    (CameraModel::OpenCv, [0.0, 0.0, 0.05, -0.05, 0.0, 0.0, 0.0, 0.0]),
    (CameraModel::SimplePinhole, [0.0; 8]),
    (CameraModel::Pinhole, [0.0; 8]),
    (CameraModel::SimpleRadial, [-0.9, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
    (CameraModel::Radial, [-0.3, 0.05, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
    (CameraModel::OpenCvFisheye, [0.1, -0.05, 0.02, -0.01, 0.0, 0.0, 0.0, 0.0]),
    (CameraModel::OpenCvFisheye, [0.2, -0.9, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
    (CameraModel::FullOpenCv, [0.4, -0.1, 0.01, 0.02, 0.03, 0.6, -0.05, 0.01]),
    // It has a pole.
    (CameraModel::FullOpenCv, [0.0, 0.0, 0.0, 0.0, 0.0, -2.0, 0.0, 0.0]),
    (CameraModel::Fov, [0.0; 8]),
    (CameraModel::Fov, [1.3, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
    (CameraModel::SimpleRadialFisheye, [0.2, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
    (CameraModel::RadialFisheye, [-0.4, 0.03, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
    (CameraModel::ThinPrismFisheye, [0.0; 8]),
    (CameraModel::ThinPrismFisheye, [0.1, -0.1, 0.01, -0.02, 0.02, -0.01, 0.03, -0.02]),
];

/// The projection of COLMAP and OpenCV, with its distortion.
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
    let r = (a * a + b * b).sqrt();
    if !(r * r).is_finite() {
        return outside;
    }
    let is_distorted = camera.distortion != [0.0; 8] || is_fisheye(camera.model);
    // The radial part must grow all the way from the middle.
    let end = if is_fisheye(camera.model) {
        r.atan()
    } else {
        r
    };
    let at = |step: i32| {
        let from = end * f64::from(step) / 500.0;
        from * radial(camera, from)
    };
    let least = if is_distorted && end > 0.0 {
        let slopes = (0..500).map(|step| (at(step + 1) - at(step)) * 500.0 / end);
        slopes.fold(f64::INFINITY, f64::min)
    } else {
        1.0
    };
    let [u, w] = distorted(camera, a, b);
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
