//! Threads change no refusal. The check `threads` compares answers.

use hidden_point_removal::{Error, Options, PointCloud, ring_of_viewpoints};

use crate::common::refused;
use crate::common::rng::Rng;
use crate::common::shapes;

#[test]
fn of_several_refusals_the_first_one_is_reported() {
    let points = shapes::bumpy(&mut Rng::new(2), 800);
    let cloud = PointCloud::new(&points).unwrap();
    let mut viewpoints = ring_of_viewpoints([0.0, 0.0, 4.0], [0.0; 3], 40, 0.2).unwrap();
    for bad in 11..40 {
        viewpoints[bad] = [bad as f64, f64::NAN, 0.0];
    }
    for _ in 0..20 {
        let refused = cloud.coverage(&viewpoints, &Options::default().with_threads(8));
        let Err(Error::Viewpoint { viewpoint }) = refused else {
            panic!("{refused:?}");
        };
        assert_eq!(viewpoint[0], 11.0);
    }
}

#[test]
fn more_than_256_threads_are_refused() {
    let cloud = PointCloud::new(&[[0.0; 3]]).unwrap();
    let seen = |count| cloud.visible_from([1.0; 3], &Options::default().with_threads(count));
    for count in [257, usize::MAX] {
        refused("option", "threads must be from 1 to 256", seen(count));
    }
    for count in [0, 1, 256] {
        assert!(seen(count).is_ok());
    }
}
