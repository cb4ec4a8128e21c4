//! Sectors of a cloud in parts: together they see the whole cloud's visible points.

use crate::common::parts::compare_both;
use crate::common::rng::Rng;
use crate::common::scenes::Scene;
use hidden_point_removal::PointCloud;

pub fn check(scene: &Scene, rng: &mut Rng) -> Result<(), String> {
    let cloud = PointCloud::new(&scene.points).map_err(|error| error.to_string())?;
    match cloud.visible_from(scene.viewpoint, &scene.options) {
        Ok(_) => compare_both(rng, scene.clone(), "parts"),
        Err(error) if error.code() == "radius" => {}
        Err(error) => return Err(error.to_string()),
    }
    Ok(())
}
