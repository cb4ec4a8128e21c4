//! Viewpoints walk around, in and through clouds of every kind, with every inversion. Each view is asked as a draft
//! first. Then the exact answer goes on from the draft. Both are compared with answers that start from nothing.

use hidden_point_removal::Options;

use crate::common::cloud_of;
use crate::common::drafts::fault;
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
        if rng.chance(4) {
            options = Options::with_inversion(inversion(rng));
        }
        if rng.chance(12) && points.len() > 8 {
            options.vote = Some(1 + rng.below(7));
        }
        if rng.chance(6) {
            // An exact view, or a draft without an exact answer after it.
            let mut before = options;
            before.draft = rng.chance(2);
            let _ = observer.visible_from(walk.place(rng, 2.0), &before);
        }
        if let Some(found) = fault(&cloud, &mut observer, walk.viewpoint, &options) {
            return Err(format!(
                "from {:?} with {options:?}: {found}",
                walk.viewpoint
            ));
        }
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
