//! The paper's bounds on curvature and radius, with small errors corrected, as properties of answers.

use core::f64::consts::{FRAC_PI_2, PI};

use hidden_point_removal::{
    Error, Exponential, Inversion, Options, PointCloud, permissible_curvature, radius_bound,
};

use crate::test;

fn planar(points: &[[f64; 2]], options: &Options) -> Vec<u8> {
    let points: Vec<_> = points.iter().map(|&[x, y]| [x, y, 0.0]).collect();
    let cloud = PointCloud::new(&points).unwrap();
    cloud.visible_from([0.0; 3], options).unwrap().mask()
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
                let options = Options::radius(radius);
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
            let options = Options::inversion(Inversion::Power(gamma));
            let bound = gamma / (gamma - 1.0) / r;
            let seen = |k| middle_is_visible(r, FRAC_PI_2, k, &options);
            assert!(
                seen(0.98 * bound) && !seen(1.02 * bound),
                "r = {r}, γ = {gamma}"
            );
        }
        for c in [0.01, 0.3, 2.0] {
            let scale = Exponential::Scale(c);
            let options = Options::inversion(Inversion::Exponential(scale));
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
        let seen = |radius: f64| planar(&points, &Options::radius(radius))[0] == 1;
        // The bound holds to first order in d/r and ρ/r.
        let slack = 3.0 * thickness / far + 1e-3;
        assert!(!seen(bound * (1.0 - slack)) && seen(bound * (1.0 + slack)));
    }
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
