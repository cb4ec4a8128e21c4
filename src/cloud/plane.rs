//! The plane of a few points: its normal is the axis along which they vary least.

use glam::{DMat3, DVec3};

use crate::base::real::square_root;

/// The root-mean-square distance of places from their least-squares plane.
pub(crate) fn off_plane(places: &[DVec3]) -> f64 {
    let count = places.len() as f64;
    let mean = places.iter().fold(DVec3::ZERO, |sum, v| sum + *v) / count;
    let covariance = places.iter().map(|v| outer_product(*v - mean));
    let normal = least_axis(covariance.fold(DMat3::ZERO, |sum, product| sum + product));
    let offs = places.iter().map(|v| normal.dot(*v - mean));
    square_root(offs.fold(0.0, |sum, off| sum + off * off) / count)
}

pub(crate) fn outer_product(v: DVec3) -> DMat3 {
    DMat3::from_cols(v * v.x, v * v.y, v * v.z)
}

/// The unit eigenvector of the smallest eigenvalue of a symmetric matrix, by Jacobi's
/// rotations. They need square roots only, so the bits are the same everywhere.
pub(crate) fn least_axis(matrix: DMat3) -> DVec3 {
    /// Sweeps converge quadratically; a few are enough.
    const SWEEPS: usize = 12;
    let mut columns = [matrix.x_axis, matrix.y_axis, matrix.z_axis];
    let negligible = 1e-18 * (columns[0].x + columns[1].y + columns[2].z);
    let mut axes = DVec3::AXES;
    for _ in 0..SWEEPS {
        let mut done = true;
        for (i, j) in [(0, 1), (0, 2), (1, 2)] {
            let off = columns[i][j];
            if off.abs() <= negligible {
                continue;
            }
            done = false;
            let theta = (columns[j][j] - columns[i][i]) / (2.0 * off);
            let sign = if theta < 0.0 { -1.0 } else { 1.0 };
            let tangent = sign / (theta.abs() + square_root(theta * theta + 1.0));
            let cos = 1.0 / square_root(tangent * tangent + 1.0);
            let sin = tangent * cos;
            for column in &mut columns {
                let (x, y) = (column[i], column[j]);
                (column[i], column[j]) = (x * cos - y * sin, x * sin + y * cos);
            }
            for rotated in [&mut columns, &mut axes] {
                let (x, y) = (rotated[i], rotated[j]);
                (rotated[i], rotated[j]) = (x * cos - y * sin, x * sin + y * cos);
            }
        }
        if done {
            break;
        }
    }
    axes[DVec3::new(columns[0].x, columns[1].y, columns[2].z).min_position()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_least_axis_is_found_in_any_frame() {
        let axes = [
            DVec3::new(2.0, -1.0, 0.5).normalize(),
            DVec3::new(1.0, 1.0, -2.0).normalize(),
        ];
        let [u, v] = axes;
        let v = (v - u * u.dot(v)).normalize();
        let w = u.cross(v);
        let with = |[a, b, c]: [f64; 3]| {
            outer_product(u) * a + outer_product(v) * b + outer_product(w) * c
        };
        for [a, b, c] in [
            [5.0, 3.0, 1.0],
            [1.0, 1.0, 0.0],
            [1e9, 1.0, 1e-9],
            [2.0, 2.0, 1.999],
        ] {
            let axis = least_axis(with([a, b, c]));
            assert!(axis.cross(w).length() < 1e-6, "{axis} for {a}, {b}, {c}");
            assert!((axis.length() - 1.0).abs() < 1e-14);
        }
        assert_eq!(least_axis(DMat3::ZERO), DVec3::X);
        assert_eq!(
            least_axis(DMat3::from_diagonal(DVec3::new(3.0, 0.0, 1.0))),
            DVec3::Y
        );
    }
}
