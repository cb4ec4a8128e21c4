//! Neighbors are compared with all points, sorted by distance.

use super::*;
use crate::base::random::Random;

/// The nearest other points, ties by coordinates.
fn nearest(points: &Points, query: usize, most: usize) -> Vec<[f64; 3]> {
    let center = points.get(query);
    let others = (0..points.len()).filter(|&index| index != query);
    let mut places: Vec<[f64; 3]> = others.map(|index| points.get(index)).collect();
    places.sort_by(|a, b| {
        let [near, far] = [a, b].map(|p| distance_squared(center, *p));
        near.total_cmp(&far).then(a.partial_cmp(b).unwrap())
    });
    places.truncate(most);
    places
}

fn compare(points: &Points, most: usize, step: usize) {
    let neighbors = Neighbors::new(points).unwrap();
    let mut found = Nearest::with_capacity(most).unwrap();
    for query in (0..points.len()).step_by(step) {
        neighbors.find(query, &mut found);
        let places: Vec<[f64; 3]> = (found.found().iter())
            .map(|neighbor| points.get(neighbor.index as usize))
            .collect();
        assert_eq!(places, nearest(points, query, most), "point {query}");
    }
}

#[test]
fn the_nearest_points_are_found() {
    let points = Points::Double(Random::new(1).bumpy(3000));
    for most in [1, 7, 40] {
        compare(&points, most, 59);
        compare(&points, most, 431);
    }
    compare(&Points::Double(Random::new(2).bumpy(5)), 9, 1);
    // So many that the leaves around a point have no room.
    compare(&Points::Double(Random::new(3).bumpy(6000)), 2500, 997);
}

/// In a lattice most neighbors are as far as others.
#[test]
fn coordinates_break_ties() {
    let place = |k: usize| [k % 9, k / 9 % 9, k / 81].map(|x| x as f64);
    let mut places: Vec<[f64; 3]> = (0..729).map(place).collect();
    for cell in [1.0, 3.0] {
        places.sort_by_key(|p| p.map(|x| -(x / cell) as i64));
        for most in [1, 4, 10] {
            compare(&Points::Double(places.clone()), most, 13);
        }
    }
}
