//! Threads change no answer: neither its bits nor a refusal.

use std::fmt::Debug;

use hidden_point_removal::{Convention, Error, Lighting, Options, Placing, PointCloud};

use super::{options, same};
use crate::common::cameras::camera;
use crate::common::rng::Rng;
use crate::common::scenes::Scene;
use crate::common::structured;

const COUNTS: [usize; 3] = [2, 3, 8];

/// The answers to all questions that threads share, as text. Numbers that differ in a bit differ
/// in their text.
fn answers(cloud: &PointCloud, viewpoints: &[[f64; 3]], options: &Options) -> Vec<String> {
    fn text<T: Debug>(name: &str, answer: Result<T, Error>) -> String {
        format!("{name}: {answer:?}")
    }
    let weights: Vec<f64> = (0..cloud.len()).map(|i| 1.0 / (1.0 + i as f64)).collect();
    let placing = Placing {
        count: Some(3),
        share: Some(0.9),
        weights: Some(&weights),
    };
    let mut texts = vec![
        text("any", cloud.visible_from_any(viewpoints, options)),
        text("two", cloud.visible_from_at_least(2, viewpoints, options)),
        text("coverage", cloud.coverage(viewpoints, options)),
        text(
            "all",
            cloud.place_viewpoints(viewpoints, options, &Placing::default()),
        ),
        text(
            "some",
            cloud.place_viewpoints(viewpoints, options, &placing),
        ),
        text(
            "light",
            cloud.illuminate(viewpoints, options, &Lighting::default()),
        ),
    ];
    for &viewpoint in viewpoints.iter().take(2) {
        texts.push(text("view", cloud.visible_from(viewpoint, options)));
        let ahead = viewpoint.map(|x| -x);
        let camera = camera(&mut Rng::new(1), viewpoint, ahead, Convention::OpenCv);
        texts.push(text("camera", cloud.visible_from_camera(&camera, options)));
        texts.push(text("mesh", cloud.reconstruct(viewpoint, options, None)));
    }
    texts
}

pub fn check(scene: &Scene, rng: &mut Rng) -> Result<(), String> {
    let cloud = PointCloud::new(&scene.points).map_err(|error| error.to_string())?;
    let options = options(scene, rng);
    let mut viewpoints = vec![scene.viewpoint];
    for _ in 0..rng.below(4) {
        viewpoints.push(structured::viewpoint(rng, &scene.points));
    }
    let with = |count| answers(&cloud, &viewpoints, &options.with_threads(count));
    let one = with(1);
    for count in COUNTS {
        for (answer, expected) in with(count).iter().zip(&one) {
            same(&format!("{count} threads, {options:?}"), answer, expected)?;
        }
    }
    Ok(())
}
