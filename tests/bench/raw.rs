//! Clouds from raw files, and the viewpoints of views.ts.

use hidden_point_removal::Position;

/// The direction of the first viewpoint, and a horizontal one at a right angle to it.
const FROM: [f64; 3] = [0.36, 0.48, 0.8];
const TOWARDS: [f64; 2] = [0.8, -0.36];

/// The points of a file that holds little-endian x y z.
pub fn points<T: Copy, const SIZE: usize>(bytes: &[u8], read: fn([u8; SIZE]) -> T) -> Vec<[T; 3]> {
    let at = |i: usize| read(core::array::from_fn(|byte| bytes[i * SIZE + byte]));
    (0..bytes.len() / (3 * SIZE))
        .map(|p| core::array::from_fn(|axis| at(3 * p + axis)))
        .collect()
}

/// The viewpoint after so many degrees of the orbit.
pub fn orbit<P: Position>(points: &[P], distance: f64) -> impl Fn(f64) -> [f64; 3] {
    let [mut low, mut high] = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    for point in points {
        for (axis, x) in point.widen().into_iter().enumerate() {
            low[axis] = low[axis].min(x);
            high[axis] = high[axis].max(x);
        }
    }
    let center: [f64; 3] = core::array::from_fn(|axis| (low[axis] + high[axis]) / 2.0);
    let squares: f64 = (0..3).map(|axis| (high[axis] - center[axis]).powi(2)).sum();
    let away = distance * squares.sqrt();
    let length = TOWARDS[0].hypot(TOWARDS[1]);
    let towards = [TOWARDS[0] / length, 0.0, TOWARDS[1] / length];
    move |degrees| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        core::array::from_fn(|axis| center[axis] + away * (cos * FROM[axis] + sin * towards[axis]))
    }
}
