//! Flips of every kernel, their bounds and their scale.

use super::*;

fn sphere(radius: f64) -> Kernel {
    Kernel::Spherical { radius }
}

#[test]
fn glam_keeps_the_fixed_operation_order() {
    let c = [0.1, -7.3, 1e6];
    for i in 0..1000 {
        let i = f64::from(i);
        let p = [i * 0.37 - 90.0, i * i * 1e-3, 1e6 + i * 1e-3];
        let (x, y, z) = (p[0] - c[0], p[1] - c[1], p[2] - c[2]);
        let xx_yy = x * x + y * y;
        let d = (xx_yy + z * z).sqrt();
        let s = (2.0 * 5e3 - d) / d;
        let q = Flip::new(c, sphere(5e3)).apply(p).map(|q| q.to_array());
        assert_eq!(q, Some([x * s, y * s, z * s]));
    }
}

#[test]
fn points_at_the_viewpoint_are_left_out() {
    let flip = Flip::new([1.0, 2.0, 3.0], sphere(10.0));
    assert_eq!(flip.apply([1.0, 2.0, 3.0]), None);
    // d underflows to 0, then s overflows.
    let at_origin = |kernel| Flip::new([0.0; 3], kernel);
    assert_eq!(at_origin(sphere(1.0)).apply([1e-200, 0.0, 0.0]), None);
    assert_eq!(at_origin(sphere(1e300)).apply([1e-150, 0.0, 0.0]), None);
    let power = |gamma, unit| at_origin(Kernel::Power { gamma, unit });
    assert_eq!(power(2.0, 1.0).apply([0.0; 3]), None);
    assert_eq!(power(16.0, 1.0).apply([1e-30, 0.0, 0.0]), None);
    // s is finite, but not q.
    assert_eq!(power(16.0, 1e150).apply([1e131, 0.0, 0.0]), None);
    let exponential = at_origin(Kernel::Exponential { scale: 1.0 });
    assert_eq!(exponential.apply([0.0; 3]), None);
    assert!(exponential.apply([1e-150, 0.0, 0.0]).is_some());
}

/// Kernels of every kind, for points 0.5 to 50 away.
const KERNELS: [Kernel; 6] = [
    Kernel::Spherical { radius: 60.0 },
    Kernel::Power {
        gamma: 2.5,
        unit: 3.0,
    },
    Kernel::Exponential { scale: 0.02 },
    Kernel::Exponential { scale: 30.0 },
    Kernel::Growing {
        scale: 0.5,
        farthest: 50.0,
        power: 0.7,
    },
    Kernel::Growing {
        scale: 20.0,
        farthest: 50.0,
        power: 1.0,
    },
];

#[test]
fn ratios_are_just_above_the_factor() {
    for kernel in KERNELS {
        let flip = Flip::new([1.0, 0.0, -2.0], kernel);
        for step in 1..=100 {
            let v = 0.5 * f64::from(step) * DVec3::new(0.36, -0.48, 0.8);
            let (far, near) = flip.ratio(v);
            let excess = far / near / kernel.factor(v.length()) - 1.0;
            assert!((-1e-15..1e-5).contains(&excess), "{kernel:?}, {excess}");
        }
    }
}

#[test]
fn nothing_beyond_a_distance_flips_farther_than_the_bound() {
    for kernel in KERNELS {
        let flip = Flip::new([0.0; 3], kernel);
        for step in 1..=100 {
            let distance = 0.5 * f64::from(step);
            let length = flip.apply([0.0, distance, 0.0]).unwrap().length();
            let bound = flip.most_beyond(distance);
            assert!(bound > length && bound < length * (1.0 + 1e-10) + 1e-9);
        }
    }
    for kernel in &KERNELS[1..] {
        assert_eq!(Flip::new([0.0; 3], *kernel).most_beyond(0.0), f64::INFINITY);
    }
}

#[test]
fn a_power_of_two_moves_points_inward() {
    for kernel in KERNELS {
        let flip = Flip::new([0.0; 3], kernel);
        let inward = flip.inward(50.0);
        let share = inward / kernel.factor(50.0);
        assert!(share > 0.25 && share <= 0.5, "{kernel:?}, {share}");
        assert_eq!(inward, power_of_two_below(inward));
    }
}

#[test]
fn extreme_flips_are_rescaled_where_that_is_exact() {
    let one = |x: f64| Points::Double(alloc::vec![[x, 0.0, 0.0]]);
    let scale = |kernel, x| Flip::new([0.0; 3], kernel).rescaled_for(&one(x)).scale;
    let power = Kernel::Power {
        gamma: 3.0,
        unit: 1.0,
    };
    assert_eq!(scale(power, 1e-5), 1.0);
    // |q| is 1e40, and 1e-40.
    assert!((scale(power, 1e-20) * 1e40).log2().abs() < 1.0);
    assert!((scale(power, 1e20) * 1e-40).log2().abs() < 1.0);
    for x in [1e-20, 1e20] {
        let once = Flip::new([0.0; 3], power).rescaled_for(&one(x));
        assert_eq!(once.rescaled_for(&one(x)), once);
    }
    // No point flips: nothing is scaled.
    assert_eq!(scale(power, 0.0), 1.0);
    assert_eq!(scale(sphere(1e-40), 1e-40), 2f64.powi(131));
    let flip = |scale| Flip {
        scale,
        ..Flip::new([0.0; 3], sphere(1.0))
    };
    assert!(flip(1.0).scales_exactly([0.3, 0.0, 0.0]));
    assert!(flip(0.5).scales_exactly([0.3, 0.0, 0.0]));
    assert!(!flip(f64::MIN_POSITIVE).scales_exactly([0.3, 0.4, 1.2]));
}

#[test]
fn every_length_is_scaled_alike() {
    let points = Points::Double(alloc::vec![
        [3.0, 0.0, 0.0],
        [1.0, 2.0, 5.0],
        [1.0, 2.0, 3.5],
        [1.0, 7.0, 3.0],
        [1.0, 2.0, 3.0]
    ]);
    let viewpoint = [1.0, 2.0, 3.0];
    for kernel in KERNELS {
        let one = Flip::new(viewpoint, kernel);
        let four = Flip { scale: 4.0, ..one };
        assert_eq!(
            four.apply([3.0, 0.0, 0.0]),
            one.apply([3.0, 0.0, 0.0]).map(|q| 4.0 * q)
        );
        assert_eq!(four.most_beyond(2.0), 4.0 * one.most_beyond(2.0));
        assert_eq!(four.inward(50.0), 4.0 * one.inward(50.0));
        for length in [0.3, 1.0, 20.0] {
            let v = DVec3::new(0.0, length, 0.0);
            let [once, times] = [one, four].map(|flip| flip.ratio(v));
            assert_eq!(times, (4.0 * once.0, once.1));
        }
        let longest = points
            .iter()
            .filter_map(|p| one.apply(p))
            .map(|q| q.length());
        let longest = longest.fold(0.0, f64::max);
        let ready = one.rescaled_for(&points);
        let once = ready.reach();
        assert_eq!(
            Flip {
                scale: 4.0,
                ..ready
            }
            .reach(),
            4.0 * once
        );
        assert!(once >= 2.0 * longest && once <= 8.0 * longest, "{kernel:?}");
    }
    assert!(!Flip::new(viewpoint, KERNELS[0]).keeps_in_plane(&points));
    let flat = Points::Double(alloc::vec![[3.0, 0.0, 3.0], [1.0, 2.0, 3.0]]);
    assert!(Flip::new(viewpoint, KERNELS[0]).keeps_in_plane(&flat));
}
