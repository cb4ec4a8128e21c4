//! These must not change an answer: order, duplicates, power-of-two scale, earlier
//! questions, the precision of the given positions, partitions.

use hidden_point_removal::{Options, PointCloud, Radius};

use crate::common::ask;
use crate::common::flip::farthest;
use crate::common::rng::Rng;
use crate::common::scenes::{KINDS, Scene};

/// A small, a degenerate and a larger scene of every kind.
fn scenes() -> impl Iterator<Item = (String, Scene, Rng)> {
    KINDS.iter().flat_map(|kind| {
        [(1, 9), (2, 30), (3, 30), (4, 400)]
            .into_iter()
            .map(|(seed, n)| {
                let title = format!("{} with seed {seed}", kind.name);
                (title, kind.scene(seed, n), Rng::new(seed))
            })
    })
}

#[test]
fn the_order_of_the_input_changes_nothing() {
    for (title, scene, mut rng) in scenes() {
        let before = ask(&scene.points, scene.viewpoint, &scene.options);
        let mut order: Vec<usize> = (0..scene.points.len()).collect();
        rng.shuffle(&mut order);
        let shuffled: Vec<_> = order.iter().map(|&i| scene.points[i]).collect();
        let after = ask(&shuffled, scene.viewpoint, &scene.options);
        assert_eq!(
            after.radius().to_bits(),
            before.radius().to_bits(),
            "{title}"
        );
        let (before, after) = (before.mask(), after.mask());
        for (now, &then) in order.iter().enumerate() {
            assert_eq!(after[now], before[then], "{title}, point {then}");
        }
    }
}

#[test]
fn duplicates_change_nothing() {
    for (title, mut scene, mut rng) in scenes() {
        let before = ask(&scene.points, scene.viewpoint, &scene.options);
        let originals: Vec<usize> = (0..scene.points.len())
            .map(|_| rng.below(scene.points.len()))
            .collect();
        let n = scene.points.len();
        let copies: Vec<_> = originals.iter().map(|&i| scene.points[i]).collect();
        scene.points.extend(copies);
        let after = ask(&scene.points, scene.viewpoint, &scene.options);
        assert_eq!(
            after.radius().to_bits(),
            before.radius().to_bits(),
            "{title}"
        );
        let (before, after) = (before.mask(), after.mask());
        assert_eq!(after[..n], before, "{title}");
        for (copy, &original) in originals.iter().enumerate() {
            assert_eq!(
                after[n + copy],
                before[original],
                "{title}, copy of {original}"
            );
        }
    }
}

#[test]
fn a_power_of_two_scale_changes_no_index() {
    for (title, scene, _) in scenes() {
        if title.starts_with("scaled") || title.starts_with("aimed_scaled") {
            continue;
        }
        let before = ask(&scene.points, scene.viewpoint, &scene.options);
        for scale in [2.0f64.powi(-200), 0.5, 2.0f64.powi(300)] {
            let by = |p: [f64; 3]| p.map(|x| x * scale);
            let points: Vec<_> = scene.points.iter().map(|&p| by(p)).collect();
            let options = match scene.options.radius {
                Radius::Absolute(radius) => Options::with_radius(radius * scale),
                other => Options::default().radius(other),
            };
            let after = ask(&points, by(scene.viewpoint), &options);
            assert_eq!(
                after.radius(),
                before.radius() * scale,
                "{title} times {scale}"
            );
            assert_eq!(after.indices(), before.indices(), "{title} times {scale}");
        }
    }
}

#[test]
fn what_was_asked_before_changes_nothing() {
    for (title, scene, mut rng) in scenes() {
        let cloud = PointCloud::new(&scene.points).unwrap();
        let first = cloud.visible_from(scene.viewpoint, &scene.options).unwrap();
        for _ in 0..3 {
            let elsewhere = rng.direction().map(|x| x * 4.0);
            cloud
                .visible_from(elsewhere, &Options::with_exponent(1.0))
                .unwrap();
        }
        let again = cloud.visible_from(scene.viewpoint, &scene.options).unwrap();
        assert_eq!(again.indices(), first.indices(), "{title}");
        assert_eq!(
            again.radius().to_bits(),
            first.radius().to_bits(),
            "{title}"
        );
    }
}

#[test]
fn single_precision_positions_are_widened() {
    for (title, scene, _) in scenes() {
        let narrow: Vec<[f32; 3]> = scene.points.iter().map(|p| p.map(|x| x as f32)).collect();
        if narrow.iter().flatten().any(|x| !x.is_finite()) {
            continue;
        }
        let wide: Vec<[f64; 3]> = narrow.iter().map(|p| p.map(f64::from)).collect();
        let options = match scene.options.radius {
            Radius::Absolute(_) => Options::with_exponent(2.0),
            other => Options::default().radius(other),
        };
        let narrow = ask(&narrow, scene.viewpoint, &options);
        let wide = ask(&wide, scene.viewpoint, &options);
        assert_eq!(narrow.indices(), wide.indices(), "{title}");
        assert_eq!(
            narrow.radius().to_bits(),
            wide.radius().to_bits(),
            "{title}"
        );
    }
}

#[test]
fn parts_seen_with_one_radius_merge_exactly() {
    for (title, scene, mut rng) in scenes() {
        let farthest = farthest(&scene.points, scene.viewpoint);
        if farthest == 0.0 {
            continue;
        }
        let whole = ask(&scene.points, scene.viewpoint, &scene.options);
        let options = Options::with_radius(whole.radius());
        let mut survivors = Vec::new();
        let part: Vec<usize> = scene.points.iter().map(|_| rng.below(3)).collect();
        for wanted in 0..3 {
            let own: Vec<usize> = (0..part.len()).filter(|&i| part[i] == wanted).collect();
            let points: Vec<_> = own.iter().map(|&i| scene.points[i]).collect();
            let seen = ask(&points, scene.viewpoint, &options);
            survivors.extend(seen.indices().iter().map(|&i| own[i as usize]));
        }
        survivors.sort_unstable();
        let points: Vec<_> = survivors.iter().map(|&i| scene.points[i]).collect();
        let merged = ask(&points, scene.viewpoint, &options);
        let merged: Vec<u32> = merged
            .indices()
            .iter()
            .map(|&i| survivors[i as usize] as u32)
            .collect();
        assert_eq!(merged, whole.indices(), "{title}");
    }
}
