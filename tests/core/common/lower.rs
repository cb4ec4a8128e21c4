//! The naive oracle for views along a direction: the lower boundary, in exact integers.

/// A point is hidden if one, two or three points span a point, a segment or a triangle that
/// passes strictly below it at the same x and y.
pub fn visible(points: &[[i64; 3]]) -> Vec<bool> {
    let n = points.len();
    // By Carathéodory's theorem, triangles are enough, if degenerate triangles count.
    let hidden = |p: [i64; 3]| {
        (0..n)
            .any(|i| (0..=i).any(|j| (0..=j).any(|k| above(p, [points[i], points[j], points[k]]))))
    };
    points.iter().map(|&p| !hidden(p)).collect()
}

/// Whether p is strictly above a point of the triangle.
fn above(p: [i64; 3], [a, b, c]: [[i64; 3]; 3]) -> bool {
    let all = turn(a, b, c);
    if all != 0 {
        let parts = [turn(p, b, c), turn(a, p, c), turn(a, b, p)];
        let within = parts.iter().all(|part| part.signum() * all.signum() >= 0);
        let w = parts[0] * a[2] + parts[1] * b[2] + parts[2] * c[2];
        return within && (w - p[2] * all) * all.signum() < 0;
    }
    let on_segment = |a: [i64; 3], b: [i64; 3]| {
        let axis = usize::from(a[0] == b[0]);
        if a[..2] == b[..2] {
            return p[..2] == a[..2] && a[2].min(b[2]) < p[2];
        }
        let (length, part) = (b[axis] - a[axis], p[axis] - a[axis]);
        let sign = length.signum();
        turn(a, b, p) == 0
            && (0..=length.abs()).contains(&(part * sign))
            && (a[2] * (length - part) + b[2] * part - p[2] * length) * sign < 0
    };
    on_segment(a, b) || on_segment(b, c) || on_segment(a, c)
}

fn turn(a: [i64; 3], b: [i64; 3], c: [i64; 3]) -> i64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}
