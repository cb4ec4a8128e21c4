//! The short form of `fuzz_queries`, with the same scenes every time.

use crate::common::rng::Rng;
use crate::kinds_of_queries::{QUERIES, subject};

/// The number of scenes for each kind of question.
const SCENES: u64 = 60;
/// The largest clouds have about so many points.
const MOST: usize = 200;

#[test]
fn every_kind_of_question_is_answered_like_views_alone() {
    for query in &QUERIES {
        for seed in 0..SCENES {
            let (kind, scene) = subject(&mut Rng::new(seed), query.most.min(MOST));
            let wrong = (query.check)(&scene, &mut Rng::new(seed + 1000)).err();
            assert_eq!(wrong, None, "{}, {kind}, seed {seed}", query.name);
        }
    }
}
