//! View-dependent reconstruction: the triangles of the hull.

use std::collections::{BTreeMap, BTreeSet};

use hidden_point_removal::{Error, Options, PointCloud, Reconstruction};
use robust::{Coord3D, orient3d};

use crate::common::flip::{distance, flip};
use crate::common::rng::Rng;
use crate::common::scenes::KINDS;
use crate::common::shapes;
use crate::test;

const FRONT: [f64; 3] = [0.0, 0.0, 3.0];

fn mesh(points: &[[f64; 3]], viewpoint: [f64; 3], options: &Options) -> Reconstruction {
    let cloud = PointCloud::new(points).unwrap();
    let mesh = cloud
        .reconstruct(viewpoint, options, Some(f64::INFINITY))
        .unwrap();
    assert_eq!(
        mesh.visibility,
        cloud.visible_from(viewpoint, options).unwrap()
    );
    mesh
}

fn coord([x, y, z]: [f64; 3]) -> Coord3D<f64> {
    Coord3D { x, y, z }
}

#[test]
fn triangles_are_the_outer_faces_of_the_hull() {
    for kind in KINDS.iter().filter(|kind| !kind.name.contains("scaled")) {
        for (seed, n) in [(1, 8), (2, 40), (3, 41), (4, 160)] {
            let scene = kind.scene(seed, n);
            let title = format!("{} with seed {seed}", kind.name);
            let mesh = mesh(&scene.points, scene.viewpoint, &scene.options);
            let radius = mesh.visibility.radius();
            let q: Vec<_> = scene
                .points
                .iter()
                .map(|&p| flip(p, scene.viewpoint, radius))
                .collect();
            let mut edges: BTreeMap<(u32, u32), usize> = BTreeMap::new();
            for &triangle in &mesh.triangles {
                let [a, b, c] = triangle.map(|i| coord(q[i as usize].expect("a flipped point")));
                // Clockwise seen from outside, so counter-clockwise from the viewpoint.
                assert!(orient3d(a, c, b, coord([0.0; 3])) > 0.0, "{title}");
                for q in q.iter().flatten() {
                    assert!(orient3d(a, c, b, coord(*q)) >= 0.0, "{title}: {triangle:?}");
                }
                let [a, b, c] = triangle;
                assert!(a < b && a < c && b != c, "{title}");
                for edge in [(a, b), (b, c), (c, a)] {
                    *edges.entry(edge).or_default() += 1;
                }
            }
            assert!(
                edges.values().all(|&count| count == 1),
                "{title}: an edge twice"
            );
            assert!(mesh.triangles.is_sorted_by(|a, b| a < b), "{title}");
        }
    }
}

#[test]
fn every_visible_point_is_a_corner() {
    for kind in KINDS {
        for (seed, n) in [(5, 12), (6, 60), (7, 300)] {
            let scene = kind.scene(seed, n);
            let mesh = mesh(&scene.points, scene.viewpoint, &scene.options);
            if mesh.triangles.is_empty() {
                continue;
            }
            let radius = mesh.visibility.radius();
            let of = |i: u32| flip(scene.points[i as usize], scene.viewpoint, radius);
            // Points whose flips are equal share a corner. A point at the viewpoint has no corner.
            let key = |i: u32| of(i).map(|q| q.map(|x| (x + 0.0).to_bits()));
            let corners: BTreeSet<_> = mesh.triangles.iter().flatten().map(|&i| key(i)).collect();
            let mut visible = mesh.visibility.indices().iter();
            let all = visible.all(|&i| key(i).is_none_or(|q| corners.contains(&Some(q))));
            assert!(all, "{} with seed {seed}", kind.name);
            let seen: BTreeSet<_> = mesh.visibility.indices().iter().copied().collect();
            assert!(mesh.triangles.iter().flatten().all(|i| seen.contains(i)));
        }
    }
}

#[test]
fn points_on_edges_and_facets_are_corners() {
    // Flipped with R = 3: corners, the middle of an edge, the middle of a facet, and another
    // point inside the facet.
    let targets: [[f64; 3]; 8] = [
        [3.0, 3.0, 3.0],
        [3.0, 3.0, -3.0],
        [3.0, -3.0, 3.0],
        [3.0, -3.0, -3.0],
        [3.0, 0.0, 3.0],
        [3.0, 0.0, 0.0],
        [3.0, 1.0, 2.0],
        [2.0, 2.0, 2.0],
    ];
    let points = targets.map(shapes::aim);
    let mesh = mesh(&points, [0.0; 3], &Options::radius(3.0));
    let corners: BTreeSet<u32> = mesh.triangles.iter().flatten().copied().collect();
    assert!(corners.into_iter().eq(0..7));
    // Euler: 7 points, 5 of them on the border of the facet.
    assert_eq!(mesh.triangles.len(), 2 * 7 - 2 - 5);
}

#[test]
fn equal_points_are_represented_by_the_lowest_index() {
    let [a, b, c] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let points = [c, a, b, b, a, c, [-0.0, 1.0, 0.0]];
    let mesh = mesh(&points, [0.2, 0.2, 5.0], &Options::default());
    assert_eq!(mesh.triangles, [[0, 1, 2]]);
    assert_eq!(mesh.visibility.count(), 7);
}

#[test]
fn long_edges_are_dropped() {
    let points = shapes::bumpy(&mut Rng::new(41), 3000);
    let cloud = PointCloud::new(&points).unwrap();
    let with = |max_edge| {
        let mesh = cloud
            .reconstruct(FRONT, &Options::default(), max_edge)
            .unwrap();
        mesh.triangles
    };
    let all = with(Some(f64::INFINITY));
    let longest = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|i| points[i as usize]);
        distance(a, b).max(distance(b, c)).max(distance(c, a))
    };
    for limit in [0.0, 0.05, 0.1, 0.3] {
        let expected: Vec<_> = all
            .iter()
            .copied()
            .filter(|t| longest(t) <= limit)
            .collect();
        assert_eq!(with(Some(limit)), expected);
    }
    // The default is 5 spacings.
    let usual = with(None);
    let limit = usual.iter().map(longest).fold(0.0, f64::max);
    let kept = all.iter().filter(|t| longest(t) <= limit).count();
    assert!(usual.len() == kept && kept < all.len() && kept > all.len() / 2);
    assert!((0.2..0.4).contains(&limit), "{limit}");
}

#[test]
fn flat_and_empty_views_have_no_triangles() {
    for points in [
        &[][..],
        &[FRONT],
        &[[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 1.0]],
    ] {
        assert!(
            mesh(points, FRONT, &Options::default())
                .triangles
                .is_empty()
        );
    }
    let cloud = PointCloud::new(&[[0.0; 3]]).unwrap();
    for max_edge in [-1.0, f64::NAN] {
        let error = cloud
            .reconstruct(FRONT, &Options::default(), Some(max_edge))
            .unwrap_err();
        assert!(matches!(
            error,
            Error::OutOfRange {
                option: "maxEdge",
                ..
            }
        ));
    }
}
