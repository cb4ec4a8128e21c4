//! Reduces a wrong scene to few points.

use super::common::scenes::Scene;

/// Removes runs of points as long as the scene stays wrong. The runs get shorter and shorter.
pub fn shrink(mut scene: Scene, is_wrong: impl Fn(&Scene) -> bool) -> Scene {
    let mut run = scene.points.len() / 2;
    while run > 0 {
        let before = scene.points.len();
        let mut start = 0;
        while start < scene.points.len() {
            let mut fewer = scene.points.clone();
            fewer.drain(start..(start + run).min(fewer.len()));
            std::mem::swap(&mut scene.points, &mut fewer);
            if !is_wrong(&scene) {
                scene.points = fewer;
                start += run;
            }
        }
        if run > 1 || scene.points.len() == before {
            run /= 2;
        }
    }
    scene
}
