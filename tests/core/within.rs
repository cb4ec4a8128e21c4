//! Only the points within a distance, a box or a mask take part: the answers are, to the bit,
//! those of a cloud of these points alone.

use hidden_point_removal::{
    Exponential, Inversion, Lighting, Options, PointCloud, PointCloudNd, Radius, Within,
    merge_visible,
};

use crate::common::chosen::{alone, chosen, facts, only};
use crate::common::rng::Rng;
use crate::common::shapes;
use crate::common::{NOWHERE, refused};
use crate::test;

#[test]
fn every_option_goes_with_a_choice() {
    let mut rng = Rng::new(1);
    let points = shapes::bumpy(&mut rng, 900);
    let cloud = PointCloud::new(&points).unwrap();
    let viewpoint = [0.4, 0.3, 2.5];
    let bounds = Some([[-0.6, -2.0, -0.7], [2.0, 0.8, 2.0]]);
    let exponential = Inversion::Exponential(Exponential::Auto);
    let looks = Options::looks(3);
    // The check `within` asks all others.
    let all = [
        looks.with_scores(true),
        Options::default().with_radius(Radius::Opposite),
    ];
    for distance in [None, Some(2.9)] {
        let within = Within { distance, bounds };
        let indices = chosen(&points, &within, Some(viewpoint));
        assert!((300..700).contains(&indices.len()));
        let expected = alone(&points, &indices);
        let mapped = Some(&indices[..]);
        for plain in all {
            let options = only(within, &plain);
            let found = cloud.visible_from(viewpoint, &options);
            let alone = expected.visible_from(viewpoint, &plain);
            if let (Ok(found), Ok(alone)) = (&found, &alone) {
                assert_eq!(found.looks(), alone.looks());
                assert_eq!(found.scores().len(), if plain.scores { 900 } else { 0 });
                let scores = found.scores().iter().enumerate();
                let own = scores.filter(|(i, _)| indices.contains(&(*i as u32)));
                assert!(own.map(|(_, score)| score).eq(alone.scores()));
            }
            assert_eq!(facts(found, None), facts(alone, mapped), "{options:?}");
        }
        for plain in [Options::default(), Options::inversion(exponential)] {
            let options = only(within, &plain);
            let mesh = cloud.reconstruct(viewpoint, &options, None).unwrap();
            let other = expected.reconstruct(viewpoint, &plain, None).unwrap();
            let corners = other.triangles.iter();
            let corners = corners.map(|corners| corners.map(|k| indices[k as usize]));
            assert_eq!(mesh.triangles, corners.collect::<Vec<_>>());
            let seen = facts(Ok(mesh.visibility), None);
            assert_eq!(seen, facts(Ok(other.visibility), mapped));
        }
    }
}

#[test]
fn each_light_has_its_own_points() {
    let mut rng = Rng::new(2);
    let points = shapes::bumpy(&mut rng, 500);
    let cloud = PointCloud::new(&points).unwrap();
    let places = [[0.4, 0.3, 2.5], [-2.0, 0.5, 0.1], [0.0, 0.1, 0.2]];
    let within = Within {
        distance: Some(2.2),
        bounds: Some([[-0.9; 3], [0.9; 3]]),
    };
    for plain in [
        Options::default(),
        Options::inversion(Inversion::Exponential(Exponential::Auto)),
    ] {
        let options = only(within, &plain);
        let mut views = vec![0; points.len()];
        for place in places {
            let near = chosen(&points, &within, Some(place));
            let seen = alone(&points, &near).visible_from(place, &plain).unwrap();
            for &k in seen.indices() {
                views[near[k as usize] as usize] += 1;
            }
        }
        let lighting = Lighting {
            smoothing: 0,
            ..Lighting::default()
        };
        let light = cloud.illuminate(&places, &options, &lighting).unwrap();
        let expected = views.iter().map(|&views| (views as f64 / 3.0) as f32);
        assert_eq!(light, expected.collect::<Vec<_>>());
    }
}

#[test]
fn light_and_directions_follow_a_box() {
    let mut rng = Rng::new(3);
    let points = shapes::bumpy(&mut rng, 500);
    let cloud = PointCloud::new(&points).unwrap();
    let within = Within {
        distance: None,
        bounds: Some([[-2.0, -2.0, 0.1], [2.0, 0.5, 2.0]]),
    };
    let indices = chosen(&points, &within, None);
    let part = alone(&points, &indices);
    let options = only(within, &Options::default());
    let ahead = [0.1, 0.2, -1.0];
    assert_eq!(
        facts(cloud.visible_from_direction(ahead, &options), None),
        facts(
            part.visible_from_direction(ahead, &Options::default()),
            Some(&indices)
        )
    );
    let lights = [[0.0, 0.0, 3.0], [3.0, 0.0, 1.0]];
    let lighting = Lighting::default();
    let light = cloud.illuminate(&lights, &options, &lighting).unwrap();
    let expected = part.illuminate(&lights, &Options::default(), &lighting);
    let own: Vec<_> = indices.iter().map(|&i| light[i as usize]).collect();
    assert_eq!(own, expected.unwrap());
}

#[test]
fn duplicates_may_be_masked_one_by_one() {
    let points = [[0.0, 0.0, 1.0], [0.0, 0.0, 1.0], [0.0, 0.0, 2.0]];
    let cloud = PointCloud::new(&points).unwrap();
    let seen = |mask: [bool; 3]| {
        let part = cloud.masked(&mask).unwrap();
        assert_eq!(part.len(), 3);
        let seen = part.visible_from([0.0, 0.0, 5.0], &Options::default());
        seen.unwrap().into_indices()
    };
    assert_eq!(seen([true, true, false]), [0, 1]);
    assert_eq!(seen([false, true, false]), [1]);
    assert_eq!(seen([true, false, true]), [2]);
    assert!(seen([false; 3]).is_empty());
}

#[test]
fn a_kept_part_follows_changes_of_the_cloud() {
    let mut rng = Rng::new(4);
    let mut points = shapes::ball(&mut rng, 200);
    let mut cloud = PointCloud::new(&points).unwrap();
    let within = Within {
        distance: None,
        bounds: Some([[-0.5; 3], [0.5; 3]]),
    };
    let options = only(within, &Options::default());
    cloud.prepare_for(&options).unwrap();
    let more = shapes::ball(&mut rng, 50);
    cloud.append(&more).unwrap();
    points.extend(more);
    let indices = chosen(&points, &within, None);
    let viewpoint = [0.1, 0.2, 1.5];
    assert_eq!(
        facts(cloud.visible_from(viewpoint, &options), None),
        facts(
            alone(&points, &indices).visible_from(viewpoint, &Options::default()),
            Some(&indices)
        )
    );
}

#[test]
fn choices_that_make_no_sense_are_refused() {
    let cloud = PointCloud::new(&[[0.0, 0.0, 1.0], [0.0, 1.0, 1.0], [1.0, 0.0, 1.0]]).unwrap();
    let distance = |distance| Within {
        distance: Some(distance),
        bounds: None,
    };
    let bounds = |min, max| Within {
        distance: None,
        bounds: Some([min, max]),
    };
    let far = [0.0, 0.0, 5.0];
    let nan = f64::NAN;
    for bad in [-1.0, nan, f64::NEG_INFINITY] {
        let options = only(distance(bad), &Options::default());
        refused(
            "option",
            "within distance",
            cloud.visible_from(far, &options),
        );
        refused("option", "", cloud.visible_from_any(&NOWHERE, &options));
        let dark = cloud.illuminate(&[], &options, &Lighting::default());
        refused("option", "", dark);
    }
    for (min, max) in [
        ([1.0; 3], [0.0; 3]),
        ([nan; 3], [0.0; 3]),
        ([0.0; 3], [nan; 3]),
    ] {
        let options = only(bounds(min, max), &Options::default());
        for found in [
            cloud.visible_from(far, &options),
            cloud.visible_from_direction(far, &options),
            cloud.visible_from_any(&NOWHERE, &options),
        ] {
            refused("option", "a box must be", found);
        }
    }
    let near = only(distance(4.5), &Options::default());
    let along = cloud.visible_from_direction(far, &near);
    refused("option", "within distance", along);
    refused("viewpoint", "", cloud.visible_from([nan, 0.0, 0.0], &near));
    refused("option", "each of 3 indices, got 1", cloud.masked(&[true]));
    let part: (&[[f64; 3]], &[u32]) = (&[], &[]);
    let options = only(distance(9.0), &Options::radius(10.0));
    refused("option", "", merge_visible(&[part], far, &options));
    let four = PointCloudNd::new(4, &[0.0; 8]).unwrap();
    refused("option", "", four.visible_from(&[1.0; 4], &near));
    // A radius need only reach the points that take part.
    let small = only(distance(4.5), &Options::radius(4.5));
    assert_eq!(
        cloud.visible_from(far, &small).unwrap().indices(),
        [0, 1, 2]
    );
    let empty = only(distance(0.5), &Options::default());
    let nothing = cloud.visible_from(far, &empty).unwrap();
    assert_eq!((nothing.count(), nothing.radius()), (0, 0.0));
}

#[test]
fn a_cloud_in_a_plane_follows_a_choice() {
    let cloud = PointCloud::new(&[[0.0, 1.0, 0.0], [0.0, 2.0, 0.0], [3.0, 0.0, 0.0]]).unwrap();
    let within = Within {
        distance: Some(3.5),
        bounds: Some([[-1.0, -1.0, 0.0], [1.0, 5.0, 0.0]]),
    };
    let options = only(within, &Options::default());
    let seen = |y: f64| cloud.visible_from([0.0, y, 0.0], &options).unwrap();
    assert_eq!(seen(5.0).indices(), [1]);
    assert_eq!(seen(-2.0).indices(), [0]);
    assert_eq!(seen(-9.0).count(), 0);
}
