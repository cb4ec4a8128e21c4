//! Answers on scanned clouds: the Stanford dragon at three resolutions and the bunny, from
//! outside and inside. They are compared with certificates: a supporting plane for every
//! checked visible point, an enclosing triangle for every checked hidden point (see
//! `common/certify.rs`). The test uses no stored counts and no other hull.

use std::collections::BTreeSet;

use hidden_point_removal::{Options, PointCloud};

use crate::common::certify::Certifier;
use crate::common::flip::flip;
use crate::common::rng::Rng;
use crate::scans::{bunny, dragon};

/// Checks `samples` visible points and as many hidden points. Also checks every point that is
/// on one of the proving faces up to rounding.
fn check(points: &[[f32; 3]], exponents: &[f64], samples: usize) {
    let cloud = PointCloud::new(points).expect("an acceptable cloud");
    let wide: Vec<[f64; 3]> = points.iter().map(|p| p.map(f64::from)).collect();
    let low: [f64; 3] =
        core::array::from_fn(|i| wide.iter().map(|p| p[i]).fold(f64::MAX, f64::min));
    let high: [f64; 3] =
        core::array::from_fn(|i| wide.iter().map(|p| p[i]).fold(f64::MIN, f64::max));
    // In units of the bounding box: three views from outside, the middle, and
    // one on the box.
    for place in [
        [0.5, 0.5, 4.0],
        [-2.0, 1.5, 0.25],
        [0.3, -1.0, -0.7],
        [0.5, 0.5, 0.5],
        [1.0, 0.5, 0.5],
    ] {
        let viewpoint = core::array::from_fn(|i| low[i] + (high[i] - low[i]) * place[i]);
        for &exponent in exponents {
            let title = format!(
                "{} points from {viewpoint:?}, exponent {exponent}",
                points.len()
            );
            let answer = cloud
                .visible_from(viewpoint, &Options::exponent(exponent))
                .expect("an acceptable view");
            let q: Vec<[f64; 3]> = wide
                .iter()
                .map(|&p| flip(p, viewpoint, answer.radius()).expect("no point at the viewpoint"))
                .collect();
            check_view(&title, &q, &answer.mask(), samples);
        }
    }
}

fn check_view(title: &str, q: &[[f64; 3]], mask: &[u8], samples: usize) {
    let certifier = Certifier::new(q);
    let mut rng = Rng::new(q.len() as u64);
    let (mut visible, mut hidden) = (BTreeSet::new(), BTreeSet::new());
    // Neighbors in the file are neighbors in the scan. If only one of them is visible, they are at
    // the border of the visible part.
    for _ in 0..q.len() * 20 {
        let i = rng.below(q.len() - 1);
        let border = mask[i] != mask[i + 1];
        for i in [i, i + 1] {
            let set = if mask[i] == 1 {
                &mut visible
            } else {
                &mut hidden
            };
            if set.len() < samples / 2 || (border && set.len() < samples) {
                set.insert(i);
            }
        }
        if visible.len() >= samples && hidden.len() >= samples {
            break;
        }
    }
    // A sparse cloud at a large exponent may hide nothing at all.
    assert!(visible.len() >= 10, "{title}: nothing to check");

    let mut close = BTreeSet::new();
    for &i in visible.iter().chain(&hidden) {
        let verdict = certifier.verdict(i);
        assert_eq!(
            mask[i] == 1,
            verdict.visible,
            "{title}: point {i}, {verdict:?}"
        );
        if close.len() < samples {
            close.extend(certifier.near_ties(verdict.face));
        }
    }
    for i in close {
        let verdict = certifier.verdict(i);
        assert_eq!(
            mask[i] == 1,
            verdict.visible,
            "{title}: close point {i}, {verdict:?}"
        );
    }
}

#[test]
fn bunny_is_certified() {
    check(&bunny(), &[2.0, 3.0, 4.0], 250);
}

#[test]
fn dragon_res4_is_certified() {
    check(&dragon("dragon_vrip_res4"), &[2.0, 3.0, 4.0], 250);
}

#[test]
fn dragon_res3_is_certified() {
    check(&dragon("dragon_vrip_res3"), &[2.0, 4.0], 60);
}

#[test]
fn dragon_is_certified() {
    check(&dragon("dragon_vrip"), &[3.0], 20);
}
