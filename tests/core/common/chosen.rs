//! The points that take part in a question, and the same question asked of a cloud of these points alone.

use hidden_point_removal::{Error, Options, PointCloud, Visibility, Within};

use super::rng::Rng;
use super::scenes::Scene;

pub const EVERYWHERE: [[f64; 3]; 2] = [[f64::NEG_INFINITY; 3], [f64::INFINITY; 3]];

/// The same options for the chosen points only.
pub fn only(within: Within, options: &Options) -> Options {
    options.with_within(within)
}

/// The indices of the points that take part, by the definition.
pub fn chosen(points: &[[f64; 3]], within: &Within, viewpoint: Option<[f64; 3]>) -> Vec<u32> {
    let holds = |p: [f64; 3]| {
        let near = match (within.distance, viewpoint) {
            (Some(distance), Some(c)) => {
                let v = [p[0] - c[0], p[1] - c[1], p[2] - c[2]];
                (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt() <= distance
            }
            _ => true,
        };
        let [min, max] = within.bounds.unwrap_or(EVERYWHERE);
        near && (0..3).all(|axis| (min[axis]..=max[axis]).contains(&p[axis]))
    };
    let all = (0u32..).zip(points);
    all.filter_map(|(index, &p)| holds(p).then_some(index))
        .collect()
}

/// Some choice that leaves about half of the points.
pub fn some_choice(rng: &mut Rng, scene: &Scene) -> Within {
    let points = &scene.points;
    if points.is_empty() {
        return Within::default();
    }
    let [a, b] = [rng.pick(points), rng.pick(points)];
    let v: [f64; 3] = core::array::from_fn(|i| a[i] - scene.viewpoint[i]);
    let distance = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    let axis = rng.below(3);
    let mut bounds = EVERYWHERE;
    (bounds[0][axis], bounds[1][axis]) = (a[axis].min(b[axis]), a[axis].max(b[axis]));
    match rng.below(3) {
        0 => Within {
            distance: Some(distance),
            bounds: None,
        },
        1 => Within {
            distance: None,
            bounds: Some(bounds),
        },
        _ => Within {
            distance: Some(distance),
            bounds: Some(bounds),
        },
    }
}

type Facts = (Vec<u32>, Vec<(u32, u32)>, [u64; 2], u32, String);

/// Everything about an answer that does not depend on the numbering. `indices` numbers the points of a part.
pub fn facts(answer: Result<Visibility, Error>, indices: Option<&[u32]>) -> Result<Facts, Error> {
    let answer = answer?;
    let number = |k: u32| indices.map_or(k, |indices| indices[k as usize]);
    let scores = (0u32..).zip(answer.scores());
    let scores = scores.filter(|(_, score)| **score != 0.0);
    Ok((
        answer.indices().iter().map(|&k| number(k)).collect(),
        scores
            .map(|(k, score)| (number(k), score.to_bits()))
            .collect(),
        [answer.radius().to_bits(), answer.exponent().to_bits()],
        answer.evaluations(),
        format!(
            "{:?} {:?} {}",
            answer.inversion(),
            answer.looks(),
            answer.exact()
        ),
    ))
}

/// A cloud of the points with these indices.
pub fn alone(points: &[[f64; 3]], indices: &[u32]) -> PointCloud {
    let points: Vec<_> = indices.iter().map(|&i| points[i as usize]).collect();
    PointCloud::new(&points).unwrap()
}
