//! The labels and scores of looks, from the rule in docs/LOOKS.md alone: every triangle is tried, in plain numbers.

use hidden_point_removal::{Options, PointCloud};

use crate::common::rng::Rng;
use crate::common::{cross, dot, length, minus, shapes};
use crate::test;

type P = [f64; 3];

/// The outward normal of three corners, and its height.
fn plane(q: [P; 3]) -> (P, f64) {
    let normal = cross(minus(q[1], q[0]), minus(q[2], q[0]));
    let height = dot(normal, q[0]);
    (normal.map(|x| x * height.signum()), height.abs())
}

/// The triangles of the hull of these points and the viewpoint at 0 that the viewpoint is no corner of.
fn outer_faces(q: &[P]) -> Vec<[usize; 3]> {
    let mut faces = Vec::new();
    for a in 0..q.len() {
        for b in 0..a {
            for c in 0..b {
                let (normal, height) = plane([q[a], q[b], q[c]]);
                let mut others = (0..q.len()).filter(|i| ![a, b, c].contains(i));
                if others.all(|i| dot(normal, q[i]) < height) {
                    faces.push([a, b, c]);
                }
            }
        }
    }
    faces
}

/// A score: whether the point is visible, and how sure that is.
type Verdict = Option<(bool, f64)>;

/// What the looks with these scales say. The viewpoint is at 0. The next sheet is too far to count here.
fn looked(points: &[P], scales: &[f64]) -> Vec<Verdict> {
    let mut verdicts: Vec<Verdict> = vec![None; points.len()];
    let mut part: Vec<usize> = (0..points.len()).collect();
    let mut known = vec![f64::INFINITY; points.len()];
    let mut longest_of_surface = None;
    let sure = if scales.len() == 2 {
        [1.0, 0.55, 0.0]
    } else {
        [1.0, 0.8, 0.55]
    };
    for (look, (&scale, sure)) in scales.iter().zip(sure).enumerate() {
        let flipped: Vec<P> = part
            .iter()
            .map(|&i| {
                let d = length(points[i]);
                points[i].map(|x| x / d * (scale / d).exp())
            })
            .collect();
        let faces = outer_faces(&flipped);
        let edge = |a: usize, b: usize| length(minus(points[part[a]], points[part[b]]));
        let of = |v: usize| faces.iter().filter(move |face| face.contains(&v));
        let mut spacing = vec![f64::INFINITY; points.len()];
        for v in 0..part.len() {
            let mut beside: Vec<usize> = of(v).flatten().copied().filter(|&w| w != v).collect();
            beside.sort_unstable();
            beside.dedup();
            let mut edges: Vec<f64> = beside.iter().map(|&w| edge(v, w)).collect();
            edges.sort_by(f64::total_cmp);
            if let [first, second, ..] = edges[..] {
                spacing[part[v]] = known[part[v]].min((first + second) / 2.0);
            }
        }
        let size = |face: &[usize; 3]| face.iter().map(|&v| spacing[part[v]]).sum::<f64>() / 3.0;
        for v in (0..part.len()).filter(|&v| spacing[part[v]].is_finite()) {
            let sum: f64 = of(v).map(|face| 3.0 * size(face) - spacing[part[v]]).sum();
            if verdicts[part[v]].is_none() && scale >= 0.02 * sum / (2 * of(v).count()) as f64 {
                verdicts[part[v]] = Some((true, sure));
            }
        }
        // The open points behind a triangle: its corners, its longest edge in spacings, the cosine and the depth.
        let behind: Vec<_> = part
            .iter()
            .filter(|&&i| verdicts[i].is_none() && spacing[i] == f64::INFINITY)
            .map(|&i| {
                let p = points[i];
                let crosses = |face: &&[usize; 3]| {
                    let [a, b, c] = face.map(|v| flipped[v]);
                    let sides = [(a, b), (b, c), (c, a)].map(|(a, b)| dot(cross(a, b), p) > 0.0);
                    let ahead = dot(plane([a, b, c]).0, p) > 0.0;
                    ahead && sides[0] == sides[1] && sides[1] == sides[2]
                };
                let face = faces.iter().find(crosses).expect("a face before a point");
                let (normal, height) = plane(face.map(|v| points[part[v]]));
                let [a, b, c] = *face;
                let longest = edge(a, b).max(edge(b, c)).max(edge(c, a));
                let cosine = dot(normal, p).abs() / length(normal) / length(p);
                let depth = (1.0 - height / dot(normal, p)) * length(p);
                (
                    i,
                    face.map(|v| part[v]),
                    longest,
                    longest / size(face),
                    cosine,
                    depth,
                )
            })
            .collect();
        let most = *longest_of_surface.get_or_insert_with(|| {
            let facing = behind.iter().filter(|behind| behind.4 >= 0.5);
            let mut lengths: Vec<f64> = facing.map(|behind| behind.3).collect();
            lengths.sort_by(f64::total_cmp);
            let usual = lengths.get(lengths.len() * 80 / 100);
            usual.map_or(4.0, |usual| f64::max(4.0, 1.75 * usual))
        });
        let mut next: Vec<usize> = part
            .iter()
            .copied()
            .filter(|&i| verdicts[i].is_none() && spacing[i].is_finite())
            .collect();
        for (i, corners, longest, in_spacings, _, depth) in behind {
            let is_last = look + 1 == scales.len();
            if in_spacings <= most || is_last && depth > longest {
                let depth = depth / (0.45 * longest);
                verdicts[i] = Some((depth <= 1.0, 1.0 / (1.0 + depth.max(0.0).powi(2))));
            } else {
                next.extend(corners.iter().chain([&i]));
            }
        }
        next.sort_unstable();
        next.dedup();
        (part, known) = (next, spacing);
    }
    verdicts
}

/// Lets undecided points follow their 16 nearest.
fn followed(points: &[P], mut verdicts: Vec<Verdict>) -> Vec<Verdict> {
    for _ in 0..2 {
        let before = verdicts.clone();
        for i in (0..points.len()).filter(|&i| before[i].is_none()) {
            let mut others: Vec<usize> = (0..points.len()).filter(|&j| j != i).collect();
            let away = |j: usize| length(minus(points[i], points[j]));
            others.sort_by(|&a, &b| away(a).total_cmp(&away(b)));
            let near: Vec<_> = others[..16].iter().filter_map(|&j| before[j]).collect();
            if near.len() >= 2 {
                let share = near.iter().filter(|near| near.0).count() as f64 / near.len() as f64;
                verdicts[i] = Some((share > 0.5, share));
            }
        }
    }
    verdicts
}

/// A few clumps, some before others: most triangles between them are no surface.
fn clumps(rng: &mut Rng, count: usize) -> Vec<P> {
    let middles: Vec<P> = (0..7).map(|_| rng.in_ball()).collect();
    let place = |rng: &mut Rng| {
        let (middle, aside, width) = (rng.pick(&middles), rng.in_ball(), rng.pick(&[0.05, 0.3]));
        [0, 1, 2].map(|axis| middle[axis] + width * aside[axis])
    };
    (0..count).map(|_| place(rng)).collect()
}

#[test]
fn labels_and_scores_are_those_of_the_rule() {
    let mut rng = Rng::new(44);
    let kinds = [clumps, shapes::ball, clumps, shapes::bumpy];
    let mut counts = [0; 6];
    for round in 0..400 {
        let number = 30 + rng.below(31);
        let points: Vec<P> = kinds[round % 4](&mut rng, number);
        let away = rng.pick(&[0.3, 1.5, 3.0]);
        let viewpoint = rng.direction().map(|x| x * away);
        let unit = 2f64.powi(rng.integer(-100, 100));
        let scaled: Vec<P> = points.iter().map(|p| p.map(|x| x * unit)).collect();
        let options = Options::looks(2 + round / 4 % 2).with_scores(true);
        let cloud = PointCloud::new(&scaled).unwrap();
        let answer = cloud
            .visible_from(viewpoint.map(|x| x * unit), &options)
            .unwrap();
        let scales: Vec<f64> = answer.looks().iter().map(|scale| scale / unit).collect();
        let places: Vec<P> = points.iter().map(|&p| minus(p, viewpoint)).collect();
        let of_looks = looked(&places, &scales);
        let expected = followed(&places, of_looks.clone());
        for (i, (found, seen)) in answer.scores().iter().zip(answer.mask()).enumerate() {
            let (visible, sure) = expected[i].unwrap_or((false, 0.2));
            let odds: f64 = (sure + 0.01) / (1.01 - sure);
            let score = 1.0 / (1.0 + odds.powf(-1.4));
            let title = format!("point {i} of {number}, round {round}, in units of {unit}");
            assert_eq!(seen == 1, visible, "{title}: {found}, {sure}");
            assert!(
                (f64::from(*found) - score).abs() < 1e-6,
                "{title}: {found}, not {score}"
            );
            let kind = match (of_looks[i], expected[i]) {
                (None, None) => 0,
                (None, _) => 1,
                (Some((true, 0.8)), _) => 2,
                (Some((true, 0.55)), _) => 3,
                (Some((true, 1.0)), _) => 4,
                _ => 5,
            };
            counts[kind] += 1;
        }
    }
    assert!(counts[1..].iter().all(|&count| count > 10), "{counts:?}");
}
