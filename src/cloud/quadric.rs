//! How far points lie off a curved surface: off the quadric through them.

use glam::DVec3;

use crate::base::real::square_root;
use crate::cloud::plane::{least_axis, outer_product};

/// The terms of z = a + bx + cy + dx² + exy + fy².
const TERMS: usize = 6;
/// What keeps the equations solvable where points are in a line.
const RIDGE: f64 = 1e-9;

/// How places near 0 lie off the least-squares quadric above their least-squares plane.
pub(crate) struct Residuals {
    /// Of the plane.
    pub normal: DVec3,
    /// The root of the mean squared distance along the normal. The sum of squares is divided by the
    /// number of places above 6.
    pub deviation: f64,
}

/// Measures more than 6 places.
pub(crate) fn off_quadric(places: &[DVec3]) -> Residuals {
    let count = places.len() as f64;
    let mean = places.iter().fold(DVec3::ZERO, |sum, v| sum + *v) / count;
    let covariance = places.iter().map(|v| outer_product(*v - mean));
    let normal = least_axis(covariance.fold(glam::DMat3::ZERO, |sum, product| sum + product));
    let across = normal.cross(DVec3::AXES[normal.abs().min_position()]);
    let right = across / square_root(across.dot(across));
    let up = normal.cross(right);

    let mut widest = [0.0f64; 2];
    for v in places {
        for (widest, axis) in widest.iter_mut().zip([right, up]) {
            *widest = widest.max(v.dot(axis).abs());
        }
    }
    let width = widest[0] + widest[1];
    let unit = if width > 0.0 { 1.0 / width } else { 0.0 };
    let terms = |v: DVec3| {
        let [x, y] = [v.dot(right) * unit, v.dot(up) * unit];
        [1.0, x, y, x * x, x * y, y * y]
    };

    // The normal equations, with the right side as the last column.
    let mut rows = [[0.0; TERMS + 1]; TERMS];
    for &v in places {
        let (term, height) = (terms(v), v.dot(normal));
        for (i, row) in rows.iter_mut().enumerate() {
            for j in 0..TERMS {
                row[j] += term[i] * term[j];
            }
            row[TERMS] += term[i] * height;
        }
    }
    for (i, row) in rows.iter_mut().enumerate() {
        row[i] += RIDGE;
    }
    let factors = solved(rows);
    let mut squares = 0.0;
    for &v in places {
        let mut off = v.dot(normal);
        for (factor, term) in factors.iter().zip(terms(v)) {
            off -= factor * term;
        }
        squares += off * off;
    }
    Residuals {
        normal,
        deviation: square_root(squares / (count - TERMS as f64)),
    }
}

/// Solves symmetric, positive equations by elimination. They need no exchange of rows.
fn solved(mut rows: [[f64; TERMS + 1]; TERMS]) -> [f64; TERMS] {
    for pivot in 0..TERMS {
        let from = rows[pivot];
        for row in rows.iter_mut().skip(pivot + 1) {
            let factor = row[pivot] / from[pivot];
            for column in pivot..=TERMS {
                row[column] -= factor * from[column];
            }
        }
    }
    let mut solution = [0.0; TERMS];
    for i in (0..TERMS).rev() {
        let mut rest = rows[i][TERMS];
        for j in i + 1..TERMS {
            rest -= rows[i][j] * solution[j];
        }
        solution[i] = rest / rows[i][i];
    }
    solution
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec::Vec;

    #[test]
    fn points_of_a_quadric_lie_on_it_and_noise_is_measured() {
        let point = |k: usize| {
            let [x, y] = [(k % 7) as f64 - 3.0, (k / 7) as f64 - 3.0];
            DVec3::new(x, y, 2.0 + 0.1 * x - 0.03 * x * y + 0.02 * y * y)
        };
        let smooth: Vec<DVec3> = (0..49).map(point).collect();
        let smooth_off = off_quadric(&smooth);
        assert!(smooth_off.normal.z.abs() > 0.9 && smooth_off.deviation < 0.02);
        let rough = smooth.iter().zip(0..);
        let rough: Vec<DVec3> = rough
            .map(|(v, k)| *v + DVec3::Z * if k % 2 == 0 { 0.1 } else { -0.1 })
            .collect();
        let rough_off = off_quadric(&rough);
        assert!((rough_off.deviation - 0.1).abs() < 0.02);
    }

    #[test]
    fn points_in_a_line_are_on_a_quadric() {
        let line: Vec<DVec3> = (0..17).map(|k| DVec3::splat(f64::from(k))).collect();
        let off = off_quadric(&line);
        assert!(off.normal.is_finite() && off.deviation < 1e-12);
    }
}
