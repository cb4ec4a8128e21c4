//! Threads change no refusal. The check `threads` compares answers.

use hidden_point_removal::{Error, Options, PointCloud, ring_of_viewpoints};

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
