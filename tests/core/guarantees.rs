//! The paper's lemmas and theorems, with small errors corrected, as properties of answers.

use core::f64::consts::{FRAC_PI_2, PI, TAU};

use hidden_point_removal::{
    Error, Exponential, Inversion, Options, PointCloud, permissible_curvature, radius_bound,
};

use crate::common::flip::distance;
use crate::common::rng::Rng;
use crate::common::{ask, shapes};

fn planar(points: &[[f64; 2]], options: &Options) -> Vec<u8> {
    let points: Vec<_> = points.iter().map(|&[x, y]| [x, y, 0.0]).collect();
    let cloud = PointCloud::new(&points).unwrap();
    cloud.visible_from([0.0; 3], options).unwrap().mask()
}

fn norm([x, y]: [f64; 2]) -> f64 {
    libm::hypot(x, y)
}

/// Rays with several points each. Flipped points stay on their ray.
fn on_rays(rng: &mut Rng) -> (Vec<[f64; 3]>, Vec<bool>) {
    let mut points = Vec::new();
    let mut nearest = Vec::new();
    for i in (0..27).filter(|&i| i != 13) {
        let ray = [i % 3, i / 3 % 3, i / 9].map(|x| f64::from(x as u8) - 1.0);
        let sizes: Vec<f64> = (0..4).map(|_| rng.between(0.5, 4.0)).collect();
        let least = sizes.iter().copied().fold(f64::MAX, f64::min);
        points.extend(sizes.iter().map(|&size| ray.map(|x| x * size)));
        nearest.extend(sizes.iter().map(|&size| size == least));
    }
    (points, nearest)
}

#[test]
fn lemma_4_1_nothing_behind_a_point_is_visible() {
    let mut rng = Rng::new(81);
    for _ in 0..30 {
        let (points, nearest) = on_rays(&mut rng);
        for exponent in [0.0, 0.3, 1.0, 2.0, 4.0, 8.0] {
            let mask = ask(&points, [0.0; 3], &Options::with_exponent(exponent)).mask();
            assert!(
                mask.iter()
                    .zip(&nearest)
                    .all(|(&seen, &near)| seen == 0 || near)
            );
        }
    }
}

#[test]
fn lemma_4_2_from_some_radius_on_all_that_is_nearest_is_visible() {
    let mut rng = Rng::new(82);
    for case in 0..40 {
        let (points, nearest) = if case % 2 == 0 {
            on_rays(&mut rng)
        } else {
            let ball = shapes::ball(&mut rng, 80);
            (ball, vec![true; 80])
        };
        // p beats q on another ray once R > (r_p − r_q cos θ)/(2(1 − cos θ)).
        let mut bound = 0.0f64;
        for (&p, _) in points.iter().zip(&nearest).filter(|(_, near)| **near) {
            for &q in &points {
                let [rp, rq] = [p, q].map(|p| distance(p, [0.0; 3]));
                let cos = (0..3).map(|i| p[i] * q[i]).sum::<f64>() / (rp * rq);
                if cos < 1.0 - 1e-9 {
                    bound = bound.max((rp - rq * cos) / (2.0 * (1.0 - cos)));
                }
            }
        }
        let farthest = points
            .iter()
            .map(|&p| distance(p, [0.0; 3]))
            .fold(0.0, f64::max);
        let radius = (bound * 1.0001).max(farthest);
        let mask = ask(&points, [0.0; 3], &Options::with_radius(radius)).mask();
        for (seen, near) in mask.iter().zip(&nearest) {
            assert_eq!(*seen == 1, *near, "case {case}");
        }
    }
}

/// Whether the middle of a piece of curve, at (0, r) from the viewpoint, is visible. The
/// tangent of the curve meets the ray at the angle ψ. For k > 0 the curve bends towards the
/// viewer.
fn middle_is_visible(r: f64, psi: f64, k: f64, options: &Options) -> bool {
    let h = 1e-3 * r;
    let (sin, cos) = libm::sincos(psi);
    let along = |u: f64| {
        // u along the tangent (sin ψ, cos ψ), and v off the tangent, on the viewer's side.
        let v = 0.5 * k * u * u;
        [u * sin + v * cos, r + u * cos - v * sin]
    };
    planar(&[along(0.0), along(h), along(-h)], options)[0] == 1
}

#[test]
fn lemma_4_3_pits_are_seen_up_to_the_permissible_curvature() {
    for r in [0.7, 3.0] {
        for times in [1.5, 4.0, 30.0] {
            for psi in [FRAC_PI_2, 1.2, 0.8, 0.5, 2.0] {
                let radius = times * r;
                let options = Options::with_radius(radius);
                // cot β = r·cot ψ/(2R − r): the angle of the hull at the flipped point.
                let beta = libm::atan2(2.0 * radius - r, r * libm::cos(psi) / libm::sin(psi));
                let bound = permissible_curvature(radius, r, beta).unwrap();
                let seen = |k: f64| middle_is_visible(r, psi, k, &options);
                let title = format!("r = {r}, R = {radius}, ψ = {psi}, k = {bound}");
                assert!(seen(0.98 * bound) && !seen(1.02 * bound), "{title}");
                // A flat curve, and curves that bend away from the viewer.
                assert!(seen(0.0) && seen(-1.0 / r) && seen(-100.0 / r), "{title}");
                // The same bound in terms of ψ.
                let cot = libm::cos(psi) / libm::sin(psi);
                let same = 2.0 * radius / (r * r)
                    * libm::pow(libm::sin(psi), 3.0)
                    * (1.0 + 2.0 * r * cot * cot / (2.0 * radius - r));
                assert!((bound / same - 1.0).abs() < 1e-12, "{title}");
            }
        }
    }
}

#[test]
fn the_permissible_curvature_has_no_limits_of_size() {
    // If β is not near 0 and R is much larger than r, the permissible curvature is
    // |tan β| ÷ R.
    for beta in [0.5, 1.0, 2.5] {
        for (radius, r) in [
            (1e200, 1.0),
            (1e300, 1e-300),
            (1.0, 1e-200),
            (1e-100, 1e-300),
        ] {
            let bound = permissible_curvature(radius, r, beta).unwrap();
            let expected = libm::tan(beta).abs() / radius;
            assert!(
                (bound / expected - 1.0).abs() < 1e-12,
                "{radius} {r} {beta}: {bound}"
            );
        }
    }
}

#[test]
fn other_inversions_have_their_own_curvature() {
    for r in [0.5, 2.0] {
        for gamma in [1.1, 2.0, 5.0] {
            let options = Options::with_inversion(Inversion::Power(gamma));
            let bound = gamma / (gamma - 1.0) / r;
            let seen = |k| middle_is_visible(r, FRAC_PI_2, k, &options);
            assert!(
                seen(0.98 * bound) && !seen(1.02 * bound),
                "r = {r}, γ = {gamma}"
            );
        }
        for c in [0.01, 0.3, 2.0] {
            let scale = Exponential::Scale(c);
            let options = Options::with_inversion(Inversion::Exponential(scale));
            let bound = 1.0 / c + 1.0 / r;
            let seen = |k| middle_is_visible(r, FRAC_PI_2, k, &options);
            assert!(
                seen(0.98 * bound) && !seen(1.02 * bound),
                "r = {r}, c = {c}"
            );
        }
    }
}

#[test]
fn the_bound_on_the_radius_hides_the_bottom_between_two_samples() {
    for (thickness, far, spacing) in [(0.01, 3.0, 0.02), (0.2, 8.0, 0.05), (1e-4, 2.0, 3e-3)] {
        let bound = radius_bound(thickness, far, spacing).unwrap();
        let points = [
            [0.0, far],
            [spacing, far - thickness],
            [-spacing, far - thickness],
        ];
        let seen = |radius: f64| planar(&points, &Options::with_radius(radius))[0] == 1;
        // The bound holds to first order in d/r and ρ/r.
        let slack = 3.0 * thickness / far + 1e-3;
        assert!(!seen(bound * (1.0 - slack)) && seen(bound * (1.0 + slack)));
    }
}

/// Circles seen from the origin, and a sample of them whose points are 2ρ apart.
struct Circles {
    circles: Vec<([f64; 2], f64)>,
    sample: Vec<[f64; 2]>,
    /// A dense sample of the truly visible places.
    visible: Vec<[f64; 2]>,
    /// The distance from the origin to the nearest place.
    nearest: f64,
}

impl Circles {
    fn new(circles: &[([f64; 2], f64)], rho: f64) -> Self {
        let at = |([x, y], size): ([f64; 2], f64), turn: f64| {
            let (sin, cos) = libm::sincos(turn);
            [x + size * cos, y + size * sin]
        };
        let around = |step: f64| {
            circles.iter().flat_map(move |&circle| {
                let count = (TAU * circle.1 / step).ceil();
                (0..count as usize).map(move |i| at(circle, TAU * i as f64 / count))
            })
        };
        let mut all = Self {
            circles: circles.to_vec(),
            sample: around(1.98 * rho).collect(),
            visible: Vec::new(),
            nearest: f64::MAX,
        };
        for place in around(0.05 * rho) {
            all.nearest = all.nearest.min(norm(place));
            if all.sees(place) {
                all.visible.push(place);
            }
        }
        all
    }

    fn sees(&self, place: [f64; 2]) -> bool {
        let r = norm(place);
        let along = place.map(|x| x / r);
        self.circles.iter().all(|&(center, size)| {
            let middle = center[0] * along[0] + center[1] * along[1];
            let off = center[0] * along[1] - center[1] * along[0];
            // Where the ray first meets the circle.
            let half = size * size - off * off;
            half <= 0.0 || middle - half.sqrt() >= r * (1.0 - 1e-9) || middle < 0.0
        })
    }

    fn distance_to_visible(&self, p: [f64; 2]) -> f64 {
        // Squares: there are millions of pairs, and `hypot` takes long in WebAssembly.
        let squared = |q: &[f64; 2]| {
            let (x, y) = (p[0] - q[0], p[1] - q[1]);
            x * x + y * y
        };
        let nearest = self.visible.iter().map(squared);
        nearest.fold(f64::MAX, f64::min).sqrt()
    }
}

const SCENES: [&[([f64; 2], f64)]; 3] = [
    &[([0.0, 4.0], 1.0)],
    &[([0.2, 3.0], 0.5), ([0.0, 6.0], 1.5)],
    &[([-0.6, 3.0], 0.4), ([0.7, 4.0], 0.6), ([0.0, 7.0], 2.0)],
];

#[test]
fn theorem_4_4_what_is_marked_is_nearly_visible() {
    let mut checked = 0;
    for scene in SCENES {
        for rho in [0.01, 0.003] {
            let circles = Circles::new(scene, rho);
            let sin = 2.0 * rho / circles.nearest;
            let cos = (1.0 - sin * sin).sqrt();
            let farthest = circles.sample.iter().map(|&p| norm(p)).fold(0.0, f64::max);
            for times in [1.1, 5.0, 50.0, 1000.0] {
                let radius = times * farthest;
                let mask = planar(&circles.sample, &Options::with_radius(radius));
                for (&p, _) in circles
                    .sample
                    .iter()
                    .zip(&mask)
                    .filter(|(_, seen)| **seen == 1)
                {
                    let r = norm(p);
                    let ratio = r / radius;
                    if rho < 0.5 * circles.nearest * (ratio * (1.0 - 0.25 * ratio)).sqrt() {
                        let k = 2.0 * radius - (2.0 * radius - r) / cos;
                        let epsilon = rho + libm::hypot(r - k * cos, k * sin);
                        // The places are a sample. So this distance errs by a fraction of ρ.
                        let away = circles.distance_to_visible(p);
                        assert!(away <= epsilon + 0.05 * rho, "{away} > {epsilon} at {p:?}");
                        checked += 1;
                    }
                }
            }
        }
    }
    assert!(checked > 5000, "{checked}");
}

#[test]
fn theorem_4_5_a_radius_for_a_wanted_epsilon() {
    let mut checked = 0;
    for scene in SCENES {
        for (rho, epsilon) in [(0.01, 0.2), (0.003, 0.05), (0.003, 0.4)] {
            let circles = Circles::new(scene, rho);
            let sin = 2.0 * rho / circles.nearest;
            let cos = (1.0 - sin * sin).sqrt();
            let farthest = circles.sample.iter().map(|&p| norm(p)).fold(0.0, f64::max);
            let bound = |p: &[f64; 2]| {
                let r = norm(*p);
                let reach = (epsilon - rho) * (epsilon - rho) - r * r * sin * sin;
                assert!(reach >= 0.0 && epsilon > rho);
                let k = r * cos - reach.sqrt();
                (r - k * cos) / (2.0 * (1.0 - cos))
            };
            let radius = 0.999 * circles.sample.iter().map(bound).fold(f64::MAX, f64::min);
            // Otherwise the theorem makes no statement about any radius.
            if radius < farthest {
                continue;
            }
            let mask = planar(&circles.sample, &Options::with_radius(radius));
            for (&p, _) in circles
                .sample
                .iter()
                .zip(&mask)
                .filter(|(_, seen)| **seen == 1)
            {
                let away = circles.distance_to_visible(p);
                assert!(away <= epsilon + 0.05 * rho, "{away} > {epsilon} at {p:?}");
                checked += 1;
            }
        }
    }
    assert!(checked > 1000, "{checked}");
}

#[test]
fn the_formulas_have_their_special_cases_and_limits() {
    let close = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-12;
    // The paper's formula, at values where its differences lose no digits.
    for (radius, r, beta) in [(30.0, 10.0, 0.7), (5.0, 4.9, 1.4), (12.0, 1.0, 2.5)] {
        let (sin, cos) = libm::sincos(beta);
        let cot2 = cos * cos / (sin * sin);
        let above = 4.0 * radius * (2.0 * radius - r) * cot2 + 2.0 * radius * r;
        let below: f64 = 4.0 * radius * r - 4.0 * radius * radius
            + (r - 2.0 * radius) * (r - 2.0 * radius) / (sin * sin);
        let expected = above / libm::pow(below, 1.5);
        assert!(close(
            permissible_curvature(radius, r, beta).unwrap(),
            expected
        ));
    }
    let [one, tiny] =
        [1.0, 1e-200].map(|unit| permissible_curvature(30.0 * unit, 10.0 * unit, 0.7));
    assert!(close(one.unwrap() / 1e-200, tiny.unwrap()));
    assert_eq!(permissible_curvature(7.0, 2.0, 0.0), Ok(0.0));
    assert!(permissible_curvature(7.0, 2.0, PI).unwrap() < 1e-14);
    let error = permissible_curvature(1.0, 2.0, 1.0).unwrap_err();
    assert!(matches!(error, Error::OutOfRange { option: "R", .. }) && error.code() == "option");
    for (radius, r, beta) in [
        (1.0, 0.0, 1.0),
        (f64::INFINITY, 1.0, 1.0),
        (1.0, 1.0, -0.1),
        (1.0, 1.0, 3.2),
        (f64::NAN, 1.0, 1.0),
        (1.0, f64::NAN, 1.0),
        (1.0, 1.0, f64::NAN),
    ] {
        assert!(permissible_curvature(radius, r, beta).is_err());
    }
    assert!(close(radius_bound(0.5, 4.0, 0.1).unwrap(), 800.0));
    assert_eq!(radius_bound(1.0, 1e300, 1e-300), Ok(f64::MAX));
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(radius_bound(bad, 1.0, 1.0).is_err());
        assert!(radius_bound(1.0, bad, 1.0).is_err());
        assert!(radius_bound(1.0, 1.0, bad).is_err());
    }
}
