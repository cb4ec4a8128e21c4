//! Viewpoints walk around, in and through clouds of every kind, with every inversion. Each view is computed in slices,
//! with other views between, and compared with answers that start from nothing.

use hidden_point_removal::Options;

use super::same;
use crate::common::chosen::{only, some_choice};
use crate::common::cloud_of;
use crate::common::rng::Rng;
use crate::common::scenes::{EXTREME, Scene};
use crate::common::walk::Walk;
use crate::common::walked::{self, inversion};

/// The number of views of one cloud.
const WALK: usize = 8;

pub fn check(scene: &Scene, rng: &mut Rng) -> Result<(), String> {
    let points = &scene.points;
    let cloud = cloud_of(points, rng.chance(4));
    let mut observer = cloud.observer();
    let mut walk = Walk::new(points, scene.viewpoint, scene.options);
    for _ in 0..WALK {
        let mut options = walk.options;
        match rng.below(4) {
            0 => options = Options::inversion(inversion(rng)),
            1 => options = Options::looks(2 + rng.below(2)).with_scores(true),
            _ => {}
        }
        let viewpoint = walk.viewpoint;
        let title = format!("from {viewpoint:?} with {options:?}");
        let cold = cloud.visible_from(viewpoint, &options);
        let budget = 1 + points.len() / rng.pick(&[2, 3, 9]);
        let mut slices = 0;
        loop {
            if rng.chance(6) {
                // Another question, whole or begun only: from elsewhere, with other options, or of some points.
                let (mut place, mut other) = (viewpoint, options);
                match rng.below(3) {
                    0 => place = walk.place(rng, 2.0),
                    1 => {
                        other = rng.pick(&[
                            Options::default(),
                            Options::exponent(4.0),
                            Options::looks(3),
                        ])
                    }
                    _ => other = only(some_choice(rng, scene), &options),
                }
                slices = 0;
                if rng.chance(2) {
                    let _ = observer.go_on(place, &other, budget);
                } else {
                    let seen = observer.visible_from(place, &other);
                    same(&title, seen, cloud.visible_from(place, &other))?;
                }
            }
            match observer.go_on(viewpoint, &options, budget) {
                Ok(false) if slices < 100 => slices += 1,
                Ok(false) => return Err(format!("{title}: the slices do not end")),
                Ok(true) => break,
                Err(refusal) => {
                    same(&title, Some(refusal), cold.clone().err())?;
                    break;
                }
            }
            // A view may be given up, or asked before all slices are done.
            if rng.chance(12) {
                break;
            }
        }
        same(&title, observer.visible_from(viewpoint, &options), cold)?;
        walk.step(rng);
    }
    Ok(())
}

/// One cloud of eight has extreme numbers.
pub fn subject(rng: &mut Rng) -> (&'static str, Scene) {
    if rng.chance(8) {
        let kind = &EXTREME[rng.below(EXTREME.len())];
        return (kind.name, kind.scene(rng.bits(), rng.below(100)));
    }
    let (name, points, viewpoint) = walked::subject(rng);
    let scene = Scene {
        points,
        viewpoint,
        options: Options::default(),
    };
    (name, scene)
}
